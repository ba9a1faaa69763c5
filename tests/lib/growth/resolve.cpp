// lib/growth/resolve.h: one tree, whatever its number of bodies: what the whole tree weighs, how it sways and what the wind takes hold of, against the
// whole tree's own, and a rod's closed forms.
#include "lib/growth/resolve.h"
#include "formats/documents/species.h"
#include "lib/growth/segment.h"
#include "lib/laws/air.h"
#include "lib/model/drawn_pose.h"
#include "lib/plan/reduce.h"
#include "lib/study/modes.h"
#include "tests/support/hand_made.h"
#include "tests/support/sanitized.h"
#include <numbers>
#include <numeric>

using namespace bough;
using namespace hand_made;

namespace {

using std::numbers::pi;

struct Measured {
    double height = 0, wood = 0, leaves = 0, area = 0, drag = 0;
};

// Leaves by their sizes, wood by what is left; drag at 8 m/s as drawn, mean over eight horizontal winds.
Measured measured(const Tree& tree, const Material& wood) {
    const DrawnPose pose = drawn_pose(tree);
    Measured m;
    double mass = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        mass += tree.mass[i];
        const Kind kind = kind_in_air(tree, i);
        if (is_foliage(kind)) {
            m.area += foliage_area(tree, i);
            m.leaves += foliage_area(tree, i) * tree.size[i][2] * wood.leaf_density;
        } else {
            m.height = std::max(m.height, pose.at(i, Vec3(0, 0, tree.size[i][0])).y());
        }
        for (int k = 0; k < 8; ++k) {
            const Vec3 u = 8 * Vec3(std::cos(k * pi / 4), 0, std::sin(k * pi / 4));
            m.drag += drag_area(tree, i, kind, 1.2) * air_force(kind, pose.R_wb[i], u).force.dot(u) / 64;
        }
    }
    m.wood = mass - m.leaves;
    return m;
}

std::vector<NaturalMode> three_modes(const Tree& tree) {
    ModeOptions options;
    options.count = 3;
    return natural_modes(SmallMotion(tree, Vec3(0, -9.81, 0), Pose::drawn), tree, Scene(), options);
}

double mean_damping(const std::vector<NaturalMode>& modes) {
    double sum = 0;
    for (const NaturalMode& mode : modes) sum += mode.damping / double(modes.size());
    return sum;
}

// The whole tree, resolved by so many bodies.
Tree resolved(const GrowthParameters& parameters, const Items& items, std::int64_t bodies, const Material& wood) {
    Splines splines = grow(parameters, 1, items);
    splines.bodies = bodies;
    return segment(splines, wood, {});
}

const Material& wood_for(const Species& species) {
    const Material* const wood = find_wood(species.material);
    return wood ? *wood : wood_presets().front();
}

} // namespace

TEST_CASE("All eight species are one tree from 300 bodies on: height, masses, leaf area, drag") {
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        const Material& wood = wood_for(species);
        const Items in_leaf{true, false, false};
        const Measured whole = measured(segment(grow(species.growth, 1, in_leaf), wood, {}), wood);
        for (const std::int64_t bodies : cases<std::int64_t>(1, {300, 1000, 10000, 100000})) {
            const Tree tree = resolved(species.growth, in_leaf, bodies, wood);
            const Measured now = measured(tree, wood);
            INFO(species.name << ", " << tree.size_bodies() << " bodies");
            CHECK_FALSE(check(tree));
            CHECK(double(tree.size_bodies()) == Approx(double(bodies)).epsilon(0.1));
            CHECK(now.height == Approx(whole.height).epsilon(0.1));
            CHECK(now.wood == Approx(whole.wood).epsilon(0.1));
            CHECK(now.leaves == Approx(whole.leaves).epsilon(0.1));
            CHECK(now.area == Approx(whole.area).epsilon(0.1));
            CHECK(now.drag == Approx(whole.drag).epsilon(0.1));
        }
    }
}

TEST_CASE("All eight species sway as the whole tree does: three frequencies, and their damping") {
    // Young, for the whole tree's modes are to be found. A young palm's lowest are those of its softest leaves, one by one, which nothing but themselves stand
    // for; a mature one's are its stem's. A willow has hundreds of alike hanging shoots: its lowest modes are those of the softest few.
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        const GrowthParameters young = at_age(species, (file.name == "palm" ? 1 : 0.2) * species.mature_age);
        const double within = file.name == "willow" ? 0.2 : 0.1;
        const Material& wood = wood_for(species);
        const Items in_leaf{true, false, false};
        const std::vector<NaturalMode> whole = three_modes(segment(grow(young, 1, in_leaf), wood, {}));
        for (const std::int64_t bodies : cases<std::int64_t>(1, {300, 1000, 3000})) {
            const std::vector<NaturalMode> now = three_modes(resolved(young, in_leaf, bodies, wood));
            INFO(species.name << ", " << bodies << " bodies");
            for (std::size_t k = 0; k < whole.size(); ++k)
                CHECK(now[k].frequency == Approx(whole[k].frequency).epsilon(within));
            CHECK(mean_damping(now) == Approx(mean_damping(whole)).epsilon(within));
        }
        if (sanitized) break;
    }
}

TEST_CASE("A level rod of one body bends as under its own weight, and sways at Rayleigh's quotient of a straight one") {
    // S = m^2 l^3 / (20 E I) an axis, K = (m l / 2)^2 / S = 5 E I / l: omega^2 = K / (m l^2 / 3).
    Splines s;
    const double l = 1, r = 0.02;
    add_branch(s, -1, 0, {{0, 1, 0}, {l, 1, 0}}, {r, r});
    SegmentOptions fine = length_of(0.005);
    Tree rod = segment(s, wood(), fine);
    rod = resolve(rod, 1);
    REQUIRE(rod.size_bodies() == 1);
    const double bend = 5 * wood().youngs_modulus * pi / 4 * std::pow(r, 4) / l;
    CHECK(rod.stiffness[0].x() == Approx(bend).epsilon(2e-3)); // its weight stands level, and takes nothing from it
    CHECK(rod.stiffness[0].y() == Approx(bend).epsilon(2e-3));
    CHECK(rod.size[0].x() == Approx(l));
}
