#include "formats/exports/dynamic_wind.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <unistd.h>

using namespace bough;
using Json = nlohmann::json;

namespace {

Json written(const Tree& tree, const JointGroups& groups) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bough_test_wind_" + std::to_string(getpid()) + ".json")).string();
    Output output(path);
    write_dynamic_wind(output, tree, groups);
    output.finish();
    const std::string text = read_input(path);
    std::filesystem::remove(path);
    return Json::parse(text);
}

} // namespace

// The fields and their types as Epic's API reference lists them for FDynamicWindSkeletalImportData and its members.
TEST_CASE("all fields of the import, and none else") {
    const Tree tree = make_tree::branched();
    const Json json = written(tree, merge_joints(tree, 1000));
    CHECK(json.size() == 4);
    CHECK(json["bIsGroundCover"] == false);
    CHECK(json["GustAttenuation"].is_number());
    for (const Json& joint : json["Joints"]) {
        CHECK(joint.size() == 2);
        CHECK(joint["JointName"].is_string());
        CHECK(joint["SimulationGroupIndex"].is_number_integer());
    }
    REQUIRE(json["SimulationGroups"].size() == 4); // trunk, branch, twig and the leaf on it
    for (std::size_t g = 0; g < 4; ++g) {
        const Json& group = json["SimulationGroups"][g];
        CHECK(group.size() == 6);
        CHECK(group["bIsTrunkGroup"] == (g == 0));
        CHECK(group["bUseDualInfluence"] == false);
        for (const char* name : {"Influence", "MinInfluence", "MaxInfluence", "ShiftTop"})
            CHECK((group[name] >= 0 && group[name] <= 1)); // what the editor's fields take
    }
}

TEST_CASE("a small tree's groups, counted by hand") {
    const Tree tree = make_tree::branched();
    const Json json = written(tree, merge_joints(tree, 1000));
    std::map<std::string, int> group;
    for (const Json& joint : json["Joints"]) group[joint["JointName"]] = joint["SimulationGroupIndex"];
    // Trunk 0 to 3; branches 4-5, 6-7, 8; the twig 9; leaves on branch 1's end, the twig, the trunk; a fruit on branch 2.
    CHECK(group == std::map<std::string, int>{{"body_0", 0},
                                              {"body_1", 0},
                                              {"body_2", 0},
                                              {"body_3", 0},
                                              {"body_4", 1},
                                              {"body_5", 1},
                                              {"body_6", 1},
                                              {"body_7", 1},
                                              {"body_8", 1},
                                              {"body_9", 2},
                                              {"body_10", 2},
                                              {"body_11", 3},
                                              {"body_12", 1},
                                              {"body_13", 2}});
}

TEST_CASE("no joint bears two of its own group, however it is merged and whatever the levels say") {
    Tree tree = make_tree::random_tree(600, 4);
    std::fill(tree.level.begin(), tree.level.end(), 1); // as of a trunk that splits
    for (const std::size_t joints : {600u, 100u, 7u, 1u}) {
        const JointGroups groups = merge_joints(tree, joints);
        const Json json = written(tree, groups);
        REQUIRE(json["Joints"].size() == groups.size());
        std::map<std::pair<std::int32_t, int>, int> born;
        std::set<int> used;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const int own = json["Joints"][g]["SimulationGroupIndex"];
            used.insert(own);
            CHECK(json["Joints"][g]["JointName"] == "body_" + std::to_string(groups.first[g]));
            if (groups.parent[g] < 0) CHECK(own == 0);
            if (groups.parent[g] < 0) continue;
            const int above = json["Joints"][std::size_t(groups.parent[g])]["SimulationGroupIndex"];
            CHECK((own == above || own == above + 1));
            if (own == above) CHECK(++born[{groups.parent[g], own}] == 1);
        }
        CHECK(used.size() == json["SimulationGroups"].size());
    }
}
