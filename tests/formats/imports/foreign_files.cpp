// Every foreign file there is: read or refused in one line, whole, cut in half, and with bytes changed at random. What the tools make of them: cli/import.sh.
#include "tests/support/import_support.h"
#include <filesystem>
#include <random>
#include <vector>

using namespace bough;
using namespace bough::test;

namespace {

constexpr int rounds = 4; // of each file
constexpr int changed = 12;

} // namespace

TEST_CASE("every foreign file is read or refused in one line, damaged too") {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (folder == nullptr) {
        WARN("BOUGH_CASES_DIR is not set: foreign files not tested");
        return;
    }
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) paths.push_back(entry.path());
    REQUIRE_FALSE(paths.empty());
    for (const std::filesystem::path& path : paths) {
        const std::string name = path.filename().string();
        const std::string content = content_of(path.string());
        INFO(path.string());
        error_of(content, name);
        error_of(content.substr(0, content.size() / 2), name);
        for (int round = 0; round < rounds && !content.empty(); ++round) {
            INFO("damaged, round " << round);
            std::mt19937 random{unsigned(round)};
            std::string broken = content;
            for (int k = 0; k < changed; ++k) broken[random() % broken.size()] = char(random() % 256);
            error_of(broken, name);
        }
    }
}

TEST_CASE("two exports that contradict themselves are refused for it") {
    const auto bone = foreign_case("invalid/speedtree_invalid_leaf_bone.xml");
    const auto skeleton = foreign_case("invalid/speedtree_missing_skeleton.xml");
    if (!bone || !skeleton) return;
    CHECK(error_of(*bone, "x").find("x:24: <LeafReferences> BoneID 99") == 0);
    CHECK(error_of(*skeleton, "x").find("no skeleton") != std::string::npos);
}
