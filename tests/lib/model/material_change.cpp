// A tree whose material is changed against one that was cut with the changed material in the first place.
#include "lib/model/material_change.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include <catch2/catch.hpp>
#include <cstring>

using namespace bough;

namespace {

Splines apple() {
    static const Splines splines = [] { // small, and whole: by fewer bodies, what a material gives is matched anew
        GrowthParameters p = default_growth();
        p.levels = 2;
        return grow(p, 5, {true, false, true});
    }();
    return splines;
}

Tree cut(const Material& material) {
    Tree tree = segment(apple(), material, {});
    tree.material = material.name;
    return tree;
}

void check_same(const Tree& a, const Tree& b) {
    REQUIRE(a.size_bodies() == b.size_bodies());
    for (std::size_t i = 0; i < a.size_bodies(); ++i) {
        INFO("body " << i);
        CHECK(a.mass[i] == Approx(b.mass[i]).epsilon(1e-12));
        CHECK((a.inertia[i] - b.inertia[i]).norm() <= 1e-12 * b.inertia[i].norm());
        CHECK((a.com[i] - b.com[i]).norm() <= 1e-15);
        CHECK((a.stiffness[i] - b.stiffness[i]).norm() <= 1e-12 * b.stiffness[i].norm());
        CHECK(a.damping[i] == Approx(b.damping[i]).epsilon(1e-11));
    }
}

} // namespace

TEST_CASE("a changed material gives the tree that this material would have given") {
    const Material own = *find_wood("red-maple");
    REQUIRE(apple().leaves() > 0);
    struct Case {
        MaterialChange change;
        Material wanted;
    };
    std::vector<Case> cases(5, {{}, own});
    cases[0].change.youngs_modulus = cases[0].wanted.youngs_modulus = 4e9;
    cases[0].wanted.shear_modulus = own.shear_modulus * 4e9 / own.youngs_modulus; // goes with E
    cases[1].change.shear_modulus = cases[1].wanted.shear_modulus = 1e9;
    cases[2].change.density = cases[2].wanted.density = 450;
    cases[3].change.damping_ratio = cases[3].wanted.damping_ratio = 0.2;
    cases[4].change = {2e10, 7e8, 1200, 0, {}};
    cases[4].wanted.youngs_modulus = 2e10;
    cases[4].wanted.shear_modulus = 7e8;
    cases[4].wanted.density = 1200;
    cases[4].wanted.damping_ratio = 0;
    for (const Case& c : cases) {
        Tree tree = cut(own);
        change_material(tree, c.change);
        check_same(tree, cut(c.wanted));
        REQUIRE(check(tree) == std::nullopt);
    }
}

TEST_CASE("nothing to change changes no bit, of any tree") {
    Tree tree = cut(*find_wood("apple"));
    tree.material = "what grew behind the house";
    const Tree before = tree;
    change_material(tree, {});
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK(tree.stiffness[i] == before.stiffness[i]);
        CHECK(tree.mass[i] == before.mass[i]);
        CHECK(tree.damping[i] == before.damping[i]);
    }
}

TEST_CASE("a changed tree is no longer one of the preset's wood") {
    Tree tree = cut(*find_wood("apple"));
    MaterialChange change;
    change.youngs_modulus = 2e10;
    change_material(tree, change);
    CHECK(tree.material == "apple (changed)");
    CHECK_THROWS_WITH(change_material(tree, change), Catch::StartsWith("is \"apple (changed)\", so that its numbers"));
}

TEST_CASE("what was edited in a tree keeps its proportion") {
    Tree tree = cut(*find_wood("apple")), edited = tree;
    edited.stiffness[3] *= 7;
    MaterialChange change;
    change.youngs_modulus = 1e10;
    change_material(tree, change);
    change_material(edited, change);
    CHECK((edited.stiffness[3] - 7 * tree.stiffness[3]).norm() <= 1e-12 * edited.stiffness[3].norm());
}

TEST_CASE("the wood of a tree that names no preset cannot be changed") {
    Tree tree = cut(*find_wood("apple"));
    MaterialChange change;
    change.density = 800;
    tree.material = "my.json";
    CHECK_THROWS_WITH(change_material(tree, change), Catch::StartsWith("is \"my.json\", so that its numbers"));
    tree.material.clear();
    CHECK_THROWS_WITH(change_material(tree, change), Catch::StartsWith("is not named, so that"));
}
