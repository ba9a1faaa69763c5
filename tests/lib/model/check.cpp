// check() of splines, trees and scenes in memory, and several trees stood in one world.
#include "lib/model/append.h"
#include "tests/support/random_documents.h"

using namespace bough;
using namespace bough::test;

namespace {

// "parent/1" of the first broken rule, "" if there is none.
template <class Document> std::string place(const Document& document) {
    const std::optional<Defect> defect = check(document);
    if (!defect) return "";
    CHECK_FALSE(defect->message.empty());
    return defect->index < 0 ? defect->field : defect->field + "/" + std::to_string(defect->index);
}

template <class Document, class Break> std::string broken(Document document, Break change) {
    change(document);
    return place(document);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// World frames of all bodies, from the roots on: x = x_p + R_p d, R = R_p R_pj.
void place_bodies(const Tree& tree, std::vector<Vec3>& x, std::vector<Mat3>& r) {
    x.resize(tree.size_bodies());
    r.resize(tree.size_bodies());
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::int32_t p = tree.parent[i];
        const Mat3 parent = p < 0 ? Mat3::Identity() : r[std::size_t(p)];
        const Vec3 origin = p < 0 ? Vec3::Zero() : x[std::size_t(p)];
        x[i] = origin + parent * tree.joint_position[i];
        r[i] = parent * tree.joint_rotation[i].toRotationMatrix();
    }
}

} // namespace

TEST_CASE("each rule of a tree") {
    Random random;
    const Tree good = random_tree(9, random);
    CHECK(place(good) == "");
    CHECK(place(Tree()) == "parent");
    CHECK(broken(good, [](Tree& t) { t.parent[4] = 4; }) == "parent/4");
    CHECK(broken(good, [](Tree& t) { t.parent[4] = 7; }) == "parent/4");
    CHECK(broken(good, [](Tree& t) { t.parent[4] = -2; }) == "parent/4");
    CHECK(broken(good, [](Tree& t) { t.kind[2] = Kind(4); }) == "kind/2");
    CHECK(broken(good, [](Tree& t) { t.mass[3] = 0; }) == "mass/3");
    CHECK(broken(good, [](Tree& t) { t.mass[3] = not_a_number; }) == "mass/3");
    CHECK(broken(good, [](Tree& t) { t.com[3].z() = not_a_number; }) == "com/3");
    CHECK(broken(good, [](Tree& t) { t.inertia[8](1, 2) = not_a_number; }) == "inertia/8");
    CHECK(broken(good, [](Tree& t) { t.inertia[8](1, 2) += 0.01; }) == "inertia/8");
    CHECK(broken(good, [](Tree& t) { t.joint_position[0].x() = not_a_number; }) == "joint_position/0");
    CHECK(broken(good, [](Tree& t) { t.joint_rotation[1].w() += 1e-3; }) == "joint_rotation/1");
    CHECK(broken(good, [](Tree& t) { t.stiffness[1].y() = -1; }) == "stiffness/1");
    CHECK(broken(good, [](Tree& t) { t.stiffness[1].setZero(); }) == "");
    CHECK(broken(good, [](Tree& t) { t.damping[1] = -1; }) == "damping/1");
    CHECK(broken(good, [](Tree& t) { t.size[1].x() = 0; }) == "size/1");
    CHECK(broken(good, [](Tree& t) { t.size[1].z() = -1; }) == "size/1");
    CHECK(broken(good, [](Tree& t) { t.size[1].x() = 1.1e15; }) == "size/1");
    CHECK(broken(good, [](Tree& t) { t.joint_position[1].y() = -1.1e15; }) == "joint_position/1");
    CHECK(broken(good, [](Tree& t) { t.com[1].y() = 1e300; }) == "com/1");
    CHECK(broken(good, [](Tree& t) { t.branch[1] = -1; }) == "branch/1");
    CHECK(broken(good, [](Tree& t) { t.level[1] = -1; }) == "level/1");
    CHECK(broken(good, [](Tree& t) { t.s[1] = 1.01; }) == "s/1");
    CHECK(broken(good, [](Tree& t) { t.s.pop_back(); }) == "s");
    const auto facing = [](std::vector<double> values) {
        return [values](Tree& t) {
            t.leaf_facing.assign(t.size_bodies(), 0.5);
            std::copy(values.begin(), values.end(), t.leaf_facing.begin());
        };
    };
    CHECK(broken(good, facing({0, 1, 0.3})) == "");
    CHECK(broken(good, facing({0, 1.001})) == "leaf_facing/1");
    CHECK(broken(good, facing({-1e-9})) == "leaf_facing/0");
    CHECK(broken(good, facing({0, 0, not_a_number})) == "leaf_facing/2");
    CHECK(broken(good, [](Tree& t) { t.leaf_facing = {0.5}; }) == "leaf_facing");
}

TEST_CASE("an inertia is one that a body can have") {
    Random random;
    const auto verdict = [&](double a, double b, double c) {
        const Mat3 r = random.rotation().toRotationMatrix();
        const Mat3 inertia = r * Vec3(a, b, c).asDiagonal() * r.transpose();
        return broken(random_tree(1, random), [&](Tree& t) { t.inertia[0] = 0.5 * (inertia + inertia.transpose()); });
    };
    CHECK(verdict(1, 1, 1) == "");
    CHECK(verdict(1, 1, 2) == ""); // a plate
    CHECK(verdict(1e-3, 1, 1) == "");
    CHECK(verdict(0, 1, 1) == ""); // a needle
    CHECK(verdict(0, 0, 0) == ""); // a point
    CHECK(verdict(1e-30, 1e-30, 2e-30) == "");
    CHECK(verdict(1, 1, 2.001) == "inertia/0");
    CHECK(verdict(-0.001, 1, 1) == "inertia/0");
    CHECK(verdict(0, 0, 1) == "inertia/0");
    CHECK(verdict(1e-30, 1e-30, 3e-30) == "inertia/0");
}

TEST_CASE("each rule of splines") {
    Random random;
    const Splines good = random_splines(6, random);
    CHECK(place(good) == "");
    CHECK(place(Splines()) == "parent");
    CHECK(broken(good, [](Splines& s) { s.parent[3] = 3; }) == "parent/3");
    CHECK(broken(good, [](Splines& s) { s.parent_at[3] = -0.1; }) == "parent_at/3");
    CHECK(broken(good, [](Splines& s) { s.level[3] = -1; }) == "level/3");
    CHECK(broken(good, [](Splines& s) { s.first_point[3] = s.first_point[2] + 1; }) == "first_point/3");
    CHECK(broken(good, [](Splines& s) { s.first_point[3] = std::numeric_limits<std::int32_t>::min(); }) ==
          "first_point/3");
    CHECK(broken(good, [](Splines& s) { s.first_point[0] = 1; }) == "first_point/0");
    CHECK(broken(good, [](Splines& s) { s.first_point[6] += 1; }) == "first_point/6");
    CHECK(broken(good, [](Splines& s) { s.first_point.clear(); }) == "first_point");
    CHECK(broken(good, [](Splines& s) { s.point[2].x() = not_a_number; }) == "point/2");
    CHECK(broken(good, [](Splines& s) { s.radius[2] = -1; }) == "radius/2");
    CHECK(broken(good, [](Splines& s) { s.radius[2] = 1.1e15; }) == "radius/2");
    CHECK(broken(good, [](Splines& s) { s.point[2].z() = -1.1e15; }) == "point/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_length[2] = 1e39; }) == "leaf_length/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_branch[2] = 6; }) == "leaf_branch/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_at[2] = not_a_number; }) == "leaf_at/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_rotation[2].x() += 1; }) == "leaf_rotation/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_length[2] = 0; }) == "leaf_length/2");
    CHECK(broken(good, [](Splines& s) { s.leaf_width.pop_back(); }) == "leaf_width");
    CHECK(broken(good, [](Splines& s) { s.fruit_branch[1] = -1; }) == "fruit_branch/1");
    CHECK(broken(good, [](Splines& s) { s.fruit_center[1] = s.fruit_position[1]; }) == "fruit_center/1");
    CHECK(broken(good, [](Splines& s) { s.fruit_radius[1] = -1; }) == "fruit_radius/1");
}

TEST_CASE("each rule of a scene") {
    Scene good;
    good.wind.emplace();
    good.pulls.resize(1);
    good.pulls[0].time = {0, 1};
    good.pulls[0].force.resize(2, Vec3::Zero());
    good.trees = {{"a", Vec3::Zero(), 0}, {"b", Vec3::Zero(), 0}};
    good.root_motion.resize(2);
    good.root_motion[0] = {1, {0, 1}, {Vec3::Zero(), Vec3::Zero()}, {}};
    good.root_motion[1] = {0, {0, 1}, {}, {Quat::Identity(), Quat(-1, 0, 0, 0)}};
    CHECK(place(good) == "");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].tree = 1; }) == "root_motion/1/tree");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].tree = 2; }) == "root_motion/1/tree");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].tree = -1; }) == "root_motion/1/tree");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].time = {0}; }) == "root_motion/0/time");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].time = {0, 0}; }) == "root_motion/0/time/1");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].time[1] = not_a_number; }) == "root_motion/0/time/1");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].position.clear(); }) == "root_motion/0");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].position.pop_back(); }) == "root_motion/0/position");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].position[1].x() = not_a_number; }) ==
          "root_motion/0/position/1");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].rotation.pop_back(); }) == "root_motion/1/rotation");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].rotation[1].w() = 0.99; }) == "root_motion/1/rotation/1");
    CHECK(broken(good, [](Scene& s) { s.root_motion[1].rotation[1].x() = not_a_number; }) ==
          "root_motion/1/rotation/1");
    CHECK(broken(good, [](Scene& s) { s.gravity.x() = not_a_number; }) == "gravity");
    CHECK(broken(good, [](Scene& s) { s.gravity.y() = -1e42; }) == "gravity");
    const auto grid = [](double cell, double x) {
        return [=](Scene& s) {
            s.wind->grid.emplace().cell = cell;
            s.wind->grid->x = x;
        };
    };
    CHECK(broken(good, grid(1, 1e39)) == "wind/grid/origin");
    CHECK(broken(good, grid(1e39, 1)) == "wind/grid/cell");
    CHECK(broken(good, [](Scene& s) { s.trees[0].file.clear(); }) == "trees/0/file");
    CHECK(broken(good, [](Scene& s) { s.trees[0].position.x() = -1.1e15; }) == "trees/0/position");
    CHECK(broken(good, [](Scene& s) { s.root_motion[0].position[1].x() = 1e300; }) == "root_motion/0/position/1");
    CHECK(broken(good, [](Scene& s) { s.wind->velocity.x() = 1e308; }) == "wind/velocity");
    CHECK(broken(good, [](Scene& s) { s.wind->reference_height = 1e39; }) == "wind/reference_height");
    CHECK(broken(good, [](Scene& s) { s.contact.emplace().ground_height = -1e39; }) == "contact/ground_height");
    CHECK(broken(good, [](Scene& s) { s.walkers.resize(1), s.walkers[0].radius = 1e39; }) == "walkers/0/radius");
    CHECK(broken(good, [](Scene& s) { s.balls.resize(1), s.balls[0].radius = 3.5e38; }) == "balls/0/radius");
    CHECK(broken(good, [](Scene& s) { s.balls.resize(1), s.balls[0].velocity.y() = 1e300; }) == "balls/0/velocity");
    CHECK(broken(good, [](Scene& s) { s.wind->velocity.x() = not_a_number; }) == "wind/velocity");
    CHECK(broken(good, [](Scene& s) { s.wind->reference_height = 0; }) == "wind/reference_height");
    CHECK(broken(good, [](Scene& s) { s.wind->gust_factor = 0.9; }) == "wind/gust_factor");
    CHECK(broken(good, [](Scene& s) { s.air_density = not_a_number; }) == "air_density");
    CHECK(broken(good, [](Scene& s) { s.pulls[0].time = {1, 1}; }) == "pulls/0/time/1");
    CHECK(broken(good, [](Scene& s) { s.pulls[0].time = {1}; }) == "pulls/0/force");
    CHECK(broken(good, [](Scene& s) { s.pulls[0].force[1].y() = not_a_number; }) == "pulls/0/force/1");
    CHECK(broken(good, [](Scene& s) { s.pulls[0].on.tree = 2; }) == "pulls/0/on/tree");
    CHECK(broken(good, [](Scene& s) { s.stiffness_scale = -1; }) == "stiffness_scale");
    good.joint_limit = JointLimit{};
    CHECK(place(good) == "");
    CHECK(broken(good, [](Scene& s) { s.joint_limit->leaf.z() = not_a_number; }) == "joint_limit/leaf/2");
    CHECK(broken(good, [](Scene& s) { s.joint_limit->branch.x() = 180.1; }) == "joint_limit/branch/0");
    CHECK(broken(good, [](Scene& s) { s.joint_limit->fruit.setZero(); }) == "joint_limit/fruit");
    good.leaves = LeafAir{};
    CHECK_FALSE(check(good).has_value());
    CHECK(broken(good, [](Scene& s) { s.leaves->kappa = not_a_number; }) == "leaves/kappa");
    CHECK(broken(good, [](Scene& s) { s.leaves->air_resistance = -1; }) == "leaves/air_resistance");
    CHECK(broken(good, [](Scene& s) { s.leaves->drag_ratio = 0; }) == "leaves/drag_ratio");
    CHECK(broken(good, [](Scene& s) { s.leaves->offset = not_a_number; }) == "leaves/offset");
}

TEST_CASE("a tree appended stands where it was put, as it was") {
    Random random;
    const auto tame = [&](std::size_t bodies) {
        Tree t = random_tree(bodies, random);
        for (std::size_t i = 0; i < bodies; ++i) {
            t.joint_position[i] = Vec3(random.fraction(), random.fraction(), random.fraction());
            t.branch[i] = std::int32_t(i / 3);
        }
        return t;
    };
    const Tree first = tame(10), second = tame(7);
    const Vec3 position(5, 0, -3);
    const double yaw = 0.7;
    Tree both;
    CHECK(append(both, first, Vec3::Zero(), 0) == 0);
    CHECK(both.name == first.name);
    CHECK(append(both, second, position, yaw) == 10);
    CHECK(place(both) == "");
    REQUIRE(both.size_bodies() == 17);
    CHECK(both.branch[9] == 3);
    CHECK(both.branch[10] == 4);

    std::vector<Vec3> x, x_all;
    std::vector<Mat3> r, r_all;
    place_bodies(second, x, r);
    place_bodies(both, x_all, r_all);
    Mat3 turn;
    turn << std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw);
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK((x_all[10 + i] - (turn * x[i] + position)).norm() < 1e-12);
        CHECK((r_all[10 + i] - turn * r[i]).norm() < 1e-12);
    }
}
