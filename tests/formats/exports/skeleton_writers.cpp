#include "formats/exports/skeleton_writer.h"
#include "lib/growth/grow.h"
#include "tests/support/hand_made.h"
#include "tests/support/import_support.h"
#include <filesystem>
#include <map>
#include <unistd.h>

using namespace bough;
using namespace bough::test;
using hand_made::add_branch;

namespace {

using Writer = void (*)(Output&, const Splines&, std::vector<std::string>&);

struct Text {
    std::string text;
    std::vector<std::string> notes;
    bool notes_hold(const std::string& part) const {
        return std::any_of(notes.begin(), notes.end(),
                           [&](const std::string& n) { return n.find(part) != std::string::npos; });
    }
};

Text written(Writer writer, const Splines& splines) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bough_test_skeleton_" + std::to_string(getpid()))).string();
    Text made;
    Output output(path);
    writer(output, splines, made.notes);
    output.finish();
    made.text = read_input(path);
    std::filesystem::remove(path);
    return made;
}

// A trunk of 4 m and 8 points of height 0, 2, 4; a branch at a point, one between two points, one off the axis, a second trunk.
Splines small() {
    Splines s;
    s.name = "small";
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, {0.4, 0.3, 0.1});
    add_branch(s, 0, 0.5, {{0, 2, 0}, {1, 3, 0}}, {0.1, 0.05});
    add_branch(s, 0, 0.75, {{0, 3, 0}, {0, 3, 1}, {0, 3, 2}}, {0.08, 0.08, 0});
    add_branch(s, 0, 0.25, {{0.3, 1, 0}, {1, 1, 0}}, {0.09, 0.02});
    add_branch(s, -1, 0, {{5, 0, 1}, {5, 1, 1}}, {0.2, 0.1});
    return s;
}

std::string without_comments(const std::string& text) {
    std::string rest;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.empty() || line[0] != '#') rest += line + "\n";
    return rest;
}

// Every point of the splines is a point of the others, with its radius (that of a branch's base aside where `bases` is
// false), and lengths are the same but for `more`.
void same_tree(const Splines& before, const Splines& after, double more, double tolerance) {
    std::map<std::tuple<long, long, long>, std::vector<std::size_t>> cells;
    const auto cell = [&](const Vec3& p) {
        return std::tuple(std::lround(p.x() * 1e3), std::lround(p.y() * 1e3), std::lround(p.z() * 1e3));
    };
    for (std::size_t i = 0; i < after.points(); ++i) cells[cell(after.point[i])].push_back(i);
    std::size_t missing = 0;
    for (std::size_t b = 0; b < before.branches(); ++b)
        for (auto i = std::size_t(before.first_point[b]); i < std::size_t(before.first_point[b + 1]); ++i) {
            bool found = false;
            const bool base = i == std::size_t(before.first_point[b]);
            const auto [x, y, z] = cell(before.point[i]);
            for (int k = 0; k < 27 && !found; ++k) {
                const auto near = cells.find({x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1});
                if (near == cells.end()) continue;
                for (const std::size_t j : near->second)
                    found = found || ((after.point[j] - before.point[i]).norm() <= tolerance &&
                                      (base || std::abs(after.radius[j] - before.radius[i]) <= tolerance));
            }
            missing += !found;
        }
    CHECK(missing == 0);
    CHECK(total_length(after) == Approx(total_length(before) + more).epsilon(1e-9));
    CHECK(std::count(after.parent.begin(), after.parent.end(), -1) >=
          std::count(before.parent.begin(), before.parent.end(), -1));
}

} // namespace

TEST_CASE("an SWC of a small tree, worked out by hand") {
    const Text swc = written(write_swc, small());
    CHECK(swc.text.compare(0, 22, "# bough: metres, Z up\n") == 0);
    // x, -z, y; the trunk has nodes of its own at 1 m (radius 0.35) and 3 m (0.2), where branches leave it.
    CHECK(without_comments(swc.text) == "1 0 0 0 0 0.4 -1\n"
                                        "2 0 0 0 1 0.35 1\n"
                                        "3 0 0 0 2 0.3 2\n"
                                        "4 0 0 0 3 0.2 3\n"
                                        "5 0 0 0 4 0.1 4\n"
                                        "6 0 1 0 3 0.05 3\n"
                                        "7 0 0 -1 3 0.08 4\n"
                                        "8 0 0 -2 3 0 7\n"
                                        "9 0 0.3 0 1 0.09 2\n"
                                        "10 0 1 0 1 0.02 9\n"
                                        "11 0 5 -1 0 0.2 -1\n"
                                        "12 0 5 -1 1 0.1 11\n");
    CHECK(swc.notes_hold("1 branch begins off its parent's axis"));
    CHECK(swc.notes_hold("1 branch's radius at its base"));
    CHECK_FALSE(swc.notes_hold("no thinner"));
}

TEST_CASE("a tree file of a small tree, worked out by hand") {
    const Text txt = written(write_treetools, small());
    CHECK(without_comments(txt.text) ==
          "x,y,z,radius,parent_id\n"
          "0,0,0,0.4,-1, 0,0,1,0.35,0, 0,0,2,0.3,1, 0,0,3,0.2,2, 0,0,4,0.1,3, 1,0,3,0.05,2, 0,-1,3,0.08,3, 0,-2,3,0,6, "
          "0.3,0,1,0.09,1, 1,0,1,0.02,8\n"
          "5,-1,0,0.2,-1, 5,-1,1,0.1,0\n");
    CHECK(txt.notes_hold("radius at the foot of 2 trunks"));
}

TEST_CASE("the small tree comes back") {
    const Splines s = small();
    for (const auto& [writer, name] :
         {std::pair<Writer, const char*>{write_swc, "s.swc"}, {write_treetools, "s.txt"}}) {
        const Text text = written(writer, s);
        const Imported back = imported(text.text, name);
        CHECK(back.notes.lines.empty()); // nothing is guessed
        same_tree(s, back.splines, 0.3, 1e-12);
        REQUIRE(back.splines.branches() == 5);
        CHECK(back.splines.parent == std::vector<std::int32_t>{-1, 0, 0, 0, -1});
        std::vector<double> at = back.splines.parent_at;
        std::sort(at.begin(), at.end());
        CHECK(at == std::vector<double>{0, 0, 0.25, 0.5, 0.75});
    }
}

TEST_CASE("what readers will see otherwise is counted") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, {0.4, 0.3, 0.1});
    add_branch(s, 0, 0.5, {{0, 2, 0}, {1, 3, 0}}, {0.2, 0.2}); // thicker than the trunk's next
    add_branch(s, 0, 1, {{0, 4, 0}, {0, 5, 0}}, {0.1, 0.05});  // at its tip
    add_branch(s, 0, 0, {{0, 0, 0}, {1, 1, 0}}, {0.1, 0.1});   // at its foot
    s.leaf_branch = {1};
    s.color = default_colors();
    const Text swc = written(write_swc, s);
    CHECK(swc.notes_hold("2 branches are no thinner"));
    CHECK(swc.notes_hold("1 branch leaves its parent at its foot"));
    CHECK(swc.notes_hold("1 leaf or petal"));
    CHECK(swc.notes_hold("colours"));
    same_tree(s, imported(swc.text, "s.swc").splines, 0, 1e-12);
}

TEST_CASE("grown trees come back to rounding, by both") {
    const Splines s = grow(default_growth(), 5, {});
    const Text swc = written(write_swc, s), txt = written(write_treetools, s);
    // Another reading of the SWC: the sum of the distances of nodes to their parents.
    double length = 0;
    std::vector<Vec3> node(1, Vec3::Zero());
    std::istringstream lines(without_comments(swc.text));
    int id, type, parent;
    double x, y, z, r;
    while (lines >> id >> type >> x >> y >> z >> r >> parent) {
        REQUIRE(id == int(node.size()));
        node.emplace_back(x, y, z);
        if (parent > 0) length += (node.back() - node[std::size_t(parent)]).norm();
    }
    const double more = length - total_length(s); // pieces from the axis
    CHECK(more > -1e-9);
    same_tree(s, imported(swc.text, "grown.swc").splines, more, 1e-9);
    same_tree(s, imported(txt.text, "grown.txt").splines, more, 1e-9);
}

TEST_CASE("what was read from a tree file is written as the same tree file") {
    for (const char* name : {"qsm/treetools_tree_seed1.txt", "qsm/treetools_forest_seed2_w12.txt"}) {
        const auto content = foreign_case(name);
        if (!content) return;
        const Splines once = imported(*content, name).splines;
        const Splines twice = imported(written(write_treetools, once).text, name).splines;
        CHECK(twice.parent == once.parent);
        REQUIRE(twice.point.size() == once.point.size());
        double off = 0;
        for (std::size_t i = 0; i < once.point.size(); ++i)
            off = std::max({off, (twice.point[i] - once.point[i]).norm(), std::abs(twice.radius[i] - once.radius[i])});
        CHECK(off < 1e-12);
    }
}

TEST_CASE("a chain of 3e4 pieces and 3e4 branches on one piece are written") {
    Splines s;
    std::vector<Vec3> line;
    for (int i = 0; i <= 30000; ++i) line.emplace_back(0, i / 3e3, 0);
    add_branch(s, -1, 0, line, std::vector<double>(line.size(), 0.1));
    for (int i = 1; i <= 30000; ++i)
        add_branch(s, 0, i / 30001.0, {{0, i * 10 / 30001.0, 0}, {0.1, i * 10 / 30001.0, 0}}, {0.01, 0.01});
    const Splines back = imported(written(write_swc, s).text, "comb.swc").splines;
    CHECK(back.branches() == 30001);
    CHECK(total_length(back) == Approx(10 + 3e3));
}
