#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

TEST_CASE("a tree file with fields of the tree and two trees becomes two trunks and their branches") {
    const Imported in = imported(fixture("two_trees.txt"), "two_trees.txt");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 4);
    CHECK(s.name == "two_trees");
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 0, -1});
    CHECK(s.level == std::vector<std::int32_t>{0, 1, 1, 0});
    // The thickest child goes on: 2 m, 2 m, 2 m of trunk; branches leave it at 2 m and, past a segment without length, at 4 m.
    CHECK(branch_length(s, 0) == Approx(6));
    CHECK(s.parent_at[1] == Approx(2.0 / 6));
    CHECK(branch_length(s, 1) == Approx(std::sqrt(13.0)));
    CHECK(s.parent_at[2] == Approx(4.0 / 6));
    CHECK(branch_length(s, 2) == Approx(3));
    CHECK(branch_length(s, 3) == Approx(3));
    // Z up becomes Y up: (x, y, z) -> (x, z, -y). Radii are those of the segments; the root's own (99) is not used.
    CHECK(near(s.point[0], {1, 0, -2}));
    CHECK(near(s.point[3], {1, 6, -2}));
    CHECK(near(s.point[s.first_point[3]], {-5, 1, 0}));
    CHECK(std::vector<double>(s.radius.begin(), s.radius.begin() + 4) == std::vector<double>{0.2, 0.2, 0.15, 0.1});
    CHECK(s.radius[s.first_point[1]] == 0.1);
    CHECK(in.notes_hold("1 segment without length"));
}

TEST_CASE("a tree file whose root has fields of its own") {
    const Splines s = imported(fixture("root_fields.txt"), "root_fields.txt").splines;
    REQUIRE(s.branches() == 1);
    REQUIRE(s.points() == 3);
    CHECK(top_of(s) == 5);
    CHECK(s.radius == std::vector<double>{0.3, 0.3, 0.2});
}

TEST_CASE("unit and up axis of a tree file can be overridden") {
    ImportOptions options;
    options.unit = 0.01;
    options.up = 'y';
    const Splines s = imported(fixture("two_trees.txt"), "two_trees.txt", options).splines;
    CHECK(near(s.point[0], {0.01, 0.02, 0}));
    CHECK(s.radius[0] == Approx(0.002));
}

TEST_CASE("wrong tree files are refused with their line") {
    const std::string good = fixture("two_trees.txt");
    CHECK(error_of(replaced(good, "4,2,4,0.1,1,1", "4,2,4x,0.1,1,1"), "t.txt") ==
          "t.txt:3: \"4x\" is not a segment's z, expected a finite number");
    CHECK(error_of(replaced(good, "0.1,1,1", "nan,1,1"), "t.txt").find("t.txt:3: \"nan\"") == 0);
    CHECK(error_of(replaced(good, "0.1,1,1", "-0.1,1,1"), "t.txt").find("t.txt:3: radius is -0.1") == 0);
    CHECK(error_of(replaced(good, "0.1,1,1", "0.1,7,1"), "t.txt").find("t.txt:3: \"7\" is not a parent_id") == 0);
    CHECK(error_of(replaced(good, "-5,0,4,0.1,0,0", "-5,0,4,0.1,0"), "t.txt").find("t.txt:4: 13 numbers") == 0);
    CHECK(error_of(replaced(good, "1,2,2,0.2,0,0", "1,2,2,0.2,2,0"), "t.txt").find("t.txt:3: is its own ancestor") ==
          0);
    CHECK(error_of("# only\nx,y,z,radius,parent_id\n", "t.txt").find("t.txt: holds no tree") == 0);
    CHECK(error_of("x,y,z,radius\n0,0,0,1\n", "t.txt").find("t.txt:1: has no parent_id") == 0);
    CHECK(error_of("x,y,z,radius,parent_id\n0,0,0,1,-1\n", "t.txt").find("no branch with a length") !=
          std::string::npos);
}

TEST_CASE("a chain of 1e5 segments is read without recursion") {
    std::string text = "x,y,z,radius,parent_id\n0,0,0,0.1,-1";
    for (int i = 1; i <= 100000; ++i) text += ", 0,0," + std::to_string(i) + "e-3,0.1," + std::to_string(i - 1);
    const Splines s = imported(text, "deep.txt").splines;
    CHECK(s.branches() == 1);
    CHECK(s.points() == 100001);
    CHECK(top_of(s) == Approx(100));
}

TEST_CASE("damaged tree files are read or refused in one line") {
    damage(fixture("two_trees.txt"), "damaged.txt", 1);
}

namespace {

// The sum of segment lengths and the number of segments, by means that share nothing with the reader.
struct Sums {
    double length = 0;
    std::size_t trees = 0, segments = 0;
};

Sums sums_of(const std::string& content) {
    Sums sums;
    std::istringstream lines(content);
    std::string line;
    while (std::getline(lines, line)) {
        if (line.empty() || line[0] == '#' || line[0] == 'x') continue;
        ++sums.trees;
        for (char& c : line)
            if (c == ',') c = ' ';
        std::istringstream numbers(line);
        numbers.imbue(std::locale::classic());
        std::vector<Vec3> tip;
        double x, y, z, radius;
        int parent;
        while (numbers >> x >> y >> z >> radius >> parent) {
            tip.emplace_back(x, y, z);
            if (parent >= 0) sums.length += (tip.back() - tip[std::size_t(parent)]).norm();
        }
        sums.segments += tip.size();
    }
    return sums;
}

} // namespace

TEST_CASE("tree files of treetools keep every segment") {
    for (const auto& [name, trees, segments] :
         {std::tuple<const char*, std::size_t, std::size_t>{"qsm/treetools_tree_seed1.txt", 1, 601},
          {"qsm/treetools_tree_seed3.txt", 1, 614},
          {"qsm/treetools_forest_seed2_w12.txt", 6, 1488}}) {
        const auto content = foreign_case(name);
        if (!content) return;
        const Sums sums = sums_of(*content);
        CHECK(sums.trees == trees);
        CHECK(sums.segments == segments);
        const Splines s = imported(*content, name).splines;
        CHECK(total_length(s) == Approx(sums.length).epsilon(1e-12));
        CHECK(std::size_t(std::count(s.parent.begin(), s.parent.end(), -1)) == trees);
        // Every segment is one piece of one branch; each tree's root is no segment.
        CHECK(s.points() - s.branches() == segments - trees);
    }
}
