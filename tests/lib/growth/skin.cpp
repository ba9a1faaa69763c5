#include "tests/support/skin_checks.h"

using namespace bough;
using namespace skin_checks;
using make_tree::branched;
using make_tree::chain;
using make_tree::random_tree;

TEST_CASE("each branch is one closed tube") {
    Tree beside = chain(3, 1, 0.05, 0.01);
    beside.joint_position[0] = {1, 0, 0};
    for (const Tree& tree : {branched(), random_tree(600, 1), random_tree(600, 2), chain(7, 2, 0.1, 0),
                             chain(1, 1, 0.1, 0), chain(1, 1, 0.1, 0.1), make_tree::forest({branched(), beside})}) {
        for (const int sides : {3, 8}) {
            const Skin skin = build_skin(tree, {sides});
            const std::vector<Triangles> all = tubes(skin);
            CHECK(all.size() == branch_starts(tree).size());
            for (const Triangles& tube : all) {
                CHECK(open_edges(tube, skin.position) == 0);
                CHECK(volume(tube, skin.position) > 0);
            }
        }
    }
}

TEST_CASE("fruit are closed and as large as spheres; leaves have both faces") {
    const Tree tree = branched();
    const Skin skin = build_skin(tree, {});
    CHECK(open_edges(triangles(skin, "fruit"), skin.position) == 0);
    const double sphere = 4 * std::numbers::pi / 3 * std::pow(0.03, 3);
    CHECK(volume(triangles(skin, "fruit"), skin.position) == Approx(sphere).epsilon(0.3));
    Vec3 sum = Vec3::Zero();
    double area = 0;
    for (const auto& [a, b, c] : triangles(skin, "leaf")) {
        const Vec3 &p = skin.position[std::size_t(a)], &q = skin.position[std::size_t(b)],
                   &r = skin.position[std::size_t(c)];
        const Vec3 facing = (q - p).cross(r - p) / 2;
        CHECK(facing.normalized().dot(skin.normal[std::size_t(a)]) == Approx(1));
        sum += facing;
        area += facing.norm();
    }
    CHECK(sum.norm() < 1e-12);
    CHECK(area == Approx(3 * 2 * 0.08 * 0.05 / 2));
    const Tree bare = chain(2, 1, 0.1, 0.05);
    CHECK(build_skin(bare, {}).part.size() == 1);
}

TEST_CASE("the skin's volume approaches the frustums' as sides grow, with the square of the side's angle") {
    const double r0 = 0.1, r1 = 0.03, length = 2;
    const double solid = std::numbers::pi * length * (r0 * r0 + r0 * r1 + r1 * r1) / 3;
    double before = 0;
    for (const int sides : {8, 16, 32, 64}) {
        const Skin skin = build_skin(chain(9, length, r0, r1), {sides});
        const double missing = 1 - volume(triangles(skin, "bark"), skin.position) / solid;
        CHECK(missing > 0);
        if (before > 0) CHECK(before / missing == Approx(4).epsilon(0.05));
        before = missing;
    }
    CHECK(before < 2e-3);
}

TEST_CASE("v is arc length over the base's circumference, u goes once around with a doubled seam") {
    const double length = 3, r0 = 0.1;
    const Tree tree = chain(6, length, r0, 0.02, 0.2);
    const Skin skin = build_skin(tree, {8});
    const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    std::map<float, std::vector<std::size_t>> rings; // by v
    for (std::size_t v = 0; v < skin.position.size(); ++v) rings[skin.texture[v][1]].push_back(v);
    double arc = 0;
    int full = 0;
    for (const auto& [v, corners] : rings) {
        if (corners.size() != 9) continue; // the closed ends have 8, one a triangle
        CHECK(double(v) == Approx(arc / (2 * std::numbers::pi * r0)).margin(1e-6));
        Vec3 center = Vec3::Zero();
        for (std::size_t k = 0; k < 8; ++k) center += skin.position[corners[k]] / 8;
        const std::size_t body = std::size_t(std::min(5.0, std::floor(arc / 0.5 + 1e-9)));
        CHECK((center - drawn.x_w[body] - drawn.R_wb[body].col(2) * (arc - 0.5 * double(body))).norm() < 1e-12);
        for (std::size_t k = 0; k < 9; ++k) CHECK(double(skin.texture[corners[k]][0]) == Approx(double(k) / 8));
        CHECK(skin.position[corners[0]] == skin.position[corners[8]]);
        arc += 0.25;
        ++full;
    }
    CHECK(full == 13);
}

TEST_CASE("texture coordinates are continuous: no triangle spans the seam, v rises from base to tip of every branch") {
    for (const Tree& tree : {branched(), random_tree(600, 8)}) {
        const Skin skin = build_skin(tree, {});
        for (const auto& t : triangles(skin, "bark")) {
            std::array<double, 3> u{}, v{};
            for (std::size_t k = 0; k < 3; ++k)
                u[k] = double(skin.texture[std::size_t(t[k])][0]), v[k] = double(skin.texture[std::size_t(t[k])][1]);
            const auto [low, high] = std::minmax_element(u.begin(), u.end());
            CHECK(*high - *low < 0.34);
            // u counterclockwise about the branch and v towards the tip: every triangle keeps its sense in the texture.
            CHECK((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]) > 0);
        }
        // Vertices in one place of the bark, on the two sides of a seam or of a closed end, agree in v.
        std::map<Key, float> at;
        for (const auto& t : triangles(skin, "bark"))
            for (const std::int32_t i : t) {
                const float v = skin.texture[std::size_t(i)][1];
                CHECK(at.emplace(key(skin.position[std::size_t(i)]), v).first->second == v);
            }
    }
}

TEST_CASE("extremes: long chains, odd parents, thin tips") {
    SECTION("a branch of 1e5 pieces") {
        const Skin skin = build_skin(chain(100000, 1000, 0.1, 0), {3});
        CHECK(skin.position.size() > 100000u * 4);
        CHECK(open_edges(triangles(skin, "bark"), skin.position) == 0);
    }
    SECTION("a leaf and a fruit on the ground, a branch on a fruit, two pieces going on from one") {
        Tree tree;
        make_tree::add_leaf(tree, -1, {0, 0, 0}, make_tree::upright(), 0.1, 0.05, 3e-4, 0, 0, 0);
        make_tree::add_fruit(tree, -1, {1, 0, 0}, make_tree::upright(), 0, 0.05, 0, 0, 0);
        make_tree::add_piece(tree, 1, {0, 0, 0}, Quat::Identity(), 1, 0.1, 0.05, 1, 0, 0);
        make_tree::add_piece(tree, 2, {0, 0, 1}, make_tree::turn(0.4, Vec3::UnitX()), 1, 0.05, 0, 1, 0, 0.5);
        make_tree::add_piece(tree, 2, {0, 0, 1}, make_tree::turn(-0.4, Vec3::UnitX()), 1, 0.05, 0, 1, 0, 0.5);
        const Skin skin = build_skin(tree, {});
        CHECK(skin.part.size() == 3);
        CHECK(tubes(skin).size() == 2);
        for (const Triangles& tube : tubes(skin)) CHECK(open_edges(tube, skin.position) == 0);
        CHECK(open_edges(triangles(skin, "fruit"), skin.position) == 0);
        CHECK(std::all_of(skin.normal.begin(), skin.normal.end(), [](const Vec3& n) { return n.allFinite(); }));
    }
    SECTION("no bodies") {
        CHECK(build_skin(Tree(), {}).position.empty());
    }
    SECTION("a chain that folds back on itself") {
        const Skin skin = build_skin(chain(5, 2, 0.1, 0.1, std::numbers::pi), {});
        for (const Vec3& p : skin.position) CHECK(p.allFinite());
        for (const Vec3& n : skin.normal) CHECK(n.norm() == Approx(1));
    }
}

// Programs leave out a vertex that no triangle has and number the rest anew; point caches would no longer fit.
TEST_CASE("every vertex is some triangle's") {
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(1000, 8), make_tree::chain(3, 1, 0.1, 0)}) {
        const Skin skin = build_skin(tree, {});
        std::vector<char> used(skin.position.size(), 0);
        for (const auto& corners : skin.triangle)
            for (const std::int32_t v : corners) used[std::size_t(v)] = 1;
        CHECK(std::count(used.begin(), used.end(), 0) == 0);
    }
}
