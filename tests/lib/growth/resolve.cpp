// lib/growth/resolve.h: one tree, whatever its number of bodies: what the whole tree weighs, how it sways and what the wind takes hold of,
// against the whole tree's own, and a rod's closed forms.
#include "lib/growth/resolve.h"
#include "formats/documents/species.h"
#include "lib/growth/flexibility.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/laws/air.h"
#include "lib/model/drawn_pose.h"
#include "lib/plan/body_air.h"
#include "lib/plan/reduce.h"
#include "lib/study/modes.h"
#include "tests/support/hand_made.h"
#include "tests/support/sanitized.h"
#include <Eigen/Cholesky>
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
            const AirBody<double> body = streaming(air_body(tree, i, Scene()), leaf_proportion(tree, i), pose.R_wb[i]);
            m.drag +=
                body.drag_area * air_force(body.kind, pose.R_wb[i], u, body.facing, body.normal).force.dot(u) / 64;
        }
    }
    m.wood = mass - m.leaves;
    return m;
}

// [kg], [kg m] and [kg m^2] about the origin, the world's axes.
struct Spread {
    double mass = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
};

Spread spread_of(const Tree& tree) {
    const DrawnPose pose = drawn_pose(tree);
    Spread s;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 c = pose.at(i, tree.com[i]);
        s.mass += tree.mass[i];
        s.first += tree.mass[i] * c;
        s.second += pose.R_wb[i] * tree.inertia[i] * pose.R_wb[i].transpose() +
                    tree.mass[i] * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
    }
    return s;
}

// Three frequencies [Hz], and the mean of their damping ratios in still air, and in 8 m/s along each way.
struct Sways {
    std::vector<double> frequency;
    double still = 0, damping = 0;
};

using Ways = std::vector<Vec3>;

Sways sways(const Tree& tree, const Ways& ways) {
    ModeOptions options;
    options.count = 3;
    const SmallMotion small(tree, Vec3(0, -9.81, 0), Pose::drawn);
    CHECK(small.buckled().empty());
    Sways s;
    options.air = true;
    for (const Vec3& way : ways) {
        Scene scene;
        scene.wind.emplace().velocity = 8 * way;
        s.frequency.clear();
        for (const NaturalMode& mode : natural_modes(small, tree, scene, options)) {
            s.frequency.push_back(mode.frequency);
            s.damping += mode.damping / double(3 * ways.size());
            s.still += mode.wood / double(3 * ways.size());
        }
    }
    return s;
}

// sways_within: of frequencies. damped_within: of damping in wind.
struct Allowed {
    double sways_within, damped_within;
};

void check_sways(const Tree& tree, const Sways& whole, const Allowed& allowed, const Ways& ways) {
    const Sways now = sways(tree, ways);
    for (std::size_t k = 0; k < whole.frequency.size(); ++k)
        CHECK(now.frequency[k] == Approx(whole.frequency[k]).epsilon(allowed.sways_within));
    CHECK(now.still == Approx(whole.still).epsilon(0.25));
    CHECK(now.damping == Approx(whole.damping).epsilon(allowed.damped_within));
}

void check_one_tree(const GrowthParameters& growth, const Material& wood, std::initializer_list<std::int64_t> numbers,
                    const Allowed& allowed) {
    const Ways ways = {Vec3::UnitX(), Vec3::UnitZ()};
    Splines splines = grow(growth, 1, {true, false, false});
    const Sways whole = sways(segment(splines, wood, {}), ways);
    for (const std::int64_t bodies : cases<std::int64_t>(1, numbers)) {
        ask_for_bodies(splines, bodies);
        INFO(growth.name << ", " << bodies << " bodies");
        check_sways(segment(splines, wood, {}), whole, allowed, ways);
    }
}

const Material& wood_for(const Species& species) {
    const Material* const wood = find_wood(species.material);
    return wood ? *wood : wood_presets().front();
}

} // namespace

TEST_CASE("All eight species, full-grown, are one tree from 300 bodies on: height, masses, leaf area, drag, and three "
          "of them sway so") {
    // tests/budgets has more: all of them, and up to a million bodies. An oak's leaves face up, and so do its clumps (Tree::leaf_facing): with none that do, a
    // fifth of its damping is missing.
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        const Material& wood = wood_for(species);
        Splines splines = grow(species.growth, 1, {true, false, false});
        const Tree all = segment(splines, wood, {});
        const Measured whole = measured(all, wood);
        const bool sways_too = !sanitized && (file.name == "oak" || file.name == "cherry" || file.name == "apple");
        const Ways ways = {Vec3::UnitX(), Vec3::UnitZ()};
        const Sways as_whole = sways_too ? sways(all, ways) : Sways();
        for (const std::int64_t bodies : cases<std::int64_t>(1, {300, 1000, 10000})) {
            ask_for_bodies(splines, bodies);
            const Tree tree =
                bodies < std::int64_t(all.size_bodies()) ? resolve(all, bodies) : segment(splines, wood, {});
            const Measured now = measured(tree, wood);
            INFO(species.name << ", " << tree.size_bodies() << " bodies");
            CHECK_FALSE(check(tree));
            for (const Mat3& I : tree.inertia) // also what breaks off turns: by Sylvester's minors
                REQUIRE((I(0, 0) > 0 && I.topLeftCorner<2, 2>().determinant() > 0 && I.determinant() > 0));
            CHECK(double(tree.size_bodies()) == Approx(double(bodies)).epsilon(0.1));
            CHECK(now.height == Approx(whole.height).epsilon(0.1));
            CHECK(now.wood == Approx(whole.wood).epsilon(0.1));
            CHECK(now.leaves == Approx(whole.leaves).epsilon(0.1));
            CHECK(now.area == Approx(whole.area).epsilon(0.1));
            CHECK(now.drag == Approx(whole.drag).epsilon(0.1));
            if (sways_too)
                check_sways(tree, as_whole, file.name == "oak" ? Allowed{0.02, 0.1} : Allowed{0.01, 0.08}, ways);
        }
    }
}

TEST_CASE("All eight species sway as the whole tree does: three frequencies, and their damping") {
    // Young, for the whole tree's modes are to be found; a young palm's lowest are those of its softest leaves, one by one, which nothing
    // but themselves stand for.
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        check_one_tree(at_age(species, (file.name == "palm" ? 1 : 0.2) * species.mature_age), wood_for(species),
                       {300, 1000, 3000}, {0.05, 0.1});
        if (sanitized) break;
    }
}

TEST_CASE("Where the mass of what is left out is, none is lost: a tree's centre of mass and inertia stay") {
    for (const SpeciesFile& file : species_files()) {
        if (file.name != "cherry" && file.name != "oak") continue;
        const Species species = read_species(file.content, std::string(file.name));
        Splines splines = grow(at_age(species, 0.3 * species.mature_age), 1, Items{true, false, false});
        const Spread whole = spread_of(segment(splines, wood_for(species), {}));
        for (const std::int64_t bodies : {100, 300, 3000}) {
            ask_for_bodies(splines, bodies);
            const Spread now = spread_of(segment(splines, wood_for(species), {}));
            INFO(species.name << ", " << bodies << " bodies");
            CHECK(now.mass == Approx(whole.mass).epsilon(1e-9));
            CHECK((now.first - whole.first).norm() < 1e-9 * whole.first.norm());
            CHECK((now.second - whole.second).norm() < 1e-9 * whole.second.norm());
        }
    }
}

TEST_CASE("A tree gives as much, shaken just below its own frequency, on however many bodies") {
    for (const SpeciesFile& file : species_files()) {
        if (file.name != "cherry") continue;
        const Species species = read_species(file.content, std::string(file.name));
        Splines splines = grow(at_age(species, 0.3 * species.mature_age), 1, Items{true, false, false});
        const Flexibility whole = flexibility_at_sway(segment(splines, wood_for(species), {}));
        REQUIRE(whole.stands);
        for (const std::int64_t bodies : {100, 300, 1000}) {
            ask_for_bodies(splines, bodies);
            const Flexibility now = flexibility(segment(splines, wood_for(species), {}), whole.omega2);
            INFO(bodies << " bodies");
            CHECK(now.stands);
            CHECK(now.whole[0] == Approx(whole.whole[0]).epsilon(1e-4));
        }
    }
}

TEST_CASE("A clump is where the air takes hold of its leaves, not where most of its wood is") {
    // Boughs that taper to threads: a cone's centre of mass is a quarter of the way out. They weigh more than their large leaves, which are at their
    // ends.
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 4, 0}}, {0.1, 0.05});
    Vec3 leaves = Vec3::Zero(), mass = Vec3::Zero();
    for (int k = 0; k < 40; ++k) {
        const double y = 2 + 0.02 * k;
        const Vec3 out(std::cos(0.08 * k), 0, std::sin(0.08 * k)), base(0, y, 0), end = base + out;
        add_branch(s, 0, y / 4, {base, end}, {0.008, 0.0001});
        add_leaf(s, k + 1, 1, end);
        s.leaf_length.back() = 0.5;
        s.leaf_width.back() = 0.4;
        leaves += end / 40;
    }
    const Tree whole = segment(s, wood(), length_of(0.1)), tree = resolve(whole, 2);
    const DrawnPose pose = drawn_pose(tree);
    REQUIRE(tree.size_bodies() == 2);
    REQUIRE(is_clump(tree, 1));
    const DrawnPose drawn = drawn_pose(whole);
    double all = 0;
    for (std::size_t i = 0; i < whole.size_bodies(); ++i) {
        if (whole.kind[i] == Kind::branch && whole.level[i] == 0) continue;
        all += whole.mass[i];
        mass += whole.mass[i] * drawn.at(i, whole.com[i]);
    }
    const Vec3 middle = pose.at(1, tree.com[1]);
    INFO(middle.transpose() << " is not near " << leaves.transpose() << ", but " << (mass / all).transpose());
    CHECK((middle - leaves).norm() < 0.6 * (mass / all - leaves).norm()); // the wood meets the air too
    CHECK((spread_of(tree).first - spread_of(whole).first).norm() < 1e-9 * spread_of(whole).first.norm());
}

TEST_CASE("A level rod of one body sways as the beam does") {
    // omega^2 = 1.8751^4 E I / (m l^3), of a rigid rod K / (m l^2 / 3). Its weight stands level, and takes nothing from it.
    Splines s;
    const double l = 1, r = 0.02;
    add_branch(s, -1, 0, {{0, 1, 0}, {l, 1, 0}}, {r, r});
    Tree rod = segment(s, wood(), length_of(0.005));
    rod = resolve(rod, 1);
    REQUIRE(rod.size_bodies() == 1);
    const double bend = std::pow(1.8751, 4) / 3 * wood().youngs_modulus * pi / 4 * std::pow(r, 4) / l;
    CHECK(rod.stiffness[0].x() == Approx(bend).epsilon(0.02));
    CHECK(rod.stiffness[0].y() == Approx(bend).epsilon(0.02));
    CHECK(rod.size[0].x() == Approx(l));
}

TEST_CASE("Of branches that are all alike some are resolved, not all or none") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 10, 0}}, {0.2, 0.1});
    for (int k = 0; k < 1000; ++k) {
        const double at = 0.1 + 0.0008 * k, y = 10 * at, angle = 2.4 * k;
        const Vec3 out(std::cos(angle), 0, std::sin(angle));
        add_branch(s, 0, at, {Vec3(0, y, 0) + 0.1 * out, Vec3(0, y, 0) + 0.6 * out}, {0.004, 0.004});
    }
    const Tree whole = segment(s, wood(), length_of(0.25));
    for (const std::int64_t bodies : {100, 500, 900, 1500}) {
        INFO(bodies);
        CHECK(double(resolve(whole, bodies).size_bodies()) == Approx(double(bodies)).epsilon(0.1));
    }
}

TEST_CASE("What topples is not matched: joints keep to what their parts' are, and something still topples") {
    // A mast of 4 m that cannot carry what it bears, on a trunk that can, among boughs.
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 2, 0}}, {0.06, 0.05});
    add_branch(s, 0, 1, {{0, 2, 0}, {0.1, 6, 0}}, {0.006, 0.006});
    for (int k = 0; k < 40; ++k) {
        const double angle = 2.4 * k, y = 2.2 + 0.09 * k;
        const Vec3 out(std::cos(angle), 0.2, std::sin(angle)), on(0.1 * (y - 2) / 4, y, 0);
        add_branch(s, 1, (y - 2) / 4, {on, on + 0.4 * out}, {0.004, 0.003});
        add_leaf(s, k + 2, 1, on + 0.42 * out);
    }
    const Tree whole = segment(s, wood(), length_of(0.2));
    REQUIRE_FALSE(SmallMotion(whole, Vec3(0, -9.81, 0), Pose::drawn).buckled().empty());
    double stiffest = 0, damping = 0;
    for (std::size_t i = 0; i < whole.size_bodies(); ++i) {
        stiffest = std::max(stiffest, whole.stiffness[i].maxCoeff());
        damping = std::max(damping, whole.damping[i]);
    }
    for (const std::int64_t bodies : {120, 60, 20}) {
        const Tree tree = resolve(whole, bodies);
        INFO(bodies);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            CHECK(tree.stiffness[i].maxCoeff() <= stiffest * (1 + 1e-9));
            CHECK(tree.damping[i] <= damping * (1 + 1e-9));
        }
        CHECK_FALSE(SmallMotion(tree, Vec3(0, -9.81, 0), Pose::drawn).buckled().empty());
    }
}

TEST_CASE("Fruit is kept where there is room for it; what is not is still weight and drag") {
    for (const SpeciesFile& file : species_files()) {
        if (file.name != "apple") continue;
        const Species species = read_species(file.content, std::string(file.name));
        const Material& wood = wood_for(species);
        const GrowthParameters young = at_age(species, 8);
        const Items fruit{false, false, true};
        const Splines splines = grow(young, 1, fruit);
        const Measured whole = measured(segment(splines, wood, {}), wood);
        for (const std::int64_t bodies : {100, 300, 1000}) {
            SegmentReport report;
            const Tree tree = segment(grow_bodies(young, 1, fruit, bodies), wood, {}, &report);
            const Measured now = measured(tree, wood);
            const auto kept = std::count(tree.kind.begin(), tree.kind.end(), Kind::fruit);
            INFO(bodies << " bodies, " << splines.fruits() << " fruit, " << kept << " kept");
            CHECK(kept >= std::min(std::ptrdiff_t(splines.fruits()), std::ptrdiff_t(bodies / 5)));
            CHECK(std::ptrdiff_t(splines.fruits()) - kept == report.joined_fruit);
            CHECK(now.wood == Approx(whole.wood).epsilon(1e-6)); // and fruit
            CHECK(now.drag == Approx(whole.drag).epsilon(0.04));
        }
    }
}

TEST_CASE("A tree whose top is a thousand branches up has no more bodies than asked for") {
    Splines s;
    for (int k = 0; k < 1000; ++k) {
        const Vec3 from(0, 0.01 * k, 0);
        add_branch(s, k - 1, 1, {from, from + Vec3(0, 0.01, 0)}, {0.05, 0.05});
    }
    CHECK(resolve(segment(s, wood(), {}), 100).size_bodies() <= 100);
}

TEST_CASE("Clumps of more leaves than a body counts keep the leaves' area") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 2, 0}}, {0.1, 0.1});
    for (int k = 0; k < 4; ++k) {
        add_leaf(s, 0, 0.9, {0.1, 1.8, 0});
        s.leaf_count.push_back(1'000'000'000);
    }
    const Tree whole = segment(s, wood(), {}), tree = resolve(whole, 2);
    double before = 0, now = 0;
    for (std::size_t i = 0; i < whole.size_bodies(); ++i)
        if (is_flat(whole.kind[i])) before += foliage_area(whole, i);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (is_flat(tree.kind[i])) now += foliage_area(tree, i);
    CHECK(now == Approx(before).epsilon(1e-9));
}
