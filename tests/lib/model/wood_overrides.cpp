// What a scene makes of its trees' wood: factors, curves over radius, subtrees, forks; and that no plan is made without it.
#include "lib/model/wood_overrides.h"
#include "lib/base/monotone.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>
#include <map>
#include <set>

using namespace bough;

namespace {

std::vector<TreeRange> whole(const Tree& tree) {
    return {{0, tree.size_bodies(), 0}};
}

bool is_branch(const Tree& tree, std::size_t i) {
    return tree.kind[i] == Kind::branch;
}

// The way to the nearest fork by arc length on each branch by itself: where its side branches leave it, and its own base where it is
// one. (Another way to say what the header says.)
std::vector<double> ways_by_arc(const Tree& tree) {
    std::vector<double> arc(tree.size_bodies(), 0), way(tree.size_bodies(), INFINITY);
    std::map<int, std::vector<double>> forks;
    for (std::size_t i = 0; i < arc.size(); ++i) {
        if (!is_branch(tree, i) || tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        const double at = arc[p] + tree.joint_position[i].z();
        if (tree.branch[i] == tree.branch[p]) {
            arc[i] = at;
        } else {
            forks[tree.branch[p]].push_back(at);
            forks[tree.branch[i]].push_back(0);
        }
    }
    for (std::size_t i = 0; i < arc.size(); ++i)
        if (is_branch(tree, i))
            for (const double fork : forks[tree.branch[i]]) way[i] = std::min(way[i], std::abs(arc[i] - fork));
    return way;
}

} // namespace

TEST_CASE("the monotone cubic meets its keys, stays between them, and has the slopes its source says") {
    const std::vector<double> x{0.01, 0.02, 0.05, 0.06, 0.4}, y{3, 5, 50, 20, 21};
    for (std::size_t k = 0; k < x.size(); ++k) CHECK(monotone_cubic(x, y, x[k]) == y[k]);
    CHECK(monotone_cubic(x, y, 0) == 3);
    CHECK(monotone_cubic(x, y, 9) == 21);
    CHECK(monotone_cubic({}, {7}, 0.3) == 7);
    CHECK(monotone_cubic({0.1}, {7}, 0.3) == 7);
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
        for (double w = 0; w <= 1; w += 1.0 / 64) {
            const double value = monotone_cubic(x, y, x[k] + w * (x[k + 1] - x[k]));
            CHECK(value >= std::min(y[k], y[k + 1]) * (1 - 1e-12));
            CHECK(value <= std::max(y[k], y[k + 1]) * (1 + 1e-12));
        }
    const auto slope = [&](double at) {
        return (monotone_cubic(x, y, at + 1e-7) - monotone_cubic(x, y, at - 1e-7)) / 2e-7;
    };
    const double below = 2 / 0.01, above = 45 / 0.03;
    CHECK(slope(0.02) == Approx(2 / (1 / below + 1 / above)).epsilon(1e-3));
    CHECK(std::abs(slope(0.05)) < 1e-2 * above); // a turning point
}

TEST_CASE("factors act on their kind alone, density on mass and inertia") {
    const Tree before = make_tree::branched();
    Tree tree = before;
    Wood wood;
    wood.branch = {2, 3, 1.5};
    wood.leaf = {0.25, 1, 0.5};
    wood.fruit = {1, 0, 4};
    const WoodChanges changes = override_wood(tree, whole(tree), wood);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const WoodFactors& by = is_branch(tree, i) ? wood.branch : tree.kind[i] == Kind::leaf ? wood.leaf : wood.fruit;
        CHECK((tree.stiffness[i] - by.stiffness * before.stiffness[i]).norm() == 0);
        CHECK(tree.damping[i] == by.damping * before.damping[i]);
        CHECK(tree.mass[i] == by.density * before.mass[i]);
        CHECK((tree.inertia[i] - by.density * before.inertia[i]).norm() <= 1e-15 * tree.inertia[i].norm());
        CHECK(tree.com[i] == before.com[i]);
    }
    CHECK(changes.stiffness == 13); // 10 branch bodies, 3 leaves
    CHECK(changes.damping == 11);   // 10 and the fruit
    CHECK(changes.mass == 14);
}

TEST_CASE("curves give both bends K at the body's radius, twist in proportion, and damping") {
    const Tree before = make_tree::branched();
    Tree tree = before;
    Wood wood;
    WoodCurve curve;
    curve.radius = {0.01, 0.03, 0.06};
    curve.stiffness = {10, 200, 5000};
    curve.damping = {0.1, 0.02, 0.01};
    wood.curves = {curve};
    override_wood(tree, whole(tree), wood);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CAPTURE(i);
        if (!is_branch(tree, i)) {
            CHECK(tree.stiffness[i] == before.stiffness[i]);
            CHECK(tree.damping[i] == before.damping[i]);
            continue;
        }
        const double K = monotone_cubic(curve.radius, curve.stiffness, tree.size[i][1]);
        CHECK(tree.stiffness[i].x() == K);
        CHECK(tree.stiffness[i].y() == K);
        const Vec3& was = before.stiffness[i];
        CHECK(tree.stiffness[i].z() / K == Approx(was.z() / ((was.x() + was.y()) / 2)).epsilon(1e-14));
        CHECK(tree.damping[i] == monotone_cubic(curve.radius, curve.damping, tree.size[i][1]));
    }
    CHECK(tree.stiffness[0].x() == 5000); // radius 0.06 is a key
    CHECK(tree.stiffness[4].x() == 200);
}

TEST_CASE("a curve on a body holds for all that it carries, a later one over an earlier, relative ones multiply") {
    const Tree before = make_tree::branched();
    Tree tree = before;
    Wood wood;
    WoodCurve all, bough, half;
    all.radius = bough.radius = half.radius = {0};
    all.stiffness = {100};
    bough.stiffness = {7};
    bough.on.emplace(); // branch 1 at its base: bodies 4, 5, the twig 9
    bough.on->by = Selector::By::branch;
    bough.on->branch = 1;
    bough.on->at = 0;
    half.stiffness = {0.5};
    half.damping = {2};
    half.relative = true;
    half.on.emplace();
    half.on->by = Selector::By::level;
    half.on->level = 2;
    wood.curves = {all, bough, half};
    const WoodChanges changes = override_wood(tree, whole(tree), wood);
    const std::set<std::size_t> carried{4, 5, 9};
    for (std::size_t i = 0; i < 10; ++i) {
        CAPTURE(i);
        CHECK(tree.stiffness[i].x() == (i == 9 ? 3.5 : carried.count(i) ? 7 : 100));
        CHECK(tree.damping[i] == before.damping[i] * (i == 9 ? 2 : 1));
    }
    for (std::size_t i = 10; i < 14; ++i) CHECK(tree.stiffness[i] == before.stiffness[i]); // leaves, fruit
    CHECK(changes.stiffness == 10);
    CHECK(changes.damping == 1);
    CHECK(changes.mass == 0);
    // In the other order the curve for all is the last word but for none of its own.
    Tree other = before;
    wood.curves = {bough, all};
    override_wood(other, whole(other), wood);
    for (std::size_t i = 0; i < 10; ++i) CHECK(other.stiffness[i].x() == 100);
}

TEST_CASE("the way to a fork is the one along the branch by arc length, and stiffness falls along it") {
    std::vector<Tree> trees{make_tree::branched(), make_tree::chain(5, 2, 0.03, 0.01)};
    for (unsigned seed = 1; seed < 20; ++seed) trees.push_back(make_tree::random_tree(120, seed));
    for (const Tree& before : trees) {
        CAPTURE(before.name);
        const std::vector<double> found = way_to_fork(before), truth = ways_by_arc(before);
        for (std::size_t i = 0; i < found.size(); ++i) {
            CAPTURE(i);
            CHECK((found[i] == truth[i] || std::abs(found[i] - truth[i]) < 1e-12));
        }
        Tree tree = before;
        Wood wood;
        wood.fork = WoodFork{3, 0.4};
        const WoodChanges changes = override_wood(tree, whole(tree), wood);
        std::size_t near = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            near += truth[i] < 0.4;
            const double factor = 1 + 2 * std::max(0.0, 1 - truth[i] / 0.4);
            CHECK((tree.stiffness[i] - factor * before.stiffness[i]).norm() <= 1e-12 * tree.stiffness[i].norm());
        }
        CHECK(changes.near_forks == near);
    }
    // branched(): branch 1 leaves body 1 at 0.3 of 0.5 m: body 1's joint is 0.3 below it, body 2's 0.2 above, the side branch's at it.
    const std::vector<double> way = way_to_fork(trees[0]);
    CHECK(way[1] == Approx(0.3));
    CHECK(way[2] == Approx(0.2));
    CHECK(way[4] == 0);
    CHECK(way[5] == Approx(0.2)); // the twig leaves branch 1 at 0.2, body 5 goes on at 0.4
    CHECK(way[0] == Approx(0.8));
    CHECK(way[10] == INFINITY); // a leaf
    for (const double d : way_to_fork(trees[1])) CHECK(d == INFINITY);
}

TEST_CASE(
    "a selector that names no body is refused with its place; so is a scene whose wood or load is not in the tree") {
    Tree tree = make_tree::branched();
    Wood wood;
    wood.curves.resize(2);
    for (WoodCurve& curve : wood.curves) curve.radius = {0}, curve.stiffness = {1};
    wood.curves[1].on.emplace();
    wood.curves[1].on->body = 99;
    CHECK_THROWS_WITH(override_wood(tree, whole(tree), wood), Catch::StartsWith("wood/curves/1/on: body 99, but"));
    for (const Solver solver : all_solvers) {
        Scene scene;
        scene.wood.emplace();
        CHECK_THROWS_WITH(make_plan<double>(tree, whole(tree), scene, {}, 0.01, solver),
                          Catch::StartsWith("wood: is still in the scene"));
        scene.wood.reset();
        scene.load.emplace();
        CHECK_THROWS_WITH(make_plan<double>(tree, whole(tree), scene, {}, 0.01, solver),
                          Catch::StartsWith("load: is still in the scene"));
    }
}
