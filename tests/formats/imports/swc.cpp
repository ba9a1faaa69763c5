#include "tests/support/import_support.h"
#include <map>

using namespace bough;
using namespace bough::test;

TEST_CASE("an SWC skeleton with shuffled ids, a soma, two roots and a segment without length") {
    const Imported in = imported(fixture("shuffled.swc"), "shuffled.swc");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 3);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, -1});
    // Equal radii: the longest way (7) goes on, the side branch leaves at 3 of 7.
    CHECK(branch_length(s, 0) == Approx(7));
    CHECK(s.parent_at[1] == Approx(3.0 / 7));
    CHECK(near(s.point[s.first_point[1]], {0, 3, 0}));
    CHECK(near(s.point[s.first_point[2] - 1], {0, 3, -3}));
    // The soma's radius 2 is not a branch's; the second root's 0.25 is.
    CHECK(s.radius[0] == 0.5);
    CHECK(s.radius[s.first_point[2]] == 0.25);
    CHECK(s.radius.back() == 0.1);
    CHECK(in.notes_hold("1 outline node"));
    CHECK(in.notes_hold("taken as Z"));
    CHECK(in.notes_hold("taken as m, because the tree is 7 units high"));
}

TEST_CASE("a fork goes on with the thickest child, then the longest, then the straightest") {
    const std::string stem = "1 3 0 0 0 1 -1\n2 3 0 0 2 1 1\n";
    const auto second = [&](const std::string& children) {
        const Splines s = imported(stem + children, "fork.swc").splines;
        REQUIRE(s.branches() == 2);
        return s.point[s.first_point[1] - 1]; // where the first branch ends
    };
    CHECK(near(second("3 3 0 0 9 0.5 2\n4 3 1 0 2 0.6 2\n"), {1, 2, 0}));
    CHECK(near(second("3 3 0 0 3 0.5 2\n4 3 2 0 2 0.5 2\n"), {2, 2, 0}));
    CHECK(near(second("3 3 2 0 2 0.5 2\n4 3 0 0 4 0.5 2\n"), {0, 4, 0}));
}

TEST_CASE("units of an SWC follow from its height unless given") {
    const std::string tall = "1 3 0 0 0 10 -1\n2 3 0 0 900 1 1\n";
    const Imported in = imported(tall, "tall.swc");
    CHECK(top_of(in.splines) == Approx(9));
    CHECK(in.notes_hold("taken as cm, because the tree is 900 units high and no tree is 900 m high"));
    CHECK(top_of(imported("1 3 0 0 0 1 -1\n2 3 0 0 116 1 1\n", "tallest.swc").splines) == 116);
    CHECK(top_of(imported("1 3 0 0 0 1 -1\n2 3 0 0 130 1 1\n", "low.swc").splines) == Approx(1.3));
    CHECK(top_of(imported("1 3 0 0 0 1 -1\n2 3 0 0 20000 1 1\n", "mm.swc").splines) == Approx(20));
    ImportOptions options;
    options.unit = 1e-6;
    options.up = 'y';
    const Imported given = imported(tall, "tall.swc", options);
    CHECK(near(given.splines.point[1], {0, 0, 900e-6}));
    CHECK(given.notes.lines.empty());
}

TEST_CASE("an SWC whose radii are all 0 has none: they are guessed, as for other files without any") {
    // A trunk of 20 m and a branch at half its height: the longest way over 68 is the base's radius, and each of two tips carries half.
    const std::string without = "1 3 0 0 0 0 -1\n2 3 0 0 10 0 1\n3 3 0 0 20 0 2\n4 3 5 0 10 0 2\n";
    const Imported in = imported(without, "none.swc");
    CHECK(in.splines.radius[0] == Approx(20 / 68.0));
    CHECK(in.splines.radius[2] == Approx(20 / 68.0 / std::pow(2, 1 / 2.25)));
    CHECK(in.notes_hold("with tips of 0.2161 in the file's unit"));
    CHECK(in.notes_hold("the file has no radii: its trunk is taken as 0.5882 m thick at the base"));
    // One that is there is kept, and so are the zeros beside it.
    const Imported some = imported(replaced(without, "0 10 0 1", "0 10 0.2 1"), "some.swc");
    CHECK(some.splines.radius[1] == 0.2);
    CHECK(some.splines.radius[2] == 0);
    CHECK_FALSE(some.notes.radii_guessed);
}

TEST_CASE("wrong SWC files are refused with their line") {
    const std::string good = fixture("shuffled.swc");
    CHECK(error_of(replaced(good, "0.5   9\n12", "0.5   99\n12"), "s.swc") ==
          "s.swc:8: parent 99 does not exist, expected the id of a node or -1");
    CHECK(error_of(replaced(good, "12 3", " 9 3"), "s.swc").find("s.swc:9: id 9 is used twice") == 0);
    CHECK(error_of(replaced(good, "0 7  0.5", "0 7,5 0.5"), "s.swc").find("s.swc:9: \"7,5\" is not a node's z") == 0);
    CHECK(error_of(replaced(good, "0 7  0.5", "0 7 -0.5"), "s.swc").find("s.swc:9: radius is -0.5") == 0);
    CHECK(error_of(replaced(good, "0 7  0.5", "0 7 inf"), "s.swc").find("s.swc:9: \"inf\" is not a node's radius") ==
          0);
    CHECK(error_of(replaced(good, "0 7  0.5   5", "0 7  0.5"), "s.swc").find("s.swc:9: 6 columns") == 0);
    CHECK(error_of(replaced(good, "0.5  4\n", "0.5  12\n"), "s.swc").find("is its own ancestor") != std::string::npos);
    CHECK(error_of("# nothing\n", "s.swc").find("s.swc: holds no node") == 0);
    CHECK(error_of("1 1 0 0 0 1 -1\n", "s.swc").find("no branch with a length") != std::string::npos);
    CHECK(error_of("1 1 zero 0 0 1 -1\n", "s.swc").find("s.swc:1: \"zero\" is not a node's x") == 0);
}

TEST_CASE("lines that end with CR alone, as old Mac programs wrote them") {
    for (const char* name : {"shuffled.swc", "lines.obj", "tip_to_base.obj", "cylinder_small.txt", "archi_small.csv",
                             "shrub.mtg", "two_trees.txt", "eztree_list.json", "two_trunks_spines.xml"}) {
        INFO(name);
        std::string lf, cr;
        for (const char c : fixture(name))
            if (c != '\r') lf += c, cr += c == '\n' ? '\r' : c;
        for (const std::string& text : {cr, cr + "\n"}) {
            const Splines a = imported(lf, name).splines, b = imported(text, name).splines;
            CHECK(a.point == b.point);
            CHECK(a.parent == b.parent);
            CHECK(a.radius == b.radius);
        }
    }
    std::string wrong = replaced(fixture("shuffled.swc"), "0 7  0.5", "0 7,5 0.5");
    std::replace(wrong.begin(), wrong.end(), '\n', '\r');
    CHECK(error_of(wrong, "s.swc").find("s.swc:9: \"7,5\" is not a node's z") == 0);
}

TEST_CASE("sizes that nothing can be reckoned with are refused, absurd ones named") {
    const std::string good = "1 3 0 0 0 1 -1\n2 3 0 0 7 1 1\n";
    const auto given = [&](double unit) {
        ImportOptions options;
        options.unit = unit;
        options.up = 'z';
        options.name = "s.swc";
        ImportNotes notes;
        import_splines(good, options, notes);
        return notes.lines.empty() ? std::string() : notes.lines.back();
    };
    CHECK_THROWS_WITH(given(1e300), Catch::Matchers::Contains("s.swc: reaches 7e+300 m, expected at most 1e+15 m"));
    CHECK_THROWS_WITH(given(1e308), Catch::Matchers::Contains("reaches inf m"));
    CHECK_THROWS_WITH(given(1e-300), Catch::Matchers::Contains("is 7e-300 m large, expected at least 1e-30 m"));
    CHECK(given(1e14).find("the tree is 7e+14 m high, no tree is: is --units right?") == 0);
    CHECK(given(200).find("the tree is 1400 m high") == 0);
    CHECK(given(100).empty());
    CHECK(error_of("1 3 0 0 -1e308 1 -1\n2 3 0 0 1e308 1 1\n", "s.swc").find("reaches 1e+305 m") != std::string::npos);
    CHECK(
        error_of(
            R"({"format": "bough-splines", "version": 1, "name": "far", "parent": [-1], "parent_at": [0], "level": [0],
                       "first_point": [0, 2], "point": [0, -1e308, 0, 0, 1e308, 0], "radius": [1, 1]})",
            "s.json")
            .find("s.json: /point/0: is (0, -1e+308, 0), expected at most 1e+15") == 0);
}

TEST_CASE("damaged SWC files are read or refused in one line") {
    damage(fixture("shuffled.swc"), "damaged.swc", 1);
}

TEST_CASE("skeletons of neurons: lengths and roots as another reading counts them") {
    struct Case {
        const char* name;
        std::size_t stems;
    };
    for (const Case& c : {Case{"skeleton/simple.swc", 2},
                          {"skeleton/sequential_trunk_off_42_16pt.swc", 1},
                          {"skeleton/Neuron.swc", 0},
                          {"skeleton/sample_mixed_tree_sections.swc", 0},
                          {"skeleton/Neuron_3_random_walker_branches.swc", 0},
                          {"invalid/Neuron-flat.swc", 0},
                          {"invalid/Neuron_zero_length_segments.swc", 0}}) {
        const auto content = foreign_case(c.name);
        if (!content) return;
        INFO(c.name);
        double length = 0;
        std::map<int, Vec3> point;
        std::map<int, int> parent_of;
        std::istringstream lines(*content);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream numbers(line.substr(0, line.find('#')));
            int id, type, parent;
            double x, y, z, r;
            if (!(numbers >> id >> type >> x >> y >> z >> r >> parent)) continue;
            point[id] = {x, y, z};
            parent_of[id] = parent;
        }
        for (const auto& [id, parent] : parent_of)
            if (parent != -1) length += (point.at(id) - point.at(parent)).norm();
        ImportOptions metres;
        metres.unit = 1;
        const Splines s = imported(*content, c.name, metres).splines;
        CHECK(total_length(s) == Approx(length).epsilon(1e-12));
        if (c.stems > 0) CHECK(std::size_t(std::count(s.parent.begin(), s.parent.end(), -1)) == c.stems);
    }
}

TEST_CASE("a byte order mark, and whole numbers printed as reals") {
    const Splines s = imported("\xEF\xBB\xBF"
                               "1.0\t2.0\t0\t0\t0\t0.1\t-1.0\n2.0\t2.0\t0\t0\t5\t0.1\t1.0\n",
                               "b.swc")
                          .splines;
    CHECK(total_length(s) == Approx(5));
    CHECK(error_of("1.5 2 0 0 0 .1 -1\n", "h.swc").find("h.swc:1: \"1.5\" is not a node's id") == 0);
}

TEST_CASE("an SWC with missing parents names the first row that has one") {
    const auto content = foreign_case("invalid/Neuron_missing_parents.swc");
    if (!content) return;
    CHECK(error_of(*content, "n.swc").find("does not exist") != std::string::npos);
}
