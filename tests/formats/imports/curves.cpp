#include "tests/support/import_support.h"
#include <numeric>

using namespace bough;
using namespace bough::test;

namespace {

const std::string table = "spline,point,x,y,z,radius\n0,0,0,0,0,0.2\n0,1,0,0,2,0.1\n0,2,0,0,4,0\n"
                          "1,0,0.1,0,3,0.04\n1,1,1,0,3.5,0.02\n2,0,1.02,0,3.5,0.02\n2,1,1.5,0,4,0.01\n";

void is_the_tree(const Imported& in) {
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 3);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 1});
    CHECK(s.parent_at[1] == Approx(0.75));
    CHECK(s.parent_at[2] == Approx(1));
    CHECK(near(s.point[3], {0.1, 3, 0})); // the joint stays off the trunk's axis
    CHECK(near(s.point[6], {1.5, 4, 0}));
    CHECK(s.radius == std::vector<double>{0.2, 0.1, 0, 0.04, 0.02, 0.02, 0.01});
    CHECK(in.notes_hold(
        "2 curves attached to the nearest branch, as the file names no parents, over a gap of up to 0.1"));
    CHECK(in.notes_hold("base to tip"));
}

std::string knot(const char* co, const char* left, const char* right, double radius) {
    return std::string("{\"co\":[") + co + "],\"handle_left\":[" + left + "],\"handle_right\":[" + right +
           "],\"radius\":" + std::to_string(radius) + ",\"tilt\":0}";
}

// A quarter of a circle of radius 1 as one Bezier (off by 3e-4 at most), on a straight trunk.
std::string curves() {
    return "{\"source\":\"by "
           "hand\",\"more\":{\"a\":[1,[2,{}]],\"b\":null},\"units\":\"m\",\"up_axis\":\"Z\",\"splines\":["
           "{\"type\":\"BEZIER\",\"cyclic\":false,\"points\":[" +
           knot("0,0,0", "0,0,-1", "0,0,1", 0.4) + "," + knot("0,0,3", "0,0,2", "0,0,4", 0.2) + "]},{\"points\":[" +
           knot("0,0,2", "0,0,1", "0.5522847498,0,2", 0.1) + "," + knot("1,0,3", "1,0,2.4477152502", "1,0,4", 0.05) +
           "],\"type\":\"BEZIER\"}],\"bevel_depth\":0.5,\"resolution_u\":12}";
}

} // namespace

TEST_CASE("a table of curves, columns and rows in any order, with other separators, CRLF and a BOM") {
    is_the_tree(imported(table, "x.csv"));
    std::string semicolons = "\xEF\xBB\xBF";
    for (const char c : table) semicolons += c == ',' ? ";" : c == '.' ? "," : c == '\n' ? " \r\n" : std::string(1, c);
    is_the_tree(imported(semicolons, "x.csv"));
    const std::string moved = "# rows of curves mixed\nRadius\t Z \tpoint\t\"X\"\tcurve\ty\tname\n0\t4\t2\t0\t0\t0\tt\n"
                              "0.04\t3\t0\t.1\t1\t0\tb\n0.2\t0\t0\t0\t0\t0\tt\n0.02\t3.5\t1\t1\t1\t0\tb\n"
                              "0.1\t2e0\t1\t0\t0\t0\tt\n0.01\t4\t9\t1.5\t7\t0\tc\n0.02\t3.5\t8\t1.02\t7\t0\tc\n";
    const Imported in = imported(moved, "x.txt");
    is_the_tree(in);
    CHECK(in.notes_hold("column \"name\" not read"));
}

TEST_CASE("a table of curves that run from tip to base") {
    const Imported in =
        imported("spline,x,y,z,radius\n0,0,0,4,0.1\n0,0,0,0,0.2\n1,1,0,3.5,0.02\n1,0.1,0,3,0.04\n", "x.csv");
    REQUIRE(in.splines.branches() == 2);
    CHECK(near(in.splines.point[0], {0, 0, 0}));
    CHECK(near(in.splines.point[2], {0.1, 3, 0}));
    CHECK(in.splines.parent_at[1] == Approx(0.75));
    CHECK(in.notes_hold("from tip to base, because 2 of 2 curves are thicker at that end"));
}

TEST_CASE("a table without radii or numbers of points") {
    const Imported in = imported("spline,x,y,z\n0,0,0,0\n0,0,0,2\n0,0,0,4\n1,0.01,0,2\n1,1,0,3\n", "x.csv");
    REQUIRE(in.splines.branches() == 2);
    CHECK(in.splines.parent_at[1] == Approx(0.5));
    CHECK(in.notes_hold("5 of 5 radii are missing or 0"));
}

TEST_CASE("wrong tables are refused with their line") {
    CHECK(error_of(replaced(table, "0,0,2,0.1", "0,0,high,0.1"), "x.csv") == "x.csv:3: \"high\" is no finite number");
    CHECK(error_of(replaced(table, "0,1,0", "0,1.5,0"), "x.csv").find("x.csv:3: \"1.5\" is not a curve's") == 0);
    CHECK(error_of(replaced(table, "0,0,4,0", "0,0"), "x.csv").find("x.csv:4: has too few columns") == 0);
    CHECK(error_of("spline,point,x,y,z,radius\n", "x.csv").find("x.csv: holds no point") == 0);
    CHECK(error_of("spline,point,x,y,z\n0,0,1,1,1\n1,0,1,1,1\n", "x.csv").find("no curve with a length") !=
          std::string::npos);
    damage(table, "damaged.csv", 1);
}

TEST_CASE("Blender's curves as JSON: Bezier pieces evaluated, radius times bevel_depth") {
    const Imported in = imported(curves(), "x.json");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 2);
    CHECK(s.first_point[1] == 2); // a straight piece needs no more points
    CHECK(s.radius[0] == 0.2);
    CHECK(s.radius.back() == 0.025);
    CHECK(s.parent_at[1] == Approx(2.0 / 3));
    CHECK(s.first_point[2] - s.first_point[1] >= 9);
    for (std::int32_t k = s.first_point[1]; k < s.first_point[2]; ++k)
        CHECK((s.point[k] - Vec3(0, 3, 0)).norm() == Approx(1).margin(3e-4)); // (x, z) about (0, 3)
    CHECK(branch_length(s, 1) == Approx(std::acos(-1.0) / 2).epsilon(0.004));
    CHECK_FALSE(in.notes_hold("unit"));
    CHECK_FALSE(in.notes_hold("up axis"));
    CHECK(imported(replaced(curves(), "\"BEZIER\",\"cyclic\":false", "\"POLY\",\"cyclic\":true"), "x.json")
              .notes_hold("1 closed curve opened"));
    CHECK(imported(replaced(curves(), "0.5,\"res", "0,\"res"), "x.json").notes_hold("bevel_depth is 0"));
}

TEST_CASE("wrong JSON of curves is refused with its line") {
    const std::string good = replaced(curves(), "\"units\"", "\n\"units\"");
    CHECK(error_of(replaced(good, "[0,0,3]", "[0,0]"), "x.json").find("x.json:2: has 2 numbers, expected x y z") == 0);
    CHECK(error_of(replaced(good, "[0,0,3]", "[0,0,NaN]"), "x.json").find("x.json:2: \"NaN\", expected a finite") == 0);
    CHECK(error_of(replaced(good, "\"co\":[0,0,3],", ""), "x.json").find("has no co") != std::string::npos);
    CHECK(error_of(good + "}", "x.json").find("x.json:2: expected the end") == 0);
    CHECK(error_of(replaced(good, "\"splines\":[{", "\"splines\":[{]"), "x.json").find("x.json:2:") == 0);
    const std::string deep(1000000, '[');
    CHECK(error_of(replaced(good, "[1,[2,{}]]", deep), "x.json").find("x.json:") == 0);
    damage(curves(), "damaged.json", 1);
}

TEST_CASE("a tree is set on the ground at its foot, an absurd size is named") {
    ImportOptions options;
    options.up = 'z';
    const std::string survey = "spline,x,y,z,radius\n0,500000,4000000,254,0.1\n0,500000,4000000,260,0.05\n";
    const Imported in = imported(survey, "x.csv", options, true);
    CHECK(near(in.splines.point[0], {0, 0, 0}));
    CHECK(near(in.splines.point[1], {0, 6, 0}, 1e-6));
    CHECK(in.notes_hold("its foot stood at 5e+05, 254, -4e+06 m (x, y up, z): set on the ground at the origin"));
    CHECK_FALSE(in.notes_hold("is the unit right"));
    const std::string aside = "spline,x,y,z,radius\n0,30,0,-0.3,0.1\n0,30,0,6,0.05\n";
    CHECK(near(imported(aside, "x.csv", options, true).splines.point[0], {0, 0, 0}));
    const Imported kept = imported(aside, "x.csv", options);
    CHECK(near(kept.splines.point[0], {30, -0.3, 0}));
    CHECK_FALSE(kept.notes_hold("its foot stood"));
    // A foot less than a hundredth of the height under the ground has no wind there either.
    const Imported sunk = imported("spline,x,y,z,radius\n0,0,0,-0.05,0.1\n0,0,0,6,0.05\n", "x.csv", options, true);
    CHECK(near(sunk.splines.point[0], {0, 0, 0}));
    CHECK(near(sunk.splines.point[1], {0, 6.05, 0}));
    CHECK(sunk.notes_hold("its foot stood at 0, -0.05, 0 m (x, y up, z): set on the ground"));
    const Imported rounded = imported("spline,x,y,z,radius\n0,0,0,-5e-4,0.1\n0,0,0,6,0.05\n", "x.csv", options, true);
    CHECK(near(rounded.splines.point[0], {0, -5e-4, 0}));
    CHECK_FALSE(rounded.notes_hold("its foot stood"));
    CHECK(imported("spline,x,y,z,radius\n0,0,0,0,0.1\n0,0,0,0.05,0.05\n", "x.csv")
              .notes_hold("0.05 m high, hardly a tree"));
}

TEST_CASE("a thick curve begins on thick wood, though a twig's tip is nearer, and on the stem that holds it deepest") {
    const std::string stem = "spline,x,y,z,radius\n0,0,0,0,0.3\n0,0,0,6,0.1\n";
    const Splines thick =
        imported(stem + "1,0,0,3,0.02\n1,0.25,0,3.2,0.002\n2,0.26,0,3.2,0.1\n2,2,0,4,0.05\n", "x.csv").splines;
    CHECK(thick.parent == std::vector<std::int32_t>{-1, 0, 0});
    // 0.1 from the axis of a stem of 0.22 it is deep in the wood, 0.05 from that of a twig of 0.04 beside it.
    const Splines deep =
        imported(stem + "1,0.1,0,2.5,0.04\n1,0.1,0.3,2.5,0.04\n2,0.1,0.05,2.55,0.03\n2,1,0.05,3,0.01\n", "x.csv")
            .splines;
    CHECK(deep.parent == std::vector<std::int32_t>{-1, 0, 0});
}

TEST_CASE("Sapling's joints: as deep as the armature that the add-on itself makes of the same tree") {
    // By a script in Blender 3.4.1: presets willow and small_pine, seed 0, with useArm; how many of the bones SSS.000
    // have how many such bones above them (their spline's parents).
    const auto levels = [](const Splines& s) {
        std::vector<std::size_t> count;
        for (const std::int32_t level : s.level) {
            count.resize(std::max(count.size(), std::size_t(level) + 1));
            ++count[std::size_t(level)];
        }
        return count;
    };
    const auto willow = foreign_case("sapling/sapling_willow_s0.csv");
    if (!willow) return;
    const std::vector<std::size_t> of_willow{1, 10, 44, 95, 141, 129, 77, 28, 5, 1}, of_pine{1, 31, 140, 129, 40, 5};
    CHECK(levels(imported(*willow, "x.csv").splines) == of_willow);
    CHECK(levels(imported(*foreign_case("sapling/sapling_willow_s0.curves.json"), "x.json").splines) == of_willow);
    // Without radii, from tip to base, handles lost.
    CHECK(levels(imported(*foreign_case("sapling/sapling_small_pine_s0.nurbs.obj"), "x.obj").splines) == of_pine);
}

TEST_CASE("Sapling's trees: branches, length, height, radii as another reading counts them") {
    // By scripts in Python over the rows (csv.DictReader) and the Bezier pieces (json, 64 chords each).
    struct Case {
        const char* file;
        std::size_t branches, points;
        double length, top, thickest;
    };
    for (const Case& c : {Case{"sapling/sapling_small_pine_s0.csv", 346, 1287, 189.814072, 5.077638, 0.098615},
                          {"sapling/sapling_willow_s0.csv", 531, 3499, 1437.004112, 19.957312, 0.553327},
                          {"sapling/sapling_willow_s0.curves.json", 531, 3499, 1437.004112, 19.957312, 0.553327},
                          {"sapling/sapling_douglas_fir_s0.csv", 4112, 12731, 5356.098192, 46.497448, 0.929592}}) {
        const auto content = foreign_case(c.file);
        if (!content) return;
        INFO(c.file);
        const Splines s = imported(*content, c.file).splines;
        CHECK(s.branches() == c.branches);
        CHECK(s.points() == c.points);
        CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == 1);
        CHECK(total_length(s) == Approx(c.length).epsilon(1e-8));
        CHECK(top_of(s) == c.top);
        CHECK(s.radius[0] == c.thickest);
        CHECK(*std::max_element(s.radius.begin(), s.radius.end()) == c.thickest);
    }
}

// Found by fuzzing: differences of coordinates beyond any double, on the way to where they are refused.
TEST_CASE("coordinates whose differences overflow are refused") {
    const std::string content = content_of(std::string(BOUGH_DATA_DIR) + "/../tests/fuzzing/found/far_apart.csv");
    CHECK(!error_of(content, "far_apart.csv").empty());
    const std::string far =
        "spline,point,x,y,z,radius\n0,0,-1.7e308,0,0,1\n0,1,1.7e308,0,0,1\n1,0,0,0,0,1\n1,1,1,0,0,1\n";
    CHECK(error_of(far, "far.csv").find("expected") != std::string::npos);
    CHECK(error_of(content_of(std::string(BOUGH_DATA_DIR) + "/../tests/fuzzing/found/far_bezier.curves.json"),
                   "far.curves.json")
              .find("reaches 1e+308 m, expected at most 1e+15 m") != std::string::npos);
}
