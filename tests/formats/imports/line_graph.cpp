#include "formats/imports/line_graph.h"
#include "formats/imports/weld.h"
#include "tests/support/import_support.h"
#include "tests/support/sanitized.h"
#include <numeric>

using namespace bough;

namespace {

// A trunk of 4 along z with a fork at 3, every line on its own, at random places and directions, each with its own
// copies of its points.
LineGraph scattered(std::vector<std::array<Vec3, 2>> lines, double jitter = 0) {
    LineGraph g;
    std::mt19937 random(3);
    std::shuffle(lines.begin(), lines.end(), random);
    std::uniform_real_distribution<double> off(-jitter, jitter);
    for (auto& line : lines) {
        if (random() % 2) std::swap(line[0], line[1]);
        for (const Vec3& p : line) g.point.push_back(p + Vec3(off(random), off(random), off(random)));
        g.edge.push_back({std::int32_t(g.point.size()) - 2, std::int32_t(g.point.size()) - 1});
    }
    return g;
}

const std::vector<std::array<Vec3, 2>> forked_lines{{{Vec3(0, 0, 0), Vec3(0, 0, 1)}},
                                                    {{Vec3(0, 0, 1), Vec3(0, 0, 3)}},
                                                    {{Vec3(0, 0, 3), Vec3(0, 0, 4)}},
                                                    {{Vec3(0, 0, 3), Vec3(0.4, 0, 3.3)}}};

double length_of(const std::vector<ImportedBranch>& branches) {
    double length = 0;
    for (const ImportedBranch& b : branches)
        for (std::size_t k = 0; k + 1 < b.point.size(); ++k) length += (b.point[k + 1] - b.point[k]).norm();
    return length;
}

bool holds(const ImportNotes& notes, const std::string& text) {
    return std::any_of(notes.lines.begin(), notes.lines.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

} // namespace

TEST_CASE("lines in any order and direction become one tree that stands on its lowest end") {
    ImportNotes notes;
    const RootedLines tree = root_lines(scattered(forked_lines), 0, "x", notes);
    CHECK(tree.up == 'z');
    REQUIRE(tree.branches.size() == 2);
    CHECK(tree.branches[0].parent == -1);
    CHECK(tree.branches[0].point.front() == Vec3(0, 0, 0));
    CHECK(tree.branches[0].point.back() == Vec3(0, 0, 4));
    CHECK(tree.branches[1].parent == 0);
    CHECK(tree.branches[1].parent_at == Approx(0.75));
    CHECK(length_of(tree.branches) == Approx(4.5));
    CHECK(holds(notes, "3 points welded")); // 8 ends of lines at 5 places
    CHECK(holds(notes, "up axis"));
}

TEST_CASE("points that differ by rounding are one, points that differ by more are not") {
    ImportNotes notes;
    CHECK(root_lines(scattered(forked_lines, 1e-7), 'z', "x", notes).branches.size() == 2);
    CHECK_FALSE(holds(notes, "loose"));
    std::vector<Vec3> cells; // a grid whose neighbours are just too far to be one
    for (int k = 0; k < 1000; ++k) cells.emplace_back(k % 10, k / 10 % 10, k / 100);
    std::vector<Vec3> twice = cells;
    for (const Vec3& p : cells) twice.push_back(p + Vec3(0.5, -0.5, 0.5));
    CHECK(weld(cells, 0.99).size() == 1000);
    CHECK(cells.size() == 1000);
    const std::vector<std::int32_t> index = weld(twice, 0.9); // a copy is sqrt(0.75) away
    CHECK(twice.size() == 1000);
    // Each joins the first point near it, not the nearest.
    for (std::size_t i = 0; i < index.size(); ++i) CHECK(index[i] <= std::int32_t(i % 1000));
}

TEST_CASE("the thick end is the base where radii are known, wherever it lies below the middle") {
    LineGraph g;
    g.point = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 2), Vec3(1, 0, -0.2)};
    g.radius = {0.1, 0.08, 0.01, 0.02}; // a branch hangs lower than the base
    g.edge = {{2, 1}, {1, 3}, {0, 1}};
    ImportNotes notes;
    const RootedLines tree = root_lines(std::move(g), 'z', "x", notes);
    CHECK(tree.branches.front().point.front() == Vec3(0, 0, 0));
    CHECK(tree.branches.front().radius.front() == 0.1);
    CHECK(notes.lines.empty());
}

TEST_CASE("circles are opened at their thinnest line, repeated lines and bare points are left out") {
    LineGraph g;
    g.point = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 2), Vec3(-1, 0, 2), Vec3(9, 9, 9)};
    g.radius = {0.2, 0.2, 0.05, 0.1, 0};
    g.edge = {{0, 1}, {1, 2}, {1, 3}, {2, 3}, {3, 1}, {2, 2}};
    ImportNotes notes;
    const RootedLines tree = root_lines(std::move(g), 'z', "x", notes);
    CHECK(length_of(tree.branches) == Approx(1 + 2 * std::sqrt(2.0)));
    CHECK(holds(notes, "1 line cut that closes a circle"));
    CHECK(holds(notes, "1 line that repeats another"));
    CHECK(holds(notes, "1 line without length"));
    CHECK(holds(notes, "1 point without a line"));
}

TEST_CASE("a loose part keeps its place beside the line that it is attached to") {
    std::vector<std::array<Vec3, 2>> lines = forked_lines;
    lines.push_back({{Vec3(0.05, 0, 2), Vec3(0.5, 0, 2.2)}});
    lines.push_back({{Vec3(0.5, 0, 2.2), Vec3(0.7, 0, 2.2)}});
    ImportNotes notes;
    const RootedLines tree = root_lines(scattered(lines), 'z', "x", notes);
    REQUIRE(tree.branches.size() == 3);
    const auto loose = std::find_if(tree.branches.begin(), tree.branches.end(),
                                    [](const ImportedBranch& b) { return b.point.front() == Vec3(0.05, 0, 2); });
    REQUIRE(loose != tree.branches.end());
    CHECK(loose->parent == 0);
    CHECK(loose->parent_at == Approx(0.5));
    CHECK(loose->point.size() == 3);
    CHECK(holds(notes, "1 loose part attached to the nearest branch, over a gap of up to 0.05"));
}

TEST_CASE("two trees side by side stay two, a broken twig on the ground does not become a third") {
    std::vector<std::array<Vec3, 2>> lines = forked_lines;
    for (const auto& line : forked_lines) lines.push_back({{line[0] + Vec3(3, 0, 0.1), line[1] + Vec3(3, 0, 0.1)}});
    lines.push_back({{Vec3(0.3, 0, 0), Vec3(0.4, 0, 0)}});
    ImportNotes notes;
    const RootedLines forest = root_lines(scattered(lines), 'z', "x", notes);
    CHECK(std::count_if(forest.branches.begin(), forest.branches.end(),
                        [](const ImportedBranch& b) { return b.parent < 0; }) == 2);
    CHECK(holds(notes, "1 loose part"));
}

TEST_CASE("a chain of a hundred thousand loose lines is attached one to the next") {
    // Every line ends a little short of the next one: each is a part of its own, and a circle with its neighbour.
    LineGraph g;
    const int lines = sanitized ? 10000 : 100000;
    for (int k = 0; k < lines; ++k) {
        const std::int32_t i = std::int32_t(g.point.size());
        g.point.emplace_back(0, 0, k);
        g.point.emplace_back(0, 0, k + 0.9);
        g.edge.push_back({i, i + 1});
    }
    ImportNotes notes;
    const RootedLines tree = root_lines(std::move(g), 'z', "x", notes);
    CHECK(tree.branches.size() == std::size_t(lines));
    CHECK(std::count_if(tree.branches.begin(), tree.branches.end(),
                        [](const ImportedBranch& b) { return b.parent < 0; }) == 1);
    CHECK(holds(notes, std::to_string(lines - 1) + " loose parts"));
    for (const ImportedBranch& b : tree.branches) CHECK(b.point.front().z() < b.point.back().z());
}
