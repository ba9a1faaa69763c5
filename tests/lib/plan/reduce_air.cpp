// The air on groups of rigid bodies, against sums over bodies and means over directions.
#include "lib/plan/reduce_air.h"
#include "lib/model/kind.h"
#include "tests/support/make_tree.h"
#include "tests/support/reduced.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace reduced;
using simulate::steady;

TEST_CASE("parallel bodies have the drag of their sum, and a body for every direction that of a sphere") {
    Tree tree = make_tree::chain(5, 2, 0.05, 0.01);
    const auto area = [&](const Tree& t, std::size_t i) {
        Scene scene;
        scene.wind = steady(5);
        return plan_of(t, all_of(t), scene).drag_area[i];
    };
    double sum = 0;
    std::vector<double> areas;
    for (std::size_t i = 0; i < 5; ++i) areas.push_back(area(tree, i));
    for (std::size_t i = 1; i < 5; ++i) sum += areas[i];
    tree.rigid = {0, 0, 1, 1, 1};
    const Reduced r = reduced_of(tree);
    REQUIRE(r.tree.size_bodies() == 2);
    CHECK(kind_in_air(r.tree, 1) == Kind::branch);
    CHECK(area(r.tree, 1) == Approx(sum).epsilon(1e-12));
    double moment = 0; // about the group's joint, of the pieces' forces at their own centres
    for (std::size_t i = 1; i < 5; ++i) moment += areas[i] * (0.4 * double(i - 1) + tree.com[i].z());
    CHECK(area(r.tree, 1) * r.tree.com[1].z() == Approx(moment).epsilon(1e-9));
    CHECK(r.tree.size[1][0] == Approx(1.6).epsilon(1e-12)); // reaches to the end of the last

    // Plates at right angles: the force |u| (3/4 (u.n) n + u/4) of each, summed over n = x, y, z, is 3/2 |u| u: a sphere's.
    Tree cross = make_tree::chain(1, 0.1, 1e-9, 1e-9);
    cross.stiffness[0] = Vec3(1, 1, 1);
    const Quat upright = Quat::Identity(), over = make_tree::turn(std::numbers::pi / 2, Vec3::UnitX()),
               beside = make_tree::turn(std::numbers::pi / 2, Vec3::UnitZ());
    for (const Quat& q : {upright, over, beside})
        make_tree::add_leaf(cross, 0, Vec3(0, 0, 0.05), q, 0.1, 0.08, 3e-4, 0, 0, 0.5);
    const double plate = area(cross, 1);
    cross.rigid = {0, 1, 1, 1};
    const Reduced star = reduced_of(cross);
    REQUIRE(star.tree.size_bodies() == 1);
    CHECK(kind_in_air(star.tree, 0) == Kind::fruit);
    CHECK(star.tree.kind[0] == Kind::branch);
    CHECK(area(star.tree, 0) == Approx(1.5 * plate).epsilon(1e-6));
    Scene windy;
    windy.wind = steady(5);
    CHECK(plan_of(star.tree, star.ranges, windy).kind[0] == Kind::fruit);
    // A scene's own kappa of leaves is that of those in groups.
    windy.leaves = LeafAir{};
    windy.leaves->kappa = 0.3;
    const Reduced softer = reduced_of(cross, windy);
    CHECK(area(softer.tree, 0) == Approx(1.5 * plate / 2).epsilon(1e-6));
}

TEST_CASE("the mean force of a group over all directions is its bodies'") {
    // Twigs every way: the power of the drag, f.u, averaged over directions of the wind, of a cylinder 3 pi / 16 of that broadside.
    Tree tree = make_tree::chain(1, 0.1, 1e-3, 1e-3);
    for (int k = 0; k < 60; ++k) {
        const double z = 1 - (2 * k + 1) / 60.0, around = k * std::numbers::pi * (3 - std::sqrt(5.0));
        const Vec3 along(std::sqrt(1 - z * z) * std::cos(around), std::sqrt(1 - z * z) * std::sin(around), z);
        make_tree::add_piece(tree, 0, Vec3(0, 0, 0.1), shortest_turn(Vec3::UnitZ(), along), 0.3, 0.01, 0.005, k + 1, 1,
                             0);
    }
    make_tree::add_fruit(tree, 0, Vec3(0, 0, 0.05), Quat::Identity(), 0.05, 0.03, 0, 0, 0.5);
    tree.rigid.assign(tree.size_bodies(), 1);
    tree.rigid[0] = 0;
    double power = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        power += tree.kind[i] == Kind::branch
                     ? 0.6 * tree.size[i][0] * (tree.size[i][1] + tree.size[i][2]) * 3 * std::numbers::pi / 16
                     : 0.235 * std::numbers::pi * tree.size[i][1] * tree.size[i][1];
    const Reduced r = reduced_of(tree);
    REQUIRE(r.tree.rigid.size() == 1);
    REQUIRE(r.tree.rigid[0] == round_to_air);
    CHECK(0.235 * std::numbers::pi * r.tree.size[0][1] * r.tree.size[0][1] == Approx(power).epsilon(0.01));
}
