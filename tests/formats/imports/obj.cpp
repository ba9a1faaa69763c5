#include "formats/imports/curve_points.h"
#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

TEST_CASE("OBJ lines: forks, negative and texture indices, continued lines, faces beside them") {
    const std::string text =
        "\xEF\xBB\xBF# made by hand\r\nmtllib x.mtl\r\no tree\r\nv 0 0 0\r\nv 0 2. 0\r\nv 0 +3e0 0 1 0 0\r\n"
        "v 1 2.5 0\r\nvt 0 0\r\nl 3/1 2/1 \\\r\n 1\r\nl -1 -3\r\nf 1 2 3\r\nL 1 2\r\n";
    const Imported in = imported(text, "x.obj");
    REQUIRE(in.splines.branches() == 2);
    CHECK(near(in.splines.point[0], {0, 0, 0}));
    CHECK(total_length(in.splines) == Approx(3 + std::sqrt(1.25)));
    CHECK(top_of(in.splines) == 3);
    CHECK(in.splines.parent_at[1] == Approx(2.0 / 3).epsilon(0.35)); // which of the two goes on is the longer's matter
    CHECK(in.notes_hold("1 face not read"));
    CHECK(in.notes_hold("taken as Y"));
    CHECK(in.notes_hold("filled by the pipe rule"));
}

TEST_CASE("OBJ curves with clamped knots are evaluated, others follow their control points") {
    // A quarter of a circle as a rational quadratic (weights 1, 1/sqrt 2, 1), which a B-spline gives exactly.
    const std::string clamped = "v 0 0 0\nv 0 1 0 0.70710678118654752\nv 1 1 0\ncstype rat bspline\ndeg 2\n"
                                "curv 0 1 1 2 3\nparm u 0 0 0 1 1 1\nend\n";
    const Splines arc = imported(clamped, "x.obj").splines;
    REQUIRE(arc.points() == 5);
    for (const Vec3& p : arc.point) CHECK((p - Vec3(1, 0, 0)).norm() == Approx(1));
    const Imported loose = imported(replaced(clamped, "0 0 0 1 1 1", "0 1 2 3 4 5"), "x.obj");
    CHECK(loose.splines.points() == 3);
    CHECK(loose.notes_hold("1 curve taken along its control points"));
    CHECK(imported(replaced(clamped, "deg 2", "deg 3"), "x.obj").splines.points() == 3);
    const std::string bezier = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 2 0\ncstype bezier\ndeg 3\ncurv 0 1 -4 -3 -2 -1\nend\n";
    const Splines s = imported(bezier, "x.obj").splines;
    REQUIRE(s.points() == 5);
    CHECK(near(s.point[2], {0.5, 1, 0}));             // by symmetry
    CHECK(near(s.point[1], {10.0 / 64, 0.59375, 0})); // (1/4: 9/64 x2 + 1/64 x3; 27/64 y1 + 9/64 y2 + 2/64)
}

TEST_CASE("curves from tip to base are turned, and joined where they begin") {
    const std::string text =
        "v 0 4 0\nv 0 2 0\nv 0 0 0\nv 1 3 0\nv 0.1 2 0\nv -1 4 0\nv -0.1 3 0\nv 0 1 1.5\nv 0 1 0.1\n"
        "cstype bspline\ndeg 1\ncurv 0 1 1 2 3\nend\ncurv 0 1 4 5\nend\ncurv 0 1 6 7\nend\ncurv 0 1 8 9\nend\n";
    const Imported in = imported(text, "x.obj");
    REQUIRE(in.splines.branches() == 4);
    CHECK(in.notes_hold("from tip to base"));
    CHECK(in.notes_hold("3 curves attached to the nearest branch"));
    CHECK(in.splines.parent == std::vector<std::int32_t>{-1, 0, 0, 0});
    CHECK(in.splines.parent_at[1] == Approx(0.5));
    CHECK(in.splines.parent_at[2] == Approx(0.75));
    CHECK(in.splines.parent_at[3] == Approx(0.25));
    CHECK(near(in.splines.point[in.splines.first_point[1]], {0.1, 2, 0})); // the joint stays off the axis
}

TEST_CASE("OBJ files without a skeleton are refused with advice, wrong ones with their line") {
    CHECK(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "x.obj").find("x.obj: is a mesh (1 face)") == 0);
    CHECK(error_of("v 0 0 0\nv 1 0 0\n", "x.obj").find("x.obj: 2 points without lines") == 0);
    CHECK(error_of("v 0 0 0\nv 0 1 0\nl 1 3\n", "x.obj") == "x.obj:3: vertex 3 does not exist, expected 1 to 2");
    CHECK(error_of("v 0 0 0\nl 1 0\nv 0 1 0\n", "x.obj").find("x.obj:2: vertex 0 does not exist") == 0);
    CHECK(error_of("v 0 0 0\nl 1 -2\nv 0 1 0\n", "x.obj").find("x.obj:2: vertex -2 does not exist") == 0);
    CHECK(error_of("v 0 0\n", "x.obj") == "x.obj:1: v has 2 numbers, expected x y z");
    CHECK(error_of("v 0 0 0\nv 0 nan 0\n", "x.obj").find("x.obj:2: \"nan\" is not a vertex's y") == 0);
    CHECK(error_of("v 0 0 0\nv 0 1 0\nl 1\n", "x.obj").find("x.obj:3: l has 1 vertex,") == 0);
    CHECK(error_of("v 0 0 0\nl 1 one\n", "x.obj").find("x.obj:2: \"one\" is not a vertex's index") == 0);
    CHECK(error_of("v 0 0 0\nv 0 0 0\nl 1 2\n", "x.obj").find("no line with a length") != std::string::npos);
    CHECK(
        error_of("v 0 0 0\nv 0 1 0\ncstype bmatrix\ndeg 1\ncurv 0 1 1 2\n", "x.obj").find("x.obj:5: curv of cstype") ==
        0);
    CHECK(imported("l 1 2\nv 0 0 0\nv 0 1 0\n", "x.obj").splines.branches() == 1); // named before it is given
}

TEST_CASE("damaged OBJ files are read or refused in one line") {
    damage(fixture("tip_to_base.obj"), "damaged.obj", 7);
    damage(fixture("lines.obj"), "damaged.obj", 7);
}

TEST_CASE("Blender's lines and curves of a pine: length, height, joints as another reading finds them") {
    // By a script in Python: sum over the lines' (or control points') distances; components by union of equal places.
    const auto lines = foreign_case("sapling/sapling_small_pine_s0.lines.obj");
    if (!lines) return;
    const Imported in = imported(*lines, "lines.obj");
    CHECK(total_length(in.splines) == Approx(190.473835).epsilon(1e-8));
    CHECK(top_of(in.splines) == 5.077638);
    CHECK(in.notes_hold("115 loose parts")); // 116 components, where places a last digit apart are one
    for (const char* name : {"sapling/sapling_small_pine_s0.nurbs.obj", "sapling/sapling_small_pine_s0.nurbs_py.obj"}) {
        const auto curves = foreign_case(name);
        const Imported c = imported(*curves, "curves.obj");
        const bool all = std::string(name).find("_py") == std::string::npos;
        CHECK(c.splines.branches() == (all ? 346u : 228u));
        CHECK(c.splines.points() == (all ? 1287u : 989u));
        CHECK(total_length(c.splines) == Approx(all ? 189.814072 : 151.701483).epsilon(1e-8));
        CHECK(top_of(c.splines) == 5.077638);
        CHECK(std::count(c.splines.parent.begin(), c.splines.parent.end(), -1) == 1);
        CHECK(c.notes_hold("from tip to base"));
    }
}
