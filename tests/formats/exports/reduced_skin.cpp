#include "formats/exports/reduced_skin.h"
#include "formats/exports/simplified.h"
#include "tests/support/skin_checks.h"
#include <map>

using namespace bough;
using namespace skin_checks;

namespace {

double area(const Skin& skin, const std::string& part) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles(skin, part))
        sum += 0.5 * (skin.position[std::size_t(b)] - skin.position[std::size_t(a)])
                         .cross(skin.position[std::size_t(c)] - skin.position[std::size_t(a)])
                         .norm();
    return sum;
}

} // namespace

TEST_CASE("a skin that fits is left as it is") {
    const Tree tree = make_tree::random_tree(100, 2);
    const Skin skin = build_skin(tree, {});
    const ReducedSkin same = reduced_skin(skin, tree, skin.position.size());
    CHECK(same.skin.triangle == skin.triangle);
    CHECK(same.error == 0);
    CHECK(same.growth == 1);
}

TEST_CASE("fewer vertices: wood's are some of its own, leaves are whole, and keep their area while they may grow") {
    const Tree tree = make_tree::random_tree(800, 5);
    const Skin skin = build_skin(tree, {});
    const std::size_t all = skin.position.size();
    for (const double share : {0.8, 0.6, 0.4}) {
        CAPTURE(share);
        const auto most = std::size_t(share * double(all));
        const ReducedSkin made = reduced_skin(skin, tree, most);
        CHECK(made.skin.position.size() <= most);
        CHECK(made.skin.position.size() > std::size_t(0.8 * double(most)));
        REQUIRE(made.vertex.size() == made.skin.position.size());
        for (std::size_t v = 0; v < made.vertex.size(); ++v) {
            const auto from = std::size_t(made.vertex[v]);
            if (v > 0) CHECK(made.vertex[v] > made.vertex[v - 1]);
            CHECK(made.skin.texture[v] == skin.texture[from]);
            CHECK(made.skin.joint[v] == skin.joint[from]);
            CHECK(made.skin.weight[v] == skin.weight[from]);
            CHECK(made.skin.normal[v] == skin.normal[from]);
            if (tree.kind[std::size_t(skin.joint[from][0])] != Kind::leaf)
                CHECK(made.skin.position[v] == skin.position[from]);
        }
        CHECK(triangles(made.skin, "leaf").size() % leaf_triangles == 0);
        CHECK(made.kept * leaf_triangles == triangles(made.skin, "leaf").size());
        CHECK(made.growth <= 2);
        if (made.growth < 2) CHECK(area(made.skin, "leaf") == Approx(area(skin, "leaf")));
        CHECK(area(made.skin, "bark") > 0.3 * area(skin, "bark"));
        CHECK(area(made.skin, "bark") < 1.01 * area(skin, "bark"));
        // Every vertex is some triangle's, and parts are in their order.
        std::vector<bool> used(made.vertex.size(), false);
        for (const auto& t : made.skin.triangle)
            for (const std::int32_t v : t) used[std::size_t(v)] = true;
        CHECK(std::all_of(used.begin(), used.end(), [](bool is) { return is; }));
    }
}

TEST_CASE(
    "of more pieces than vertices are wished those that are near become one, but not where the tree would be lost") {
    const Skin skin = build_skin(make_tree::random_tree(800, 5), {8, false});
    Vec3 low = Vec3::Constant(INFINITY), high = -low;
    for (const Vec3& p : skin.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double size = (high - low).maxCoeff();
    const std::size_t least = simplified(skin.position, skin.triangle, 3).vertex.size(); // of the pieces, by themselves
    REQUIRE(least > 100);
    const Simplified some = simplified(skin.position, skin.triangle, least * 3 / 4);
    CHECK(some.vertex.size() <= least * 3 / 4);
    CHECK(some.vertex.size() > least / 2);
    CHECK(some.error <= 0.02 * size);
    double farthest = 0; // of every fifth of the tree's vertices (a ring has eight) from those that are left
    for (std::size_t v = 0; v < skin.position.size(); v += 5) {
        const Vec3& p = skin.position[v];
        double nearest = INFINITY;
        for (const std::int32_t left : some.vertex)
            nearest = std::min(nearest, (skin.position[std::size_t(left)] - p).norm());
        farthest = std::max(farthest, nearest);
    }
    CHECK(farthest <= 0.15 * size);
}

TEST_CASE("of a hundred vertices the largest branches' are left, whole") {
    const Tree tree = make_tree::random_tree(800, 5);
    const Skin skin = build_skin(tree, {});
    const ReducedSkin made = reduced_skin(skin, tree, 100);
    CHECK(made.skin.position.size() <= 100);
    CHECK(made.wood_kept >= 1);
    CHECK(made.wood_kept < made.wood_pieces);
    std::map<std::int32_t, double> whole, left; // [m^2] bark of a branch
    const auto sum = [&](const Skin& of, std::map<std::int32_t, double>& area) {
        for (const auto& [a, b, c] : triangles(of, "bark")) {
            const std::int32_t branch = tree.branch[std::size_t(of.joint[std::size_t(a)][0])];
            area[branch] += 0.5 * (of.position[std::size_t(b)] - of.position[std::size_t(a)])
                                      .cross(of.position[std::size_t(c)] - of.position[std::size_t(a)])
                                      .norm();
        }
    };
    sum(skin, whole);
    sum(made.skin, left);
    CHECK(left.size() == made.wood_kept);
    const auto fruit = std::count(tree.kind.begin(), tree.kind.end(), Kind::fruit);
    CHECK(whole.size() + std::size_t(fruit) == made.wood_pieces);
    double least_kept = INFINITY, most_lost = 0;
    for (const auto& [branch, area] : whole) {
        if (left.count(branch))
            least_kept = std::min(least_kept, area);
        else
            most_lost = std::max(most_lost, area);
    }
    CHECK(least_kept >= most_lost);
    for (const auto& [branch, area] : left) CHECK(area > 0.2 * whole[branch]); // simplified, not in shreds
}

TEST_CASE("a leaf that grows stays where it is attached") {
    const Tree tree = make_tree::random_tree(800, 5);
    const Skin skin = build_skin(tree, {});
    const ReducedSkin made = reduced_skin(skin, tree, skin.position.size() / 2);
    REQUIRE(made.growth > 1.05);
    std::size_t leaves = 0;
    for (std::size_t v = 0; v < made.vertex.size(); ++v) {
        const auto from = std::size_t(made.vertex[v]);
        const auto leaf = std::size_t(skin.joint[from][0]);
        // The foot is the first vertex of each face.
        if (tree.kind[leaf] != Kind::leaf || (v > 0 && made.skin.joint[v - 1][0] == skin.joint[from][0])) continue;
        CHECK((made.skin.position[v] - skin.position[from]).norm() < 1e-12);
        const double before = (skin.position[from + 3] - skin.position[from]).norm();
        CHECK((made.skin.position[v + 3] - made.skin.position[v]).norm() == Approx(made.growth * before));
        ++leaves;
    }
    CHECK(leaves == made.kept);
}
