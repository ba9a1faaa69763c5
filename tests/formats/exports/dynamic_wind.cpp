#include "formats/exports/dynamic_wind.h"
#include "tests/support/make_tree.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <unistd.h>

using namespace bough;
using Json = nlohmann::json;

namespace {

// Every joint turned by angle(i) about its own x, by forward kinematics.
std::vector<Quat> turned(const Tree& tree, const std::function<double(std::size_t)>& angle) {
    std::vector<Quat> world;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Quat own = tree.joint_rotation[i] * Quat(Eigen::AngleAxisd(angle(i), Vec3::UnitX()));
        world.push_back(tree.parent[i] < 0 ? own : Quat(world[std::size_t(tree.parent[i])] * own));
    }
    return world;
}

Json written(const Tree& tree, const JointGroups& groups, WindFit fit = {}) {
    if (fit.group.empty()) {
        WindMotion still(tree, groups);
        still.add(turned(tree, [](std::size_t) { return 0.0; }));
        fit = still.fit();
    }
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bough_test_wind_" + std::to_string(getpid()) + ".json")).string();
    Output output(path);
    write_dynamic_wind(output, tree, groups, fit);
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

namespace {

struct Chains {
    Tree tree = make_tree::branched();
    JointGroups groups = merge_joints(tree, 1000);
    std::vector<std::int32_t> group = wind_groups(tree, groups);
};

} // namespace

TEST_CASE("influences of joints that turn alike in each group are these turns' ratios, and nothing is left") {
    const Chains c;
    const double turn[] = {0.01, 0.03, 0.04, 0.2};
    WindMotion motion(c.tree, c.groups);
    // Swings of amplitude a: a / sqrt 2 in the mean square.
    for (const double sign : {1.0, 0.0, -1.0, 0.0})
        motion.add(
            turned(c.tree, [&](std::size_t i) { return sign * std::sqrt(2.0) * turn[std::size_t(c.group[i])]; }));
    const WindFit fit = motion.fit();
    REQUIRE(fit.group.size() == 4);
    CHECK(fit.unit == Approx(0.04)); // the leaves' group has no wood
    CHECK(fit.off < 1e-9);
    CHECK(fit.explained == Approx(1));
    for (std::size_t g = 0; g < 3; ++g) {
        CHECK_FALSE(fit.group[g].dual);
        CHECK(fit.group[g].influence == Approx(turn[g] / 0.04));
    }
    CHECK(fit.group[3].influence == 1);
}

TEST_CASE("a turn that grows from some way up the branch is found again: least, most and shift") {
    const Chains c;
    // The trunk's joints stand at 0, 1/3, 2/3, 1 of its way, as their pieces are of one length.
    const std::vector<double> s = {0, 1. / 3, 2. / 3, 1};
    for (std::size_t i = 1; i < 4; ++i)
        REQUIRE(c.tree.joint_position[i].norm() == Approx(c.tree.joint_position[1].norm()));
    const auto model = [](double at) { return 0.01 + 0.05 * std::max(0.0, (at - 0.5) / 0.5); };
    WindMotion motion(c.tree, c.groups);
    motion.add(turned(c.tree, [&](std::size_t i) { return i < 4 ? model(s[i]) : 0.0; }));
    const WindFit fit = motion.fit();
    const WindInfluence& trunk = fit.group[0];
    CHECK(trunk.dual);
    for (std::size_t k = 0; k < 4; ++k) CHECK(fit.unit * trunk.at(s[k]) == Approx(model(s[k])).margin(1e-6));
    CHECK(trunk.most == Approx(1));
    CHECK(fit.unit == Approx(0.06));
    CHECK(trunk.least == Approx(0.01 / 0.06));
    CHECK(trunk.shift == 0.5);
    const Json json = written(c.tree, c.groups, fit);
    CHECK(json["SimulationGroups"][0]["bUseDualInfluence"] == true);
    CHECK(json["SimulationGroups"][0]["MaxInfluence"] == 1);
}

TEST_CASE("a still run and turns that fall towards the tip have one influence each") {
    const Chains c;
    WindMotion motion(c.tree, c.groups);
    motion.add(turned(c.tree, [](std::size_t i) { return i < 4 ? 0.1 - 0.02 * double(i) : 0.0; }));
    CHECK_FALSE(motion.fit().group[0].dual);
    WindMotion still(c.tree, c.groups);
    still.add(turned(c.tree, [](std::size_t) { return 0.0; }));
    CHECK(still.fit().rms < 1e-7);
}

TEST_CASE("joints of vertical branches are found, trunks are none") {
    Tree tree = make_tree::branched();
    const JointGroups groups = merge_joints(tree, 1000);
    const GroupFrames drawn = drawn_frames(tree, groups);
    const std::vector<std::int32_t> before = vertical_joints(tree, groups);
    // Body 4 begins branch 1: stands it up.
    const Quat now(drawn.R_wg[4]);
    const Quat up = shortest_turn(now * Vec3::UnitZ(), Vec3::UnitY());
    tree.joint_rotation[4] = tree.joint_rotation[4] * (now.conjugate() * up * now);
    const std::vector<std::int32_t> after = vertical_joints(tree, groups);
    CHECK(std::find(before.begin(), before.end(), 4) == before.end());
    CHECK(std::find(after.begin(), after.end(), 4) != after.end());
    for (const std::int32_t j : after) CHECK(wind_groups(tree, groups)[std::size_t(j)] > 0);
}
