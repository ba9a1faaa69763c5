// grow.h against Weber and Penn's closed formulas, worked out here by hand, and against geometry measured on the result.
#include "lib/growth/weber_penn.h"
#include "tests/support/grow_measure.h"
#include <limits>
#include <map>

using namespace bough;
using namespace bough::measure;

TEST_CASE("The shape ratio is the paper's table") {
    const double s1 = std::sqrt(0.5);
    const double expected[8][3] = {{0.2, 0.6, 1},   {0.2, 1, 0.2}, {0.2, 0.2 + 0.8 * s1, 1}, {1, 1, 1}, {0.5, 0.75, 1},
                                   {0, 5.0 / 7, 0}, {1, 0.6, 0.2}, {0.5, 0.5 + 2.5 / 7, 0.5}};
    for (int shape = 0; shape < 8; ++shape)
        for (int i = 0; i < 3; ++i) CHECK(shape_ratio(shape, 0.5 * i) == Approx(expected[shape][i]).margin(1e-15));
    CHECK(shape_ratio(5, 0.7) == Approx(1));
    CHECK(shape_ratio(7, 0.85) == Approx(0.75));
}

TEST_CASE("Trunk and first branches have the paper's lengths, radii, angles and places") {
    GrowthParameters p = plain(2);
    const Splines s = grow(p, 1, {});
    check_sound(s);
    REQUIRE(s.branches() == 9);
    CHECK((s.point[last(s, 0)] - Vec3(0, 12, 0)).norm() < 1e-12);
    CHECK(s.radius[0] == Approx(0.24));
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t b = i + 1;
        const double offset = 3 + (double(i) + 0.5) / 8 * 9;
        const double ratio = (12 - offset) / 9;
        const double l = 12 * 0.3 * (0.2 + 0.8 * ratio);
        CHECK(s.parent_at[b] == Approx(offset / 12));
        CHECK(length(s, b) == Approx(l));
        CHECK(s.radius[first(s, b)] == Approx(std::min(0.24 * std::pow(l / 12, 1.3), 0.24 * (1 - offset / 12))));
        CHECK(angle(start_direction(s, b), Vec3::UnitY()) == Approx(60));
        if (b > 1) {
            const Vec3 a = start_direction(s, b - 1), c = start_direction(s, b);
            // Azimuth turns by 140 degrees counterclockwise about the trunk, seen against +Y.
            const double turn = std::atan2(a.z() * c.x() - a.x() * c.z(), a.x() * c.x() + a.z() * c.z());
            CHECK(turn * 180 / pi == Approx(140));
        }
    }
}

TEST_CASE("Deeper stems shorten along their parent and come in the paper's numbers") {
    GrowthParameters p = plain(4);
    p.level[3].length = 0.4;
    const Splines s = grow(p, 3, {});
    check_sound(s);
    double expected2 = 0, expected3 = 0;
    for (std::size_t b : of_level(s, 1)) {
        const double offset = 12 * s.parent_at[b], crown = 0.2 + 0.8 * (12 - offset) / 9;
        const double number = 8 * (0.2 + 0.8 * crown);
        expected2 += number;
        const auto c = children(s, b);
        CHECK(std::abs(double(c.size()) - number) < 1);
        for (std::size_t i = 0; i < c.size(); ++i) {
            const double place = (double(i) + 0.5) / double(c.size()) * length(s, b);
            CHECK(length(s, c[i]) == Approx(0.5 * (length(s, b) - 0.6 * place)));
            CHECK(angle(start_direction(s, c[i]), start_direction(s, b)) == Approx(60));
        }
    }
    for (std::size_t b : of_level(s, 2)) {
        const double number = 8 * (1 - 0.5 * s.parent_at[b]);
        expected3 += number;
        CHECK(std::abs(double(children(s, b).size()) - number) < 1);
    }
    // Fractions are rounded up as often as they say: the sum is met within four standard deviations.
    CHECK(std::abs(double(of_level(s, 2).size()) - expected2) < 4 * 0.5 * std::sqrt(8.0));
    CHECK(std::abs(double(of_level(s, 3).size()) - expected3) < 4 * 0.5 * std::sqrt(double(of_level(s, 2).size())));
    CHECK(s.branches() == 9 + of_level(s, 2).size() + of_level(s, 3).size());
}

TEST_CASE("A negative variation of the down angle runs from base to tip") {
    GrowthParameters p = plain(2);
    p.level[1].down_angle_v = -40;
    const Splines s = grow(p, 1, {});
    for (std::size_t b = 1; b < s.branches(); ++b) {
        const double ratio = (12 - 12 * s.parent_at[b]) / 9;
        CHECK(angle(start_direction(s, b), Vec3::UnitY()) == Approx(60 - 40 * (1 - 2 * (0.2 + 0.8 * ratio))));
    }
}

TEST_CASE("A negative rotation puts children on alternating sides, whorls where segments meet") {
    GrowthParameters p = plain(2);
    p.level[1].rotate = -90;
    p.level[1].branch_dist = 1;
    const Splines s = grow(p, 1, {});
    for (std::size_t b = 2; b < s.branches(); ++b) {
        const Vec3 a = start_direction(s, b - 1), c = start_direction(s, b);
        CHECK(std::abs(angle(Vec3(a.x(), 0, a.z()), Vec3(c.x(), 0, c.z())) - 180) < 1e-6);
    }
    std::map<double, int> whorls;
    for (std::size_t b = 1; b < s.branches(); ++b) ++whorls[std::round(s.parent_at[b] * 4e6) / 4e6];
    CHECK(whorls.size() == 3);
    for (const auto& [place, count] : whorls) CHECK(place * 4 == Approx(std::round(place * 4)));
}

TEST_CASE("Taper follows the paper: cylinder, cone, rounded tip, bumps; radii are never zero") {
    GrowthParameters p = plain(1);
    const auto radius_over = [&](double taper, const auto& expected) {
        p.level[0].taper = taper;
        const Splines s = grow(p, 1, {});
        check_sound(s);
        for (std::size_t i = 0; i < s.points(); ++i)
            CHECK(s.radius[i] == Approx(std::max(expected(s.point[i].y()), 0.05 * 0.24)).margin(1e-12));
        return s.points();
    };
    CHECK(radius_over(0, [](double) { return 0.24; }) == 5);
    CHECK(radius_over(1, [](double y) { return 0.24 * (1 - y / 12); }) == 5);
    CHECK(radius_over(0.4, [](double y) { return 0.24 * (1 - 0.4 * y / 12); }) == 5);
    // A hemisphere of the trunk's radius on a cylinder, with points on it.
    CHECK(radius_over(2, [](double y) {
              const double up = std::max(0.0, y - (12 - 0.24));
              return std::sqrt(std::max(0.0, 0.24 * 0.24 - up * up));
          }) > 7);
    // A string of spheres from the tip down.
    CHECK(radius_over(3, [](double y) {
              const double in = std::fmod(12 - y + 1e-9, 0.48) - 1e-9 - 0.24;
              return std::sqrt(std::max(0.0, 0.24 * 0.24 - in * in));
          }) > 90);
}

TEST_CASE("Bumps on a stem too slender for them are refused, of the trunk or of its children") {
    GrowthParameters p = default_growth();
    p.level[0].taper = 3;
    p.ratio = 1e-6;
    CHECK_THROWS_WITH(grow(p, 1, {}), Catch::StartsWith("taper: is over 2 where ratio"));
    p = default_growth();
    p.level[1].taper = 2.5;
    p.level[1].radius_mod = 1e-6;
    p.least_radius = 0;
    CHECK_THROWS_WITH(grow(p, 1, {}), Catch::StartsWith("taper: is over 2 where ratio"));
    CHECK(taper_marks(3, 0, 1, 1e5).size() > 199'000);
    CHECK_THROWS_AS(taper_marks(3, 0, 0, 1), std::invalid_argument);
    CHECK(taper_marks(2, 0, 1e-9, 1).size() <= 3);
}

TEST_CASE("Flare widens the lowest eighth of the trunk alone") {
    GrowthParameters p = plain(1);
    p.level[0].taper = 0;
    p.flare = 0.6;
    const Splines s = grow(p, 1, {});
    CHECK(s.radius[0] == Approx(0.24 * (1 + 0.6 * 0.99)));
    std::size_t between = 0;
    for (std::size_t i = 0; i < s.points(); ++i) {
        const double z = s.point[i].y() / 12;
        between += z < 0.125;
        CHECK(s.radius[i] == Approx(0.24 * (z < 0.125 ? 1 + 0.6 * (std::pow(100, 1 - 8 * z) - 1) / 100 : 1)));
    }
    CHECK(between > 3);
}

TEST_CASE("A curved stem is the polygon of its angles, and curve_back bends it back") {
    GrowthParameters p = plain(1);
    p.level[0].curve_res = 10;
    p.level[0].curve = 90;
    Splines s = grow(p, 1, {});
    CHECK(angle(start_direction(s, 0), end_direction(s, 0)) == Approx(81));
    Vec3 tip = Vec3::Zero();
    for (int i = 0; i < 10; ++i) tip += 1.2 * Vec3(0, std::cos(i * 9 * pi / 180), std::sin(i * 9 * pi / 180));
    CHECK(s.point.back().y() == Approx(tip.y()));
    CHECK(std::hypot(s.point.back().x(), s.point.back().z()) == Approx(tip.z()));
    p.level[0].curve = 50;
    p.level[0].curve_back = -50;
    s = grow(p, 1, {});
    // Five turns of 50 / 5 up to the middle, four of as much back.
    CHECK(angle(start_direction(s, 0), s.point[6] - s.point[5]) == Approx(50));
    CHECK(angle(start_direction(s, 0), end_direction(s, 0)) == Approx(10));
}

TEST_CASE("A negative curve_v makes a helix about the stem's axis") {
    GrowthParameters p = plain(1);
    p.level[0].curve_res = 12;
    p.level[0].curve_v = -30;
    const Splines s = grow(p, 1, {});
    // Steps make equal angles with the axis and sum to it: one whole turn.
    const Vec3 axis = (s.point.back() - s.point.front()).normalized();
    CHECK((s.point.back() - s.point.front()).norm() == Approx(12 * std::cos(30 * pi / 180)));
    for (std::size_t i = 0; i + 1 < s.points(); ++i) CHECK(angle(s.point[i + 1] - s.point[i], axis) == Approx(30));
}

TEST_CASE("Splits double the stems at each segment's end, as thick as where they leave") {
    GrowthParameters p = plain(1);
    p.level[0].seg_splits = 1;
    p.level[0].split_angle = 20;
    const Splines s = grow(p, 5, {});
    check_sound(s);
    REQUIRE(s.branches() == 8);
    double total = 0;
    for (std::size_t b = 0; b < 8; ++b) {
        total += length(s, b);
        CHECK(s.level[b] == 0);
        if (b == 0) continue;
        const auto [position, radius] = at(s, static_cast<std::size_t>(s.parent[b]), s.parent_at[b]);
        CHECK(s.radius[first(s, b)] == Approx(radius));
        CHECK(s.radius[last(s, b)] == Approx(0.05 * 0.24));
    }
    CHECK(total == Approx(3.0 * (1 + 2 + 4 + 8)));
    p.level[0].seg_splits = 0.5;
    // Three places, half a clone each: one or two of the trunk's own, whichever seed.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Splines t = grow(p, seed, {});
        const std::size_t own = children(t, 0).size();
        CHECK((own == 1 || own == 2));
    }
}

TEST_CASE("Base splits spread evenly about the vertical") {
    GrowthParameters p = plain(1);
    p.level[0].base_splits = 2;
    p.level[0].split_angle = 25;
    const Splines s = grow(p, 1, {});
    REQUIRE(s.branches() == 3);
    // The split angle is turned back over the three segments left, a third of it at once.
    const Vec3 d[3] = {s.point[2] - s.point[1], start_direction(s, 1), start_direction(s, 2)};
    for (int i = 0; i < 3; ++i) {
        CHECK(angle(d[i], Vec3::UnitY()) == Approx(25 * 2.0 / 3));
        const Vec3 e = d[(i + 1) % 3];
        CHECK(angle(Vec3(d[i].x(), 0, d[i].z()), Vec3(e.x(), 0, e.z())) == Approx(120));
    }
    for (std::size_t b = 0; b < 3; ++b) CHECK(angle(end_direction(s, b), Vec3::UnitY()) < 1e-5);
}

TEST_CASE("Attraction turns the third level's stems up or down, never the first two") {
    GrowthParameters p = plain(3);
    const Splines none = grow(p, 1, {});
    p.level[2].attraction_up = p.level[3].attraction_up = 1;
    const Splines up = grow(p, 1, {});
    p.level[2].attraction_up = p.level[3].attraction_up = -1;
    const Splines down = grow(p, 1, {});
    REQUIRE(up.branches() == none.branches());
    for (std::size_t b = 0; b < up.branches(); ++b) {
        const double slope = end_direction(none, b).y();
        if (up.level[b] < 2) {
            CHECK(end_direction(up, b) == end_direction(none, b));
        } else if (std::abs(slope) < 0.999) {
            CHECK(end_direction(up, b).y() > slope);
            CHECK(end_direction(down, b).y() < slope);
        }
    }
}

TEST_CASE("Leaves come in the paper's numbers and angles") {
    GrowthParameters p = plain(2);
    p.leaves = 20;
    p.leaf_scale = 0.2;
    p.leaf_scale_x = 0.25;
    p.level[2].down_angle = 50;
    p.level[2].rotate = 77;
    const Splines s = grow(p, 1, {true});
    check_sound(s);
    std::map<std::int32_t, double> number;
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const auto b = static_cast<std::size_t>(s.leaf_branch[i]);
        ++number[s.leaf_branch[i]];
        CHECK(angle(s.leaf_rotation[i] * Vec3::UnitZ(), start_direction(s, b)) == Approx(50));
        CHECK(s.leaf_length[i] == 0.2);
        CHECK(s.leaf_width[i] == Approx(0.05));
        // On the surface, where the stem is as thick as it is.
        CHECK((s.leaf_position[i] - at(s, b, s.leaf_at[i]).first).norm() == Approx(at(s, b, s.leaf_at[i]).second));
    }
    for (std::size_t b = 1; b < s.branches(); ++b)
        CHECK(std::abs(number[std::int32_t(b)] - 20 * (0.5 + 0.5 * s.parent_at[b])) < 1);
    CHECK(number.count(0) == 0);
    CHECK(grow(p, 1, {}).leaves() == 0);

    const auto mean_up = [](const Splines& t) {
        double sum = 0;
        for (const Quat& q : t.leaf_rotation) sum += (q * Vec3::UnitY()).y();
        return sum / double(t.leaves());
    };
    p.leaf_bend = 0.6;
    CHECK(mean_up(grow(p, 1, {true})) > mean_up(s) + 0.1);
    p.leaf_bend = 1;
    CHECK(mean_up(grow(p, 1, {true})) == Approx(1));
}

TEST_CASE("A negative number of leaves is a fan at the tip") {
    GrowthParameters p = plain(1);
    p.leaves = -8;
    p.level[1].down_angle = 0;
    p.level[1].rotate = 120;
    const Splines s = grow(p, 1, {true});
    REQUIRE(s.leaves() == 8);
    check_sound(s);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(s.leaf_at[i] == 1);
        CHECK(angle(s.leaf_rotation[i] * Vec3::UnitZ(), Vec3::UnitY()) ==
              Approx(std::abs(120 * ((double(i) + 0.5) / 8 - 0.5))));
    }
}

TEST_CASE("Fruit hangs below the stems of the last level") {
    GrowthParameters p = plain(2);
    p.fruits = 3;
    p.fruit_radius = 0.04;
    const Splines s = grow(p, 1, {false, false, true});
    check_sound(s);
    CHECK(std::abs(double(s.fruits()) - 8 * 3 * 0.8125) <= 8);
    for (std::size_t i = 0; i < s.fruits(); ++i) CHECK(s.fruit_radius[i] == 0.04);
    CHECK(grow(p, 1, {}).fruits() == 0);
}

TEST_CASE("Parameters out of range are refused by name") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto refused = [](const std::string& name, auto change) {
        GrowthParameters p = default_growth();
        change(p);
        CHECK_THROWS_AS(grow(p, 1, {true, false, true}), std::invalid_argument);
        CHECK_THROWS_WITH(grow(p, 1, {true, false, true}), Catch::StartsWith(name + ": is "));
        CHECK_THROWS_WITH(grow_bodies(p, 1, {true, false, true}, 1000), Catch::StartsWith(name + ": is "));
    };
    refused("levels", [](GrowthParameters& p) { p.levels = 0; });
    refused("levels", [](GrowthParameters& p) { p.levels = 5; });
    refused("shape", [](GrowthParameters& p) { p.shape = 9; });
    refused("scale", [](GrowthParameters& p) { p.scale = 0; });
    refused("scale", [&](GrowthParameters& p) { p.scale = nan; });
    refused("scale", [&](GrowthParameters& p) { p.scale = inf; });
    refused("scale_v", [](GrowthParameters& p) { p.scale_v = p.scale; });
    refused("level[0].base_size", [](GrowthParameters& p) { p.level[0].base_size = 1; });
    refused("ratio", [](GrowthParameters& p) { p.ratio = 0; });
    refused("ratio_power", [&](GrowthParameters& p) { p.ratio_power = nan; });
    refused("radius_scale", [](GrowthParameters& p) { p.radius_scale = -1; });
    refused("flare", [](GrowthParameters& p) { p.flare = -0.1; });
    refused("level[0].attraction_up", [&](GrowthParameters& p) { p.level[0].attraction_up = -inf; });
    refused("level[0].branches", [](GrowthParameters& p) { p.level[0].branches = 2; });
    refused("level[1].branches", [](GrowthParameters& p) { p.level[1].branches = -1; });
    refused("level[2].length", [](GrowthParameters& p) { p.level[2].length = 0; });
    refused("level[2].length_v", [](GrowthParameters& p) { p.level[2].length_v = 1; });
    refused("level[3].taper", [](GrowthParameters& p) { p.level[3].taper = 3.1; });
    refused("level[3].curve_res", [](GrowthParameters& p) { p.level[3].curve_res = 0; });
    refused("level[1].curve_res", [](GrowthParameters& p) { p.level[1].curve_res = 1; });
    refused("level[1].down_angle", [&](GrowthParameters& p) { p.level[1].down_angle = nan; });
    refused("level[1].branch_dist", [](GrowthParameters& p) { p.level[1].branch_dist = 2; });
    refused("level[1].seg_splits", [](GrowthParameters& p) { p.level[1].seg_splits = -0.1; });
    refused("level[1].seg_splits", [](GrowthParameters& p) { p.level[1].seg_splits = 9; });
    refused("leaf_scale", [](GrowthParameters& p) { p.leaf_scale = 0; });
    refused("leaf_scale_v", [](GrowthParameters& p) { p.leaf_scale_v = -1; });
    refused("leaf_angles", [](GrowthParameters& p) { p.leaf_angles = {1, 2}; });
    refused("prune_width_peak", [](GrowthParameters& p) { p.prune_width_peak = 1; });
    refused("pipe_exponent", [](GrowthParameters& p) { p.pipe_exponent = 0.5; });
    refused("level[1].bend_v", [](GrowthParameters& p) { p.level[1].bend_v = 5; });
    refused("blossom_rate", [](GrowthParameters& p) { p.blossom_rate = 0.5; });
    refused("trunk_spread", [](GrowthParameters& p) { p.trunk_spread = 1; });
    refused("split_exponent", [](GrowthParameters& p) { p.rules = GrowthRules::arbaro, p.split_exponent = 2; });
    refused("petals", [](GrowthParameters& p) { p.petals = 0; });
    refused("leaf_bend", [](GrowthParameters& p) { p.leaf_bend = 1.5; });
    refused("fruits", [](GrowthParameters& p) { p.fruits = -1; });
    GrowthParameters p = default_growth();
    p.level[3].down_angle = 1000;
    p.levels = 2;
    CHECK_NOTHROW(grow(p, 1, {true, false, true}));
}
