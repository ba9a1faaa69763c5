// What bough's growth adds to the paper's: pruning as the paper has it, blossoms, shared sections at splits, loads.
#include "lib/growth/carry.h"
#include "lib/growth/pipe.h"
#include "lib/growth/weber_penn.h"
#include "tests/support/grow_measure.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

using namespace bough;
using namespace bough::measure;

namespace {

// One straight branch from the origin along `direction`, in `pieces` even steps.
Splines beam(const Vec3& direction, double length, double radius, int pieces) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, pieces + 1};
    for (int k = 0; k <= pieces; ++k) {
        s.point.push_back(direction * (length * k / pieces));
        s.radius.push_back(radius);
    }
    return s;
}

void hang_fruit(Splines& s, double at, const Vec3& joint, double radius) {
    s.fruit_branch.push_back(0);
    s.fruit_at.push_back(at);
    s.fruit_position.push_back(joint);
    s.fruit_center.push_back(joint - Vec3(0, 2 * radius, 0));
    s.fruit_radius.push_back(radius);
}

// Turn of a branch under its load between base and tip, integrated over many short frustums: an independent sum.
double sag(const Splines& s, const Material& wood, double tip_mass) {
    const int steps = 20000;
    const double total = length(s, 0), step = total / steps;
    double mass = tip_mass, turned = 0;
    Vec3 moment = tip_mass * s.point.back();
    for (int i = steps - 1; i >= 0; --i) {
        const auto [p, r] = at(s, 0, (i + 0.5) / steps);
        const double piece = wood.density * pi * r * r * step;
        mass += piece;
        moment += piece * p;
        const double torque = 9.81 * (moment - mass * p).cross(Vec3::UnitY()).norm();
        turned += step * torque / (wood.youngs_modulus * pi / 4 * r * r * r * r);
    }
    return turned;
}

} // namespace

TEST_CASE("A crown that comes to a point: boughs from a cone's apex down, and a leafy shoot in which the trunk ends") {
    GrowthParameters p;
    p.levels = 3;
    p.scale = 10;
    p.ratio = 0.02;
    p.shape = 0; // a cone
    p.crown_top = 0.1;
    p.leading_shoot = 0.05;
    p.leaves = 12;
    p.leaf_distrib = 3;
    p.level[0].length = p.level[2].length = 1;
    p.level[1].branches = 40;
    p.level[1].length = 0.3;
    p.level[1].down_angle = 60;
    p.level[2].branches = 0;
    const Splines s = grow(p, 1, {.leaves = true});
    std::size_t shoots = 0;
    for (const std::size_t b : children(s, 0)) {
        if (s.level[b] == 2) {
            ++shoots;
            CHECK(s.parent_at[b] == 1);
            CHECK(length(s, b) == Approx(0.05 * 10));
            CHECK(angle(start_direction(s, b), end_direction(s, 0)) < 1e-6);
            CHECK(s.radius[first(s, b)] == Approx(s.radius[last(s, 0)]));
            CHECK(std::count(s.leaf_branch.begin(), s.leaf_branch.end(), std::int32_t(b)) == 12);
            continue;
        }
        // A straight line from 3 m at the ground to 0.3 m at the top.
        CHECK(length(s, b) == Approx(3 - 2.7 * s.parent_at[b]));
    }
    CHECK(shoots == 1);
    // At the foot and the top of each shape, whatever its own ratio there.
    for (const int shape : {0, 1, 2, 4, 5, 7}) {
        p.shape = shape;
        CHECK(crown_ratio(p, 10, 2, 10) == Approx(0.1));
        CHECK(crown_ratio(p, 10, 2,
                          2 + 8 * (1 - (shape == 1                 ? 0.5
                                        : shape == 5 || shape == 7 ? 0.7
                                                                   : 1.0))) == Approx(1));
    }
    p.shape = 3;
    CHECK_THROWS_WITH(grow(p, 1, {}), Catch::Contains("crown_top: is there with shape 3"));
}

TEST_CASE("A level branch is thickened until its load turns it by most_sag, no more") {
    const Material& wood = wood_presets().front();
    for (const double fruit : {0.0, 0.04, 0.1}) {
        INFO("fruit of radius " << fruit);
        Splines s = beam(Vec3::UnitX(), 2, 0.001, 40);
        const double mass = wood.fruit_density * 4 / 3 * pi * fruit * fruit * fruit;
        if (fruit > 0) hang_fruit(s, 1, s.point.back(), fruit);
        thicken_to_carry(s, wood, 0.3);
        const double turned = sag(s, wood, mass);
        CHECK(turned <= 0.3 * (fruit > 0 ? 1.2 : 1.01));
        CHECK(turned > 0.3 * 0.85); // where no other bound acts, the sag is used up
    }
}

TEST_CASE("What hangs straight down needs no thickness, what stands needs to stand") {
    const Material& wood = wood_presets().front();
    Splines hanging = beam(-Vec3::UnitY(), 3, 0.0005, 20);
    hang_fruit(hanging, 1, hanging.point.back(), 0.05);
    const std::vector<double> before = hanging.radius;
    thicken_to_carry(hanging, wood, 0.3);
    CHECK(hanging.radius == before);

    // A chain of many short rods on springs, under twice its weight: it stands if the matrix of its potential energy,
    // tridiagonal in the rods' tilts, has positive pivots only.
    const auto stands = [&](const Splines& s, double loads) {
        const int n = 2000;
        const double step = length(s, 0) / n;
        double above = 0, pivot = 0, coupling = 0;
        for (int i = n - 1; i >= 0; --i) {
            const double r = at(s, 0, (i + 0.5) / n).second, mass = wood.density * pi * r * r * step;
            const double joint = wood.youngs_modulus * pi / 4 * std::pow(at(s, 0, double(i) / n).second, 4) / step;
            double own = joint - loads * 9.81 * (above + mass / 2) * step;
            if (i < n - 1) own += coupling - coupling * coupling / pivot;
            if (own <= 0) return false;
            above += mass;
            pivot = own;
            coupling = joint;
        }
        return true;
    };
    Splines standing = beam(Vec3::UnitY(), 3, 0.0005, 40);
    CHECK_FALSE(stands(standing, 1));
    thicken_to_carry(standing, wood, 0.3);
    CHECK(stands(standing, 2));
    CHECK_FALSE(stands(standing, 20)); // and it is no pillar
}

TEST_CASE("A load that stands above a level branch does not roll it, one that stands on a pole does not topple it") {
    Material wood = wood_presets().front();
    wood.density = 1e-6; // what is borne is the load alone
    const double load = 0.05, length = 2;
    const double weight = 9.81 * wood.fruit_density * 4 / 3 * pi * load * load * load;
    const auto thickened = [&](const Vec3& direction, double above) {
        Splines s = beam(direction, length, 1e-4, 10);
        hang_fruit(s, 1, s.point.back(), load);
        s.fruit_center.back() = s.point.back() + Vec3(0, above, 0);
        thicken_to_carry(s, wood, 0.3);
        return s.radius;
    };
    const auto radius = [](double area_moment) { return std::pow(4 * area_moment / pi, 0.25); };
    for (const double above : {1.0, 3.0}) {
        // G J / L = 4 W h with J = 2 I, at every point: more than the sag asks for.
        const double rolls = radius(4 * weight * above * length / (2 * wood.shear_modulus));
        REQUIRE(rolls > radius(weight * length * length / (wood.youngs_modulus * 0.3)));
        for (const double r : thickened(Vec3::UnitX(), above)) CHECK(r == Approx(rolls).epsilon(1e-3));
        // On a pole E I / L = 4 W (h + what is left of the pole), and nothing to roll.
        const std::vector<double> pole = thickened(Vec3::UnitY(), above);
        for (std::size_t k = 0; k < pole.size(); ++k) {
            const double arm = above + length * (1 - double(k) / double(pole.size() - 1));
            CHECK(pole[k] == Approx(radius(4 * weight * arm * length / wood.youngs_modulus)).epsilon(1e-3));
        }
    }
    // What hangs as far below asks for the sag alone.
    const std::vector<double> below = thickened(Vec3::UnitX(), -3);
    CHECK(below.front() == Approx(radius(weight * length * length / (wood.youngs_modulus * 0.3))).epsilon(1e-3));
    CHECK(below.back() == 1e-4);
}

TEST_CASE("The pipe model's exponent rises until the tips make no thicker a trunk") {
    // A trunk of radius 0.1 with n twigs of 1 mm: at exponent e the twigs need n^(1/e) mm.
    for (const int n : {100, 20000, 200000}) {
        Splines s = beam(Vec3::UnitY(), 5, 0.1, 10);
        s.radius.back() = 0.001;
        for (int i = 0; i < n; ++i) {
            s.parent.push_back(0);
            s.parent_at.push_back((i + 0.5) / n);
            s.level.push_back(1);
            for (int k = 0; k < 2; ++k)
                s.point.push_back({0.1 * k, 5 * s.parent_at.back(), 0}), s.radius.push_back(0.001);
            s.first_point.push_back(std::int32_t(s.points()));
        }
        const double e = exponent_for_trunk(s, 2);
        const double expected = std::max(2.0, std::log(n + 1.0) / std::log(100.0));
        CHECK(e == Approx(expected).margin(2e-3));
        thicken_by_pipe_model(s, e);
        CHECK(s.radius[0] == Approx(0.1).epsilon(2e-3));
    }
}

TEST_CASE("Pruned stems stay inside the envelope, unpruned ones do not") {
    GrowthParameters p = default_growth();
    p.level[0].curve_v = p.level[0].seg_splits = 0;
    p.scale_v = 0;
    p.pipe_exponent = p.most_sag = 0;
    p.prune_width = 0.2;
    p.prune_width_peak = 0.6;
    p.prune_power_low = 0.5;
    p.prune_power_high = 0.7;
    // The envelope by the paper's words: a curve of revolution, of radius width * length at its peak.
    const auto outside = [&](const Splines& s) {
        std::size_t number = 0;
        const double height = length(s, 0), base = p.level[0].base_size * height;
        for (std::size_t b = 0; b < s.branches(); ++b)
            for (std::size_t i = first(s, b); s.level[b] > 0 && i <= last(s, b); ++i) {
                const double up = (s.point[i].y() - base) / (height - base);
                const double peak = p.prune_width_peak;
                const double share = up <= 0 || up >= 1 ? 0
                                     : up > peak        ? std::pow((1 - up) / (1 - peak), p.prune_power_high)
                                                        : std::pow(up / peak, p.prune_power_low);
                number += std::hypot(s.point[i].x(), s.point[i].z()) > 1.0001 * height * p.prune_width * share + 1e-6;
            }
        return number;
    };
    const Splines wild = grow(p, 3, {});
    p.prune_ratio = 1;
    const Splines cut = grow(p, 3, {});
    CHECK(outside(wild) > wild.points() / 3);
    CHECK(outside(cut) < cut.points() / 100); // what starts outside its own reach cannot be cut back inside
    CHECK(cut.branches() > 200);
    p.prune_ratio = 0.5;
    const std::size_t half = outside(grow(p, 3, {}));
    CHECK(half > outside(cut));
    CHECK(half < outside(wild));
}

TEST_CASE("What hangs leaves on the lower side of a level bearer, as far to the side; a plumb one keeps its sides") {
    // Boughs stand out level from a plumb trunk. What leaves them is measured across them: up, and to the side.
    for (const double rotate : {140.0, -90.0}) {
        GrowthParameters p = plain(3);
        p.level[1].down_angle = 90;
        p.level[2].rotate = rotate;
        p.level[2].attraction_up = -2.9;
        const Splines free = grow(p, 1, {});
        p.level[2].attraction_up = -5;
        const Splines hung = grow(p, 1, {});
        REQUIRE(hung.branches() == free.branches());
        double left = 0, right = 0, upper = 0;
        for (const std::size_t b : of_level(hung, 2)) {
            const Vec3 bough = start_direction(hung, std::size_t(hung.parent[b]));
            REQUIRE(std::abs(bough.y()) < 1e-9);
            const Vec3 side = bough.cross(Vec3::UnitY()), was = start_direction(free, b), is = start_direction(hung, b);
            CHECK(is.dot(bough) == Approx(was.dot(bough)).margin(1e-9));
            CHECK(is.dot(side) == Approx(was.dot(side)).margin(1e-9));
            CHECK(is.y() == Approx(-std::abs(was.y())).margin(1e-9));
            upper += was.y() > 0.1;
            (is.dot(side) > 0 ? right : left) += 1;
        }
        CHECK(left / (left + right) == Approx(0.5).margin(0.1));
        CHECK((rotate < 0) == (upper == 0));
    }
    GrowthParameters p = plain(2);
    p.level[1].attraction_up = -5;
    const Splines s = grow(p, 1, {});
    const std::vector<std::size_t> boughs = of_level(s, 1);
    REQUIRE(boughs.size() == 8);
    for (std::size_t k = 1; k < boughs.size(); ++k) {
        Vec3 a = start_direction(s, boughs[k - 1]), b = start_direction(s, boughs[k]);
        a.y() = b.y() = 0;
        CHECK(angle(a, b) == Approx(140).margin(1e-6));
    }
}

TEST_CASE("Flowers have their petals round them, as long as asked for") {
    GrowthParameters p = default_growth();
    p.blossoms = 3;
    p.petals = 6;
    p.petal_scale = 0.02;
    const Splines s = grow(p, 1, {false, true, false});
    REQUIRE(s.leaves() > 600);
    REQUIRE(s.leaves() % 6 == 0);
    for (std::size_t f = 0; f < s.leaves(); f += 6) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = f; k < f + 6; ++k) {
            REQUIRE(s.is_petal(k));
            REQUIRE(s.leaf_position[k] == s.leaf_position[f]);
            REQUIRE(s.leaf_length[k] == 0.02);
            sum += s.leaf_rotation[k] * Vec3::UnitZ();
        }
        // What is left of six directions spread evenly is along the flower's axis: 35 degrees out of its plane each.
        REQUIRE(sum.norm() == Approx(6 * std::sin(35 * pi / 180)));
        for (std::size_t k = f; k < f + 6; ++k)
            REQUIRE(angle(sum, s.leaf_rotation[k] * Vec3::UnitZ()) == Approx(90 - 35));
    }
    CHECK(grow(p, 1, {true, false, false}).leaf_kind.empty());
}

TEST_CASE("A split trunk's parts share its section") {
    GrowthParameters p;
    p.levels = 1;
    p.level[0].branches = 1;
    p.level[0].length = 1;
    p.level[0].taper = 0;
    p.level[0].curve_res = 4;
    p.level[0].base_splits = 2;
    p.level[0].split_angle = 20;
    p.split_exponent = 2;
    const Splines s = grow(p, 1, {});
    REQUIRE(s.branches() == 3);
    const double before = s.radius[first(s, 0)];
    double section = 0;
    for (std::size_t b = 0; b < 3; ++b) section += std::pow(s.radius[last(s, b)], 2);
    CHECK(section == Approx(before * before));
}

TEST_CASE("A paraboloid has half the volume of its cylinder") {
    GrowthParameters p;
    p.levels = 1;
    p.scale = 10;
    p.level[0].branches = 1;
    p.level[0].length = 1;
    p.level[0].curve_res = 200;
    p.level[0].taper_power = 0.5;
    const Splines s = grow(p, 1, {});
    double volume = 0;
    for (std::size_t i = 0; i + 1 < s.points(); ++i) {
        const double a = s.radius[i], b = s.radius[i + 1];
        volume += (a * a + a * b + b * b) / 3 * (s.point[i + 1] - s.point[i]).norm();
    }
    CHECK(volume == Approx(0.5 * std::pow(s.radius[0], 2) * 10).epsilon(0.01));
}

TEST_CASE("A tree of fewer bodies keeps its leaf area") {
    const auto area = [](std::int64_t bodies) {
        const Splines s = grow_bodies(default_growth(), 2, {true, false, false}, bodies);
        double sum = 0;
        for (std::size_t i = 0; i < s.leaves(); ++i) sum += 0.5 * s.leaf_length[i] * s.leaf_width[i];
        return sum;
    };
    const double whole = area(20000);
    for (const std::int64_t bodies : {5000, 10000, 40000, 80000}) CHECK(area(bodies) == Approx(whole).epsilon(0.5));
}
