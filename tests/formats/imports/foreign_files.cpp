// Every foreign file there is: read or refused in one line, whole, cut in half, and with bytes changed at random. What the tools make of them: cli/import.sh.
#include "tests/support/import_support.h"
#include <filesystem>

using namespace bough;
using namespace bough::test;

TEST_CASE("every foreign file is read or refused in one line, damaged too") {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (folder == nullptr) {
        WARN("BOUGH_CASES_DIR is not set: foreign files not tested");
        return;
    }
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        ++files;
        INFO(entry.path().string());
        const std::string name = entry.path().filename().string(), content = content_of(entry.path().string());
        error_of(content, name);
        if (!content.empty()) damage(content, name, content.size() / 2 + 1, 2);
    }
    CHECK(files > 0);
}

TEST_CASE("two exports that contradict themselves are refused for it") {
    const auto bone = foreign_case("invalid/speedtree_invalid_leaf_bone.xml");
    const auto skeleton = foreign_case("invalid/speedtree_missing_skeleton.xml");
    if (!bone || !skeleton) return;
    CHECK(error_of(*bone, "x").find("x:24: <LeafReferences> BoneID 99") == 0);
    CHECK(error_of(*skeleton, "x").find("no skeleton") != std::string::npos);
}
