// Tables of cylinders: TreeQSM, SimpleForest and aRchi. Small tables worked out by hand, the same in other dress, real ones
// against another reading of the file, and damage.
#include "tests/support/import_support.h"
#include <numeric>

using namespace bough;
using namespace bough::test;

namespace {

std::vector<Vec3> points_of(const Splines& s, std::size_t b) {
    return {s.point.begin() + s.first_point[b], s.point.begin() + s.first_point[b + 1]};
}

std::vector<double> radii_of(const Splines& s, std::size_t b) {
    return {s.radius.begin() + s.first_point[b], s.radius.begin() + s.first_point[b + 1]};
}

void check_points(const Splines& s, std::size_t b, const std::vector<Vec3>& expected) {
    const std::vector<Vec3> found = points_of(s, b);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(near(found[k], expected[k]));
}

bool same(const Splines& a, const Splines& b) {
    return a.parent == b.parent && a.parent_at == b.parent_at && a.first_point == b.first_point && a.point == b.point &&
           a.radius == b.radius;
}

} // namespace

TEST_CASE("TreeQSM: 13 names over 17 columns, parents from 1, gaps bridged, a side branch where it begins") {
    const Imported in = imported(fixture("cylinder_small.txt"), "cylinder_small.txt", {}, true);
    const Splines& s = in.splines;
    CHECK(s.source == "TreeQSM cylinders cylinder_small.txt");
    REQUIRE(s.branches() == 3);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 0});
    // Far from the origin: the trunk's base becomes it. The third cylinder begins 0.2 off the second's end, which is 0.08 thick: a piece of its own bridges that.
    check_points(s, 0, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0.2, 2, 0}, {0.2, 3, 0}});
    CHECK(radii_of(s, 0) == std::vector<double>{0.1, 0.1, 0.08, 0.05, 0.05});
    // An axis of length 2 is a direction; 0.05 off the parent's axis is within its radius and stays.
    check_points(s, 1, {{0.05, 1.5, 0}, {2.05, 1.5, 0}, {2.05, 2.5, 0}});
    CHECK(s.parent_at[1] == Approx(1.5 / 3.2));
    check_points(s, 2, {{0, 0.25, 0}, {0, 0.25, -1}, {0, 0.25, -2}});
    CHECK(s.parent_at[2] == Approx(0.25 / 3.2));
    CHECK(in.notes_hold("2 gaps between a cylinder and its parent bridged, the widest of 1 units"));
    CHECK_FALSE(in.notes_hold("--units"));
}

TEST_CASE("SimpleForest: names with blanks, semicolons, decimal commas, BOM, CRLF, ids in any order") {
    const Imported in = imported(fixture("simpleforest_small.csv"), "simpleforest_small.csv");
    const Splines& s = in.splines;
    CHECK(s.source == "SimpleForest cylinders simpleforest_small.csv");
    REQUIRE(s.branches() == 3);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, -1});
    check_points(s, 0, {{0, 0, 0}, {0, 1, 0}, {0, 2.5, 0}});
    CHECK(radii_of(s, 0) == std::vector<double>{0.05, 0.05, 0.04});
    check_points(s, 1, {{0, 1, 0}, {1, 1, 0}});
    CHECK(s.parent_at[1] == Approx(0.4));
    CHECK(in.notes_hold("2 cylinders have no parent"));
}

TEST_CASE("aRchi: quoted names in another order, no column of axes: the thicker child goes on") {
    const Imported in = imported(fixture("archi_small.csv"), "archi_small.csv");
    const Splines& s = in.splines;
    CHECK(s.source == "aRchi cylinders archi_small.csv");
    REQUIRE(s.branches() == 3);
    check_points(s, 0, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
    check_points(s, 1, {{0, 1, 0}, {0.5, 1, 0}});
    check_points(s, 2, {{0, 1.5, -0.02}, {0, 1.5, -1.02}}); // halfway up the third cylinder: no continuation of it
    CHECK(s.parent_at == std::vector<double>{0, 0.5, 0.75});
    CHECK(in.notes.lines.empty());
}

TEST_CASE("a trunk in the air grows on the nearest wood, one on the ground stays") {
    // On the trunk (10 m, 0.3 thick): a branch that begins 0.5 off its axis, 4 m up, without a parent, and its twig; a
    // sapling on the ground beside it.
    const std::string table = "id,parent,startX,startY,startZ,endX,endY,endZ,radius\n"
                              "1,0,0,0,0,0,0,10,0.3\n"
                              "2,0,0.5,0,4,2.5,0,4,0.05\n"
                              "3,2,1.5,0,4,1.5,1,4,0.02\n"
                              "4,0,0.8,0,0.4,0.8,0,2.4,0.02\n";
    const Imported in = imported(table, "air.csv");
    const Splines& s = in.splines;
    CHECK(in.notes_hold("1 of 3 trunks begin in the air: joined to the nearest wood, the farthest over 0.5 units"));
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 1, -1});
    check_points(s, 1, {{0, 4, 0}, {0.5, 4, 0}, {2.5, 4, 0}}); // a piece from the axis leads to it
    CHECK(s.parent_at[1] == Approx(0.4));
    CHECK(s.parent_at[2] == Approx(0.6)); // 1.5 of 2.5
    CHECK_FALSE(imported(replaced(table, "2,0,0.5", "2,1,0.5"), "air.csv").notes_hold("in the air"));
}

TEST_CASE("trees of a slope stay trees, and what the upper one lost is joined to it") {
    // Two of 20 m, 12 m apart on a slope of a quarter, each with boughs on all sides, and between them a bush of 2 m; the last row is wood in
    // the air beside the upper tree.
    std::string table = "id,parent,startX,startY,startZ,endX,endY,endZ,radius\n";
    int id = 0;
    const auto row = [&](int parent, double x, double y, double z, double to_x, double to_y, double to_z, double r) {
        std::ostringstream text;
        text << ++id << "," << parent << "," << x << "," << y << "," << z << "," << to_x << "," << to_y << "," << to_z
             << "," << r << "\n";
        table += text.str();
        return id;
    };
    for (const double x : {0., 12.}) {
        int below = 0;
        for (int k = 0; k < 20; ++k) {
            below = row(below, x, 0, x / 4 + k, x, 0, x / 4 + k + 1, 0.2 - 0.009 * k);
            for (int side = 0; k > 3 && side < 4; ++side) {
                const double turn = side * 1.5707963;
                row(below, x, 0, x / 4 + k, x + 3 * std::cos(turn), 3 * std::sin(turn), x / 4 + k + 1, 0.03);
            }
        }
    }
    int stem = 0;
    for (int k = 0; k < 4; ++k) {
        stem = row(stem, 5, 5, 2 + k * 0.5, 5, 5, 2.5 + k * 0.5, 0.01);
        for (int side = 0; side < 4; ++side)
            row(stem, 5, 5, 2 + k * 0.5, 5 + std::cos(side * 1.5707963), 5 + std::sin(side * 1.5707963), 2.2 + k * 0.5,
                0.005);
    }
    row(0, 12.4, 0, 5, 14, 0, 5.5, 0.04);
    const Imported in = imported(table, "slope.csv");
    const Splines& s = in.splines;
    CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == 3);
    CHECK(in.notes_hold("1 of 4 trunks begin in the air: joined to the nearest wood, the farthest over 0.4 units"));
    for (std::size_t b = 0; b < s.branches(); ++b) {
        double longest = 0;
        for (auto k = std::size_t(s.first_point[b]) + 1; k < std::size_t(s.first_point[b + 1]); ++k)
            longest = std::max(longest, (s.point[k] - s.point[k - 1]).norm());
        CHECK(longest < 3.2); // no wood is invented
    }
}

TEST_CASE("the same table in another dress is the same tree") {
    const std::string plain = fixture("archi_small.csv");
    const Splines expected = imported(plain, "a.csv").splines;
    std::string tabs = plain, blanks = plain, numbered, diameters;
    for (char& c : tabs) c = c == ',' ? '\t' : c;
    for (char& c : blanks) c = c == ',' ? ' ' : c;
    CHECK(same(imported(tabs, "a.txt").splines, expected));
    CHECK(same(imported("# by hand\n" + blanks, "a.txt").splines, expected));
    CHECK(same(imported(replaced(plain, "\"cyl_ID\"", "Cylinder ID"), "a.csv").splines, expected));
    // R writes rows with names of their own.
    std::istringstream lines(plain);
    std::string line;
    for (int row = 0; std::getline(lines, line); ++row)
        numbered += (row == 0 ? "" : "\"" + std::to_string(row) + "\",") + line + "\r\n";
    CHECK(same(imported(numbered, "a.csv").splines, expected));
    // What R, Python and MATLAB write for no parent.
    for (const char* none : {"NA", "nan", "NaN", "None"})
        CHECK(same(imported(replaced(plain, "\n0,0.05,", "\n" + std::string(none) + ",0.05,"), "a.csv").splines,
                   expected));
    // Without radii there are some, thinner outward.
    const Imported bare = imported(replaced(plain, "radius_cyl", "something"), "a.csv");
    CHECK(bare.notes_hold("radii"));
    for (const double r : bare.splines.radius) CHECK(r > 0);
    CHECK(bare.splines.radius[0] >= bare.splines.radius[2]);
}

TEST_CASE("wrong tables of cylinders are refused with their line") {
    const std::string good = fixture("archi_small.csv"), text = fixture("cylinder_small.txt");
    const auto error = [&](const std::string& from, const std::string& to) {
        return error_of(replaced(good, from, to), "a.csv");
    };
    CHECK(error("3,0.01,0", "9,0.01,0") ==
          "a.csv:5: parent 9 does not exist, expected the id of a cylinder, or 0 or -1 for none");
    CHECK(error("1,0.02,0", "2,0.02,0") == "a.csv:3: is its own ancestor, expected a tree");
    CHECK(error(",3,1,0.005", ",2,1,0.005").find("a.csv:4: id 2 is used twice") == 0);
    CHECK(error("0.02,1.5", "NA,1.5") == "a.csv:5: column \"starty\" holds \"NA\", expected a finite number");
    CHECK(error("1,0.04", "1,-0.04") == "a.csv:4: radius is -0.04, expected 0 or more");
    CHECK(error("1,0.04", "1.5,0.04") == "a.csv:4: column \"parentid\" holds \"1.5\", expected a whole number");
    CHECK(error("1,0.04,0,0,1,0,0,2,3,1,0.005", "1,0.04,0,0,1") ==
          "a.csv:4: 5 columns, expected 11 as the line of names says");
    CHECK(error_of(good.substr(0, good.find('\n')), "a.csv").find("holds no cylinder") != std::string::npos);
    CHECK(error_of(replaced(text, "0\t0\t1\t0\t2", "0\t0\t0\t0\t2"), "a.txt").find("a.txt:2: length is 1") == 0);
    CHECK(error_of(text.substr(0, text.find('\n')), "a.txt").find("no row") != std::string::npos);
}

TEST_CASE("a second scan in a table, whose parents count from its own first row, is refused with its line") {
    // A trunk of 4 m and a branch; the rows of the second are the first's, `aside`, and count their parents on from `after`.
    const auto rows = [](double aside, int after, int size) {
        std::ostringstream text;
        const int parent[] = {0, 1, 2, 2, 4, 3};
        const double x[] = {0, 0, 0, 0, 1, 0}, z[] = {0, 1, 2, 2, 2, 3}, dx[] = {0, 0, 0, 1, 1, 0},
                     dz[] = {1, 1, 1, 0, 0, 1};
        for (int k = 0; k < size; ++k)
            text << (k == 0 ? 0 : parent[k] + after) << "," << x[k] + aside << ",0," << z[k] << ","
                 << x[k] + dx[k] + aside << ",0," << z[k] + dz[k] << ",0.05\n";
        return text.str();
    };
    const std::string names = "parent,sx,sy,sz,ex,ey,ez,radius\n";
    const std::string error = "a.csv:8: begins a second scan, whose parents count from its own first row; expected "
                              "parents that count all rows of the file, or one scan in a file";
    CHECK(error_of(names + rows(0, 0, 6) + rows(10, 0, 6), "a.csv") == error);
    CHECK(error_of(names + rows(0, 0, 6) + rows(0, 0, 6), "a.csv") == error); // the same scan twice
    CHECK(error_of(names + rows(0, 0, 6) + rows(10, 0, 2), "a.csv") == error);
    CHECK(error_of(names + rows(0, 0, 3) + rows(10, 0, 6), "a.csv").starts_with("a.csv:5: begins a second scan"));
    CHECK(error_of(names + rows(0, 0, 6) + rows(10, 6, 6) + rows(20, 0, 6), "a.csv").starts_with("a.csv:14: begins a"));
    // Two trees that count on, and wood that lost its parent before rows of the trunk, are no second scan.
    CHECK(imported(names + rows(0, 0, 6) + rows(10, 6, 6), "a.csv").splines.branches() == 4);
    const std::string lost = "0,0.5,0,3.5,1,0,3.5,0.05\n",
                      on_trunk = "1,0,0,0.5,0,1,0.5,0.02\n2,0,0,1.5,0,1,1.5,0.02\n";
    CHECK(error_of(names + rows(0, 0, 6) + lost + on_trunk, "a.csv").empty());
    // All roots first.
    CHECK(
        error_of(names + rows(0, 0, 1) + rows(10, 0, 1) + rows(20, 0, 1) + "1,0,0,1,0,0,2,0.05\n2,10,0,1,10,0,2,0.05\n",
                 "a.csv")
            .empty());
    const std::string table = names + rows(0, 0, 6);
    CHECK(error_of(table + table, "a.csv") == "a.csv:8: is a second line of names, of another table in the same file; "
                                              "expected one table in a file");
}

TEST_CASE("a scan that was cut off is noted by the first row whose extension is not there") {
    const std::string rows = "parent,extension,sx,sy,sz,ex,ey,ez,radius\n"
                             "0,2,0,0,0,0,0,1,0.1\n"
                             "1,5,0,0,1,0,0,2,0.1\n"
                             "1,4,0,0,1,1,0,1,0.1\n"
                             "3,0,1,0,1,2,0,1,0.1\n"
                             "2,12,0,0,2,0,0,3,0.1\n";
    const auto noted = [](const std::string& table) {
        for (const std::string& line : imported(table, "a.csv").notes.lines)
            if (line.find("extension") != std::string::npos) return line;
        return std::string();
    };
    CHECK(noted(rows) == "line 6: its extension is not in the file; was the file cut off?");
    CHECK(noted(replaced(rows, "2,12,", "2,0,")).empty());
    // In the number: 1 of 12.
    CHECK(noted(replaced(rows, "2,12,", "2,1,")) ==
          "line 6: its extension is another cylinder's child; was the file cut off?");
    CHECK(noted(rows.substr(0, rows.find("2,12,"))) ==
          "line 3: its extension is not in the file; was the file cut off?");
    CHECK(noted(rows.substr(0, rows.find("3,0,1"))) ==
          "line 3: its extension is not in the file, nor are those of 1 other row; was the file cut off?");
    CHECK(noted(replaced(rows, "2,12,", "2,NA,")).empty());
    for (const char* name : {"measured/Tf18.csv", "measured/Tf03.csv", "qsm/cylinder_treeqsm_rtwig.txt"})
        if (const auto whole = foreign_case(name)) CHECK(noted(*whole).empty());
}

TEST_CASE("a cylinder far thicker than the tree is large is refused with its line, and noted before that") {
    const auto table = [](double thick) {
        std::ostringstream text;
        text << "parent,sx,sy,sz,ex,ey,ez,radius\n";
        for (int k = 0; k < 10; ++k)
            text << k << ",0,0," << k << ",0,0," << k + 1 << "," << (k == 6 ? thick : 0.02) << "\n";
        return text.str();
    };
    const std::string found = "radius is 50 units in a tree that is 10 large, with a median radius of 0.02";
    CHECK(error_of(table(50), "a.csv") == "a.csv:8: " + found + "; expected less than the tree is large");
    CHECK(error_of(table(1e9), "a.csv").starts_with("a.csv:8: radius is 1e+09 units"));
    CHECK(error_of(table(10), "a.csv").empty());
    const Imported thick = imported(table(3), "a.csv");
    CHECK(thick.notes_hold(
        "line 8: radius is 3 units in a tree that is 10 large, with a median radius of 0.02: is it a slip?"));
    CHECK(std::count_if(thick.notes.lines.begin(), thick.notes.lines.end(),
                        [](const std::string& line) { return line.find("is it a slip?") != std::string::npos; }) == 1);
    CHECK_FALSE(imported(table(2), "a.csv").notes_hold("slip")); // a baobab
}

TEST_CASE("real tables agree with another reading of them") {
    // Counts, sum of |end - start|, lowest and highest end, least and greatest radius of the rows: read by Python's csv
    // (TreeQSM: split at tabs, end = start + length * axis / |axis|).
    struct Case {
        const char* name;
        double length, tolerance, low, high, thin, thick;
        int roots;
    };
    for (const Case& c :
         {Case{"qsm/cylinder_treeqsm_rtwig.txt", 32.8007, 0.02, 253.887, 257.6054132, 0.0029, 0.0465, 1},
          Case{"qsm/simpleforest_QSM.csv", 31.426368, 1e-6, 253.888632, 257.590586, 0.004621, 0.047917, 1}}) {
        const auto content = foreign_case(c.name);
        if (!content) return;
        const Imported in = imported(*content, c.name);
        const Splines& s = in.splines;
        INFO(c.name);
        CHECK(total_length(s) == Approx(c.length).epsilon(c.tolerance));
        CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == c.roots);
        double low = 1e300;
        for (const Vec3& p : s.point) low = std::min(low, p.y());
        CHECK(top_of(s) - low == Approx(c.high - c.low).epsilon(1e-6)); // the origin is far away and moved
        CHECK(*std::min_element(s.radius.begin(), s.radius.end()) == Approx(c.thin));
        CHECK(*std::max_element(s.radius.begin(), s.radius.end()) == Approx(c.thick));
    }
}

TEST_CASE("damaged tables are read or refused in one line") {
    damage(fixture("cylinder_small.txt"), "d.txt", 1);
    damage(fixture("simpleforest_small.csv"), "d.csv", 1);
    damage(fixture("archi_small.csv"), "d.csv", 1);
}
