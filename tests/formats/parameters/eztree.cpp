// eztree.h (growth and format): straight trees worked out by hand, counts by the rule, the branch queues that ez-tree itself
// made where they are present, and what the reader refuses or names.
#include "formats/parameters/eztree.h"
#include "formats/open.h"
#include "lib/growth/eztree_rotation.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>

using namespace bough;

namespace {

constexpr double degree = std::numbers::pi / 180;

EzTreeParameters read(const std::string& content) {
    std::vector<std::string> notes;
    return read_eztree(content, "preset.json", notes);
}

// Without chance but for the places: a trunk of 8, four children, straight.
EzTreeParameters straight() {
    EzTreeParameters p;
    p.seed = 5;
    p.levels = 1;
    p.angle = {0, 60, 0, 0};
    p.children = {4, 0, 0, 0};
    p.length = {8, 3, 1, 1};
    p.radius = {0.5, 0.6, 1, 1};
    p.sections = {4, 3, 1, 1};
    p.start = {0, 0.25, 0, 0};
    p.taper = {0.5, 0.5, 0.5, 0.5};
    p.leaf_count = 6;
    return p;
}

std::array<std::int64_t, 4> counted(const Splines& s) {
    std::array<std::int64_t, 4> count{};
    for (const std::int32_t level : s.level) ++count[static_cast<std::size_t>(level)];
    return count;
}

Vec3 first(const Splines& s, std::size_t b) {
    return s.point[static_cast<std::size_t>(s.first_point[b])];
}
Vec3 vector(const nlohmann::json& v) {
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

Vec3 last(const Splines& s, std::size_t b) {
    return s.point[static_cast<std::size_t>(s.first_point[b + 1]) - 1];
}

} // namespace

TEST_CASE("Rotations are those of Euler angles XYZ, there and back") {
    const Vec3 e(0.4, -0.9, 2.1);
    const Mat3 m = (Eigen::AngleAxisd(e.x(), Vec3::UnitX()) * Eigen::AngleAxisd(e.y(), Vec3::UnitY()) *
                    Eigen::AngleAxisd(e.z(), Vec3::UnitZ()))
                       .toRotationMatrix();
    CHECK((three::from_euler(e).toRotationMatrix() - m).norm() < 1e-14);
    CHECK((three::to_euler(three::from_euler(e)) - e).norm() < 1e-14);
    const Quat pole = three::from_euler({0.3, std::numbers::pi / 2, 0.2});
    CHECK((three::from_euler(three::to_euler(pole)).toRotationMatrix() - pole.toRotationMatrix()).norm() < 1e-6);
    const Vec3 to = Vec3(1, 2, -2) / 3;
    CHECK((three::y_to(to) * Vec3::UnitY() - to).norm() < 1e-14);
    CHECK((three::y_to(-Vec3::UnitY()) * Vec3::UnitY() + Vec3::UnitY()).norm() < 1e-14);
    const Quat a = three::from_euler({0, 0, 0}), b = three::from_euler({1.2, 0, 0});
    CHECK(three::to_euler(three::rotate_towards(a, b, 0.5)).x() == Approx(0.5));
    CHECK(three::to_euler(three::rotate_towards(a, b, 2)).x() == Approx(1.2));
    CHECK(three::to_euler(three::rotate_towards(a, b, -0.5)).x() == Approx(-0.5));
}

TEST_CASE("A straight deciduous tree, by hand") {
    const EzTreeParameters p = straight();
    const Splines s = grow_eztree(p, true);
    REQUIRE_FALSE(check(s));
    CHECK(counted(s) == std::array<std::int64_t, 4>{1, 5, 0, 0});
    CHECK((last(s, 0) - Vec3(0, 8, 0)).norm() < 1e-12);
    CHECK(s.radius[0] == 0.5);
    CHECK(s.radius[4] == Approx(0.25));
    // The one that goes on: from the end, as thick, of as many sections as the trunk.
    CHECK(s.parent_at[1] == 1);
    CHECK((last(s, 1) - Vec3(0, 11, 0)).norm() < 1e-12);
    CHECK(s.first_point[2] - s.first_point[1] == 5);
    CHECK(s.radius[static_cast<std::size_t>(s.first_point[1])] == Approx(0.25));
    std::vector<double> turns;
    for (std::size_t b = 2; b < 6; ++b) {
        const double at = s.parent_at[b];
        CHECK((at >= 0.25 && at < 1));
        CHECK((first(s, b) - Vec3(0, 8 * at, 0)).norm() < 1e-12);
        CHECK(s.radius[static_cast<std::size_t>(s.first_point[b])] == Approx(0.6 * 0.5 * (1 - 0.5 * at)));
        CHECK(s.radius[static_cast<std::size_t>(s.first_point[b + 1]) - 1] == Approx(0.001));
        const Vec3 way = last(s, b) - first(s, b);
        CHECK(way.norm() == Approx(3));
        CHECK(std::acos(way.normalized().y()) == Approx(60 * degree));
        turns.push_back(std::atan2(way.x(), way.z()));
    }
    for (std::size_t k = 1; k < 4; ++k)
        CHECK(std::abs(std::remainder(turns[k] - turns[0] - static_cast<double>(k) * std::numbers::pi / 2,
                                      2 * std::numbers::pi)) < 1e-9);
    // Six leaves and one at the end on each branch of the last level.
    CHECK(s.leaves() == 5 * 7);
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const auto b = static_cast<std::size_t>(s.leaf_branch[i]);
        const Vec3 on = first(s, b) + s.leaf_at[i] * (last(s, b) - first(s, b));
        CHECK((s.leaf_position[i] - on).norm() < 1e-12);
        const Vec3 z = s.leaf_rotation[i] * Vec3::UnitZ();
        CHECK(std::acos(std::min(1.0, z.dot((last(s, b) - first(s, b)).normalized()))) ==
              Approx(s.leaf_at[i] == 1 ? 0 : 10 * degree).margin(1e-6));
    }
}

TEST_CASE("Evergreens end in a point and shrink their branches upward") {
    EzTreeParameters p = straight();
    p.evergreen = true;
    const Splines s = grow_eztree(p, false);
    CHECK(counted(s) == std::array<std::int64_t, 4>{1, 4, 0, 0});
    CHECK(s.radius[4] == 0);
    for (std::size_t b = 1; b < 5; ++b) CHECK((last(s, b) - first(s, b)).norm() == Approx(3 * (1 - s.parent_at[b])));
    CHECK(s.leaves() == 0);
    CHECK(grow_eztree(p, true).leaves() == 4 * 6);
    CHECK(grow_eztree(p, true).point == s.point);
}

TEST_CASE("Force turns branches up or down, twist turns their children, gnarliness bends, the trellis draws") {
    EzTreeParameters p = straight();
    const auto rise = [](const Splines& s) {
        double sum = 0;
        for (std::size_t b = 2; b < 6; ++b) sum += (last(s, b) - first(s, b)).y();
        return sum;
    };
    const double plain = rise(grow_eztree(p, false));
    p.force_strength = 0.02;
    CHECK(rise(grow_eztree(p, false)) > plain + 0.1);
    p.force_strength = -0.02;
    CHECK(rise(grow_eztree(p, false)) < plain - 0.1);
    p = straight();
    p.gnarliness[0] = 0.1;
    CHECK((last(grow_eztree(p, false), 0) - Vec3(0, 8, 0)).norm() > 0.01);
    p = straight();
    p.trellis.enabled = true;
    p.trellis.position = {0, 0, -1.5};
    p.trellis.strength = 0.2;
    CHECK(last(grow_eztree(p, false), 0).z() < -0.2);
}

TEST_CASE("Any whole number is a seed; its lower 32 bits count") {
    EzTreeParameters p = straight(), same = p;
    for (const auto& [seed, low] :
         std::vector<std::pair<std::int64_t, std::int64_t>>{{std::numeric_limits<std::int64_t>::max(), 4294967295},
                                                            {std::numeric_limits<std::int64_t>::min(), 0},
                                                            {-1, 4294967295}}) {
        p.seed = seed;
        same.seed = low;
        CHECK(grow_eztree(p, true).point == grow_eztree(same, true).point);
    }
}

TEST_CASE("Units scale the result alone") {
    EzTreeParameters p = straight();
    p.gnarliness = {0.1, 0.1, 0, 0};
    const Splines one = grow_eztree(p, true);
    p.unit = 0.3048;
    const Splines feet = grow_eztree(p, true);
    for (std::size_t i = 0; i < one.points(); ++i) {
        CHECK((feet.point[i] - 0.3048 * one.point[i]).norm() < 1e-12);
        CHECK(feet.radius[i] == Approx(0.3048 * one.radius[i]));
    }
    CHECK(feet.leaf_length[0] == Approx(0.3048 * one.leaf_length[0]));
}

TEST_CASE("Counts per level follow from the parameters alone") {
    std::vector<std::string> notes;
    EzTreeParameters p = read_eztree(read_input(std::string(BOUGH_DATA_DIR) + "/eztree_sprig.json"), "sprig", notes);
    // 1; 1 * (4 + 1); 5 * (3 + 1).
    CHECK(counted(grow_eztree(p, true)) == std::array<std::int64_t, 4>{1, 5, 20, 0});
    CHECK(eztree_branches(p) == std::array<std::int64_t, 4>{1, 5, 20, 0});
    CHECK(grow_eztree(p, true).leaves() == 20 * 6);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0] == "not honoured: branch/segments, leaves/type, leaves/billboard, bark");
    p.levels = 3;
    p.evergreen = true;
    p.children[2] = 2;
    CHECK(counted(grow_eztree(p, false)) == std::array<std::int64_t, 4>{1, 4, 12, 24});
    p.seed = 1;
    const Splines one = grow_eztree(p, false);
    p.seed = 2;
    CHECK(one.point != grow_eztree(p, false).point);
}

TEST_CASE("What the reader refuses has its place named") {
    const auto refused = [](const std::string& content, const std::string& text) {
        CHECK_THROWS_AS(read(content), InputError);
        CHECK_THROWS_WITH(read(content), Catch::StartsWith("preset.json: ") && Catch::Contains(text));
    };
    refused("{", "no JSON at byte");
    refused("[]", "expected an object");
    refused(R"({"branch": {"lenght": {}}})", "/branch/lenght: is no parameter of ez-tree");
    refused(R"({"branch": {"two\nlines": 1}})", "/branch/two?lines: is no parameter of ez-tree");
    refused(R"({"wind": 1})", "/wind: is no parameter of ez-tree");
    refused(R"({"branch": {"length": {"7": 2}}})", "/branch/length/7: is no parameter");
    refused(R"({"branch": {"length": {"0": "long"}}})", "/branch/length/0: is \"long\", expected a number");
    refused(R"({"branch": {"children": {"0": 1.5}}})", "/branch/children/0: is 1.5, expected a whole number");
    refused(R"({"type": "palm"})", "/type: is \"palm\", expected \"deciduous\" or \"evergreen\"");
    refused(R"({"branch": {"levels": 9}})", "/branch/levels: is 9, expected 0 to 3");
    refused(R"({"branch": {"radius": {"0": -1}}})", "/branch/radius/0: is -1, expected more than 0");
    refused(R"({"branch": {"children": {"0": 900000, "1": 900000}}})", "/branch/children: make");
    refused(R"({"branch": {"children": {"0": 9000}}, "leaves": {"count": 900}})", "/branch/children: make");
}

TEST_CASE("A preset is known by its content") {
    CHECK(is_eztree(read_input(std::string(BOUGH_DATA_DIR) + "/eztree_sprig.json")));
    CHECK_FALSE(is_eztree(R"({"format": "bough-splines", "branch": [1]})"));
    CHECK_FALSE(is_eztree("{"));
    CHECK_FALSE(is_eztree("<arbaro/>"));
    CHECK_FALSE(is_eztree(""));
}

TEST_CASE("ez-tree's own branch queues: every origin, length, radius and number of sections") {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (!folder) {
        WARN("BOUGH_CASES_DIR is not set: ez-tree's own branches are not compared");
        return;
    }
    for (const char* name : {"ash", "pine"}) {
        const auto dump =
            nlohmann::json::parse(read_input(std::string(folder) + "/eztree/eztree_" + name + "_small.branches.json"));
        const Splines s = grow_eztree(read(dump["options"].dump()), true);
        REQUIRE_FALSE(check(s));
        const auto& branches = dump["branches"];
        REQUIRE(s.branches() == branches.size());
        for (std::size_t b = 0; b < s.branches(); ++b) {
            const auto& e = branches[b];
            double length = 0;
            for (auto k = static_cast<std::size_t>(s.first_point[b]);
                 k + 1 < static_cast<std::size_t>(s.first_point[b + 1]); ++k)
                length += (s.point[k + 1] - s.point[k]).norm();
            INFO(name << " " << b);
            CHECK(s.level[b] == e["level"].get<int>());
            CHECK((first(s, b) - vector(e["origin"])).norm() < 2e-6 * 40);
            CHECK(length == Approx(e["length"].get<double>()).epsilon(1e-6));
            CHECK(s.radius[static_cast<std::size_t>(s.first_point[b])] ==
                  Approx(e["radius"].get<double>()).epsilon(1e-6));
            CHECK(s.first_point[b + 1] - s.first_point[b] == e["sectionCount"].get<int>() + 1);
            const Vec3 up = three::from_euler(vector(e["orientation"])) * Vec3::UnitY();
            const auto k = static_cast<std::size_t>(s.first_point[b]);
            CHECK(((s.point[k + 1] - s.point[k]).normalized() - up).norm() < 1e-5);
        }
    }
    for (const char* name : {"ash", "aspen", "pine"}) {
        const EzTreeParameters p = read(read_input(std::string(folder) + "/params/eztree_" + name + "_small.json"));
        CHECK(counted(grow_eztree(p, false)) == eztree_branches(p));
    }
}
