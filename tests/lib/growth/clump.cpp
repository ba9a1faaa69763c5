// Clumps as they are drawn: how many leaves, of what area, where, and that plain leaves stay as they were.
#include "lib/growth/clump.h"
#include "lib/model/append.h"
#include "tests/support/skin_checks.h"
#include <Eigen/Eigenvalues>

using namespace bough;
using namespace skin_checks;

namespace {

// One leaf body, lying askew, that stands for n leaves.
Tree clump(std::int32_t n) {
    Tree t;
    t.resize(1);
    t.parent[0] = -1;
    t.kind[0] = Kind::leaf;
    t.mass[0] = 0.01;
    t.size[0] = Vec3(0.5, 0.4, 2e-4);
    t.com[0] = Vec3(0, 0, 0.5 / 3);
    t.inertia[0] = 1e-4 * Mat3::Identity();
    t.joint_position[0] = Vec3(3, 2, 1);
    t.joint_rotation[0] = Quat(Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()));
    t.stiffness[0] = Vec3::Ones();
    t.damping[0] = 0.01;
    t.branch[0] = t.level[0] = 0;
    t.s[0] = 0;
    t.leaf_count = {n};
    return t;
}

double area_of(const Skin& skin, const Triangles& triangles) {
    double area = 0;
    for (const auto& t : triangles) {
        const Vec3 a = skin.position[std::size_t(t[0])];
        area += (skin.position[std::size_t(t[1])] - a).cross(skin.position[std::size_t(t[2])] - a).norm() / 2;
    }
    return area;
}

bool same_mesh(const Skin& a, const Skin& b) {
    return a.position == b.position && a.normal == b.normal && a.triangle == b.triangle && a.joint == b.joint;
}

} // namespace

TEST_CASE("a clump is drawn as its leaves, of its area, at most 64") {
    for (const std::int32_t n : {2, 7, 16, 64, 65, 1000}) {
        const Skin skin = build_skin(clump(n), {});
        CHECK(skin.clump_leaf.size() == std::size_t(std::min(n, 64)));
        CHECK(skin.position.size() == leaf_vertices * skin.clump_leaf.size());
        // Both faces of each; half of length times width is the kite's and the prism's.
        CHECK(area_of(skin, triangles(skin, "leaf")) == Approx(2 * 0.5 * 0.5 * 0.4).epsilon(1e-12));
        for (const auto& joint : skin.joint) REQUIRE(joint == std::array<std::int32_t, 4>{0, 0, 0, 0});
    }
}

TEST_CASE("leaves fill the ellipsoid of a clump evenly, and face up") {
    const Tree tree = clump(64);
    const Skin skin = build_skin(tree, {});
    const Mat3 R = tree.joint_rotation[0].toRotationMatrix();
    Mat3 spread = Mat3::Zero();
    Vec3 mean = Vec3::Zero(), up = Vec3::Zero();
    for (const std::int32_t v : skin.clump_leaf) {
        const auto k = std::size_t(v);
        const Vec3 middle = (skin.position[k] + skin.position[k + 3]) / 2;
        const Vec3 from = R.transpose() * (middle - tree.joint_position[0]) - tree.com[0];
        CHECK(from.cwiseQuotient(Vec3(0.2, 0.12, 0.25)).norm() <= 1.001);
        mean += from / 64;
        spread += from * from.transpose() / 64;
        up += skin.normal[k] / 64;
    }
    CHECK(mean.norm() < 0.02);
    for (int k = 0; k < 3; ++k) // a solid ellipsoid's second moments: a fifth of the half axes' squares
        CHECK(spread(k, k) == Approx(Vec3(0.2, 0.12, 0.25)[k] * Vec3(0.2, 0.12, 0.25)[k] / 5).epsilon(0.15));
    CHECK(up.y() > 0.6);
    CHECK(std::count_if(skin.clump_leaf.begin(), skin.clump_leaf.end(),
                        [&](std::int32_t v) { return skin.normal[std::size_t(v)].y() < 0; }) <= 3);
}

TEST_CASE("leaves of a clump that hangs hang") {
    const auto falls = [](const Vec3& way) { // of the leaves, a mean
        Tree tree = clump(64);
        tree.joint_rotation[0] = shortest_turn(Vec3::UnitZ(), way);
        const Skin skin = build_skin(tree, {});
        double sum = 0;
        for (const std::int32_t v : skin.clump_leaf)
            sum -= (skin.position[std::size_t(v) + 3] - skin.position[std::size_t(v)]).normalized().y() / 64;
        return sum;
    };
    const auto below = [&](double degrees) { // level
        return falls(Vec3(std::cos(degrees * make_tree::degree), -std::sin(degrees * make_tree::degree), 0));
    };
    CHECK(below(90) > 0.9);
    CHECK(below(90) > below(60) + 0.02);
    CHECK(below(60) > below(45) + 0.02);
    CHECK(below(45) > below(31) + 0.02);
    CHECK(below(30.1) == Approx(below(29.9)).margin(0.01)); // no jump
    CHECK(below(29.9) == Approx(below(25)).margin(0.1));    // nothing of it before
    CHECK(below(0) < 0.6);
    CHECK(below(-90) < 0);
}

TEST_CASE("no two clumps look alike, and each always does") {
    Tree two = clump(9);
    append(two, clump(9), Vec3::Zero(), 0);
    const Skin skin = build_skin(two, {}), again = build_skin(two, {});
    CHECK(same_mesh(skin, again));
    const std::size_t half = skin.position.size() / 2;
    double nearest = INFINITY;
    for (std::size_t v = 0; v < half; ++v)
        nearest = std::min(nearest, (skin.position[v] - skin.position[half + v]).norm());
    CHECK(nearest > 1e-4);
}

TEST_CASE("one leaf is drawn as ever, whether it is said or not") {
    Tree tree = make_tree::random_tree(60, 4);
    const Skin silent = build_skin(tree, {});
    tree.leaf_count.assign(tree.size_bodies(), 1);
    CHECK(same_mesh(build_skin(tree, {}), silent));
    CHECK(silent.clump_leaf.empty());
}

TEST_CASE("clumps of very many leaves are drawn as fewer each") {
    Tree tree;
    const auto each = [&](std::int64_t all = 0) { // all alike
        const std::vector<std::int32_t> drawn = clump_leaves_drawn(tree, all);
        REQUIRE(drawn.size() == tree.leaf_count.size());
        for (const std::int32_t n : drawn) REQUIRE(n == drawn.front());
        return drawn.front();
    };
    tree.leaf_count.assign(100, 500);
    CHECK(each() == 64);
    tree.leaf_count.assign(3000, 500);
    CHECK(each() == 3);
    CHECK(each(24'000) == 8);
    CHECK(each(500) == 1);
    tree.leaf_count.assign(20'000, 2);
    CHECK(each() == 2);
    tree.leaf_count.assign(1'000'000, 500);
    CHECK(each() == 1);
}

TEST_CASE("leaves are enlarged alike in small clumps and large ones") {
    Tree tree;
    std::int64_t leaves = 0;
    for (std::int32_t k = 0; k < 3000; ++k) tree.leaf_count.push_back(k % 4 == 0 ? 1 : 1 + k * k / 3000);
    for (const std::int32_t n : tree.leaf_count) leaves += n > 1 ? n : 0;
    const std::vector<std::int32_t> drawn = clump_leaves_drawn(tree, 40'000);
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const std::int32_t n = tree.leaf_count[i];
        REQUIRE(drawn[i] >= 1);
        REQUIRE(drawn[i] <= n);
        if (n == 1) continue;
        sum += drawn[i];
        // To half a leaf, and the one that each has at least.
        if (drawn[i] > 1) CHECK(std::abs(drawn[i] - 40'000.0 * n / double(leaves)) < 0.5 + 0.02 * drawn[i]);
    }
    CHECK(sum <= 40'000);
    CHECK(sum > 39'000);
}

TEST_CASE("leaves of a species whose twigs hang do so wherever their clump points") {
    Tree tree = clump(64);
    tree.joint_rotation[0] = shortest_turn(Vec3::UnitZ(), Vec3::UnitY());
    const Mat3 upright = tree.joint_rotation[0].toRotationMatrix();
    const auto falls = [&](double hang) {
        double sum = 0;
        for (const ClumpLeaf& leaf : clump_leaves(tree, 0, upright, 64, hang))
            sum -= (upright * leaf.axes.col(2)).y() / 64;
        return sum;
    };
    CHECK(falls(0) < 0);
    CHECK(falls(1) > 0.9);
    CHECK(falls(0.5) > falls(0.25));
}
