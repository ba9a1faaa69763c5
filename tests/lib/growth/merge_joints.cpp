#include "lib/growth/merge_joints.h"
#include "tests/support/skin_checks.h"
#include <set>

using namespace bough;
using namespace skin_checks;
using make_tree::branched;
using make_tree::chain;
using make_tree::forest;
using make_tree::random_tree;

namespace {

// What every grouping must be, whatever it prefers.
void check_groups(const Tree& tree, const JointGroups& groups, std::size_t most) {
    REQUIRE(groups.group.size() == tree.size_bodies());
    REQUIRE(groups.size() <= most);
    std::vector<std::int32_t> first(groups.size(), -1);
    std::int64_t wrong = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::size_t g = std::size_t(groups.group[i]);
        REQUIRE(g < groups.size());
        const std::int32_t p = tree.parent[i];
        if (first[g] < 0) {
            first[g] = std::int32_t(i);
            wrong += groups.first[g] != std::int32_t(i);
            wrong += groups.parent[g] != (p < 0 ? -1 : groups.group[std::size_t(p)]);
            wrong += groups.parent[g] >= std::int32_t(g);
        } else {
            wrong += p < 0 || groups.group[std::size_t(p)] != std::int32_t(g); // connected
        }
    }
    CHECK(wrong == 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::size_t lead = std::size_t(groups.lead[g]), begin = std::size_t(groups.first[g]);
        CHECK(groups.group[lead] == std::int32_t(g));
        CHECK(tree.branch[lead] == tree.branch[begin]);
        CHECK(tree.kind[lead] == tree.kind[begin]);
    }
}

std::set<std::int32_t> firsts(const JointGroups& groups) {
    return {groups.first.begin(), groups.first.end()};
}

// The distance between far ends by kinematics of its own: from the root down, each group turned as its leading body.
std::pair<double, double> off_by_hand(const Tree& tree, const JointGroups& groups, const SkinPose& is) {
    const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    double squares = 0, most = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        Vec3 p = drawn.x_w[i] + drawn.R_wb[i].col(2) * tree.size[i].x();
        const Vec3 wanted = is.x_w[i] + is.R_wb[i].col(2) * tree.size[i].x();
        // Innermost group first: turned about its joint, then what carries that joint, and so on.
        Mat3 turned = Mat3::Identity(); // by the groups already passed
        for (std::int32_t g = groups.group[i]; g >= 0; g = groups.parent[std::size_t(g)]) {
            const std::size_t lead = std::size_t(groups.lead[std::size_t(g)]);
            const Vec3 pivot = drawn.x_w[std::size_t(groups.first[std::size_t(g)])];
            const std::int32_t above = groups.parent[std::size_t(g)];
            const Mat3 world = is.R_wb[lead] * drawn.R_wb[lead].transpose();
            Mat3 carried = Mat3::Identity();
            if (above >= 0) {
                const std::size_t b = std::size_t(groups.lead[std::size_t(above)]);
                carried = is.R_wb[b] * drawn.R_wb[b].transpose();
            }
            p = pivot + carried.transpose() * world * (p - pivot);
            turned = carried;
        }
        CHECK(turned.isIdentity(1e-12));
        squares += (p - wanted).squaredNorm();
        most = std::max(most, (p - wanted).norm());
    }
    return {std::sqrt(squares / double(tree.size_bodies())), most};
}

} // namespace

TEST_CASE("groups are connected, no more than asked for, led from their own branch") {
    for (const Tree& tree :
         {branched(), chain(40, 8, 0.1, 0.01), random_tree(700, 3), forest({branched(), random_tree(300, 8)})})
        for (const std::size_t most : {std::size_t(2), std::size_t(3), std::size_t(7), std::size_t(40),
                                       std::size_t(200), tree.size_bodies(), tree.size_bodies() + 5})
            check_groups(tree, merge_joints(tree, most), most);
}

TEST_CASE("where all fit every body is a group of its own") {
    const Tree tree = random_tree(500, 4);
    const JointGroups groups = merge_joints(tree, tree.size_bodies());
    REQUIRE(groups.size() == tree.size_bodies());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        CHECK(groups.group[i] == std::int32_t(i));
        CHECK(groups.parent[i] == tree.parent[i]);
        CHECK(groups.first[i] == std::int32_t(i));
        CHECK(groups.lead[i] == std::int32_t(i));
    }
}

TEST_CASE("the joints asked for are used") {
    for (const Tree& tree : {branched(), random_tree(700, 5)})
        for (std::size_t most = 1; most <= tree.size_bodies(); most += 1 + most / 10) {
            const JointGroups groups = merge_joints(tree, most);
            CHECK(groups.size() <= most);
            // Even sharing can leave a few; never as many as a level has branches.
            CHECK(groups.size() + 4 >= std::min(most, tree.size_bodies()));
        }
}

TEST_CASE("leaves and fruit go first, then pieces of side branches, then the deepest branches, the trunk last") {
    // Bodies: trunk 0-3; branches 4-5 (reach 0.8), 6-7, 8 (the shortest); a twig 9; leaves 10-12, a fruit 13.
    const Tree tree = branched();
    const auto kept = [&](std::size_t most) { return firsts(merge_joints(tree, most)); };
    CHECK(kept(1) == std::set<std::int32_t>{0});
    CHECK(kept(2) == std::set<std::int32_t>{0, 2}); // evenly
    CHECK(kept(4) == std::set<std::int32_t>{0, 1, 2, 3});
    CHECK(kept(5) == std::set<std::int32_t>{0, 1, 2, 3, 4});
    CHECK(kept(6) == std::set<std::int32_t>{0, 1, 2, 3, 4, 6});
    CHECK(kept(7) == std::set<std::int32_t>{0, 1, 2, 3, 4, 6, 8});
    CHECK(kept(8) == std::set<std::int32_t>{0, 1, 2, 3, 4, 6, 8, 9});
    CHECK(kept(9) == std::set<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 8, 9});
    CHECK(kept(10) == std::set<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    const JointGroups no_leaves = merge_joints(tree, 10);
    for (const std::size_t leaf : {10u, 11u, 12u, 13u})
        CHECK(no_leaves.group[leaf] == no_leaves.group[std::size_t(tree.parent[leaf])]);
    // Of the foliage the longest first: leaves 0.08 m, the fruit 0.06 m.
    CHECK(kept(13) == std::set<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}

TEST_CASE("pieces of a branch are joined evenly and led by the middle one") {
    const Tree tree = chain(30, 6, 0.1, 0.1);
    const JointGroups groups = merge_joints(tree, 7);
    CHECK(groups.size() == 6); // 5 pieces each; 7 would need groups of 4 and 5
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto pieces = std::count(groups.group.begin(), groups.group.end(), std::int32_t(g));
        CHECK(pieces == 5);
        CHECK(groups.lead[g] == groups.first[g] + 2);
    }
}

TEST_CASE("a trunk has four groups before its branches have any") {
    // A trunk of 40 pieces with 12 side branches: 4 for the trunk, one each, the rest to the trunk's pieces.
    Tree tree = chain(40, 8, 0.1, 0.05);
    for (int k = 0; k < 12; ++k)
        make_tree::add_piece(tree, 3 * k + 2, {0, 0, 0.1}, make_tree::turn(1, Vec3::UnitY()), 0.5 + 0.1 * k, 0.02, 0.01,
                             k + 1, 1, 0);
    const auto kept = firsts(merge_joints(tree, 4));
    CHECK(kept == std::set<std::int32_t>{0, 10, 20, 30});
    const auto some = firsts(merge_joints(tree, 6));
    CHECK(some == std::set<std::int32_t>{0, 10, 20, 30, 50, 51}); // the two that reach farthest
    const auto all = firsts(merge_joints(tree, 24));
    CHECK(std::distance(all.lower_bound(40), all.end()) == 12);
    CHECK(std::distance(all.begin(), all.lower_bound(40)) >= 10);
}

TEST_CASE("each root keeps a joint, and fewer than roots are refused") {
    const Tree tree = forest({chain(3, 1, 0.1, 0.1), branched(), chain(2, 1, 0.1, 0.1)});
    check_groups(tree, merge_joints(tree, 3), 3);
    CHECK(merge_joints(tree, 3).size() == 3);
    CHECK_THROWS_AS(merge_joints(tree, 2), std::invalid_argument);
}

TEST_CASE("a chain a hundred thousand deep is merged") {
    const Tree tree = chain(100000, 100, 0.1, 0.01);
    check_groups(tree, merge_joints(tree, 1000), 1000);
}

TEST_CASE("groups' frames are the drawn pose") {
    const Tree tree = random_tree(400, 6);
    const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    const JointGroups groups = merge_joints(tree, 60);
    const GroupFrames frames = drawn_frames(tree, groups);
    std::vector<Mat3> R(groups.size());
    std::vector<Vec3> x(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::int32_t p = groups.parent[g];
        const Mat3 own = frames.rotation[g].toRotationMatrix();
        R[g] = p < 0 ? own : Mat3(R[std::size_t(p)] * own);
        x[g] = p < 0 ? frames.position[g] : Vec3(x[std::size_t(p)] + R[std::size_t(p)] * frames.position[g]);
        CHECK((R[g] - drawn.R_wb[std::size_t(groups.lead[g])]).norm() < 1e-12);
        CHECK((x[g] - drawn.x_w[std::size_t(groups.first[g])]).norm() < 1e-12);
    }
}

TEST_CASE("the error of merging is what kinematics by hand gives") {
    const Tree tree = random_tree(400, 7);
    for (const std::size_t most : {std::size_t(1), std::size_t(20), std::size_t(150), tree.size_bodies()}) {
        const JointGroups groups = merge_joints(tree, most);
        MergeError error(tree, groups);
        double squares = 0, largest = 0;
        for (const unsigned seed : {1u, 2u, 3u}) {
            const SkinPose pose = bent(tree, 0.2, seed);
            std::vector<Quat> rotation;
            for (const Mat3& R : pose.R_wb) rotation.emplace_back(R);
            error.add(rotation, pose.x_w);
            const auto [rms, farthest] = off_by_hand(tree, groups, pose);
            squares += rms * rms;
            largest = std::max(largest, farthest);
        }
        CHECK(error.rms() == Approx(std::sqrt(squares / 3)).margin(1e-12));
        CHECK(error.largest() == Approx(largest).margin(1e-12));
        if (most == tree.size_bodies())
            CHECK(error.largest() < 1e-12);
        else
            CHECK(error.rms() > 1e-3);
    }
}

TEST_CASE("a branch that bends evenly is followed by its groups") {
    // A circle's arc of 1 rad, cut into n rigid groups that turn as their middles: off by about (1/n)^2 / 24 of its length.
    const Tree tree = chain(64, 2, 0.02, 0.02);
    const SkinPose pose = posed(tree, [](std::size_t i) { return Vec3(i == 0 ? 0 : 1.0 / 63, 0, 0); });
    std::vector<Quat> rotation;
    for (const Mat3& R : pose.R_wb) rotation.emplace_back(R);
    for (const std::size_t n : {1u, 2u, 4u, 8u}) {
        MergeError error(tree, merge_joints(tree, n));
        error.add(rotation, pose.x_w);
        // The largest is within a group, where a straight piece cuts the arc's corner: sagitta (1/n)^2 / 8, and half a
        // piece by which the middle one is not quite the middle.
        CHECK(error.largest() < 2 * (1.0 / double(8 * n * n) + 1.0 / 64) * 1.2);
    }
}
