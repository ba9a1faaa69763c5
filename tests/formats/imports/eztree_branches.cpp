// Lists of ez-tree's branches: one worked out by hand, real ones against their own numbers, and damage.
#include "tests/support/import_support.h"
#include <nlohmann/json.hpp>

using namespace bough;
using namespace bough::test;

TEST_CASE("a list alone is drawn through its children's origins, then straight") {
    const Imported in = imported(fixture("eztree_list.json"), "eztree_list.json");
    const Splines& s = in.splines;
    CHECK(in.notes_hold("5 branches drawn"));
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 0, 1, 2}); // as many on each of the level before, in order
    CHECK(s.first_point == std::vector<std::int32_t>{0, 4, 7, 10, 12, 14});
    const std::vector<Vec3> trunk{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 4, 0}};
    for (std::size_t k = 0; k < trunk.size(); ++k) CHECK(near(s.point[k], trunk[k]));
    CHECK(s.parent_at[1] == Approx(0.75));
    CHECK(s.parent_at[2] == Approx(0.25));
    // -90 degrees about z turn y to x; its child pulls it up, and the rest of its length goes on that way.
    const double bent = std::sqrt(1.25);
    CHECK(near(s.point[5], {1, 3.5, 0}));
    CHECK(near(s.point[6], Vec3(1, 3.5, 0) + (2 - bent) / bent * Vec3(1, 0.5, 0)));
    CHECK(s.parent_at[3] == Approx(bent / 2));
    // 90 degrees about x turn y to z; the child begins on that line.
    CHECK(near(s.point[9], {0, 1, 1}));
    CHECK(near(s.point[11], {1, 4, 0})); // turning about y leaves y
    CHECK(s.radius[0] == Approx(0.2));
    CHECK(s.radius[1] == Approx(0.2 * (1 - 0.7 / 4)));
    CHECK(s.radius[3] == Approx(0.06));
}

TEST_CASE("a field parent goes before the order") {
    std::string text = fixture("eztree_list.json");
    const char* key = "\"level\": ";
    const int parent[] = {-1, 0, 0, 2, 1};
    std::size_t at = 0;
    for (const int p : parent) {
        at = text.find(key, at);
        text.insert(at, "\"parent\": " + std::to_string(p) + ", ");
        at = text.find(key, at) + 1;
    }
    CHECK(imported(text, "p.json").splines.parent == std::vector<std::int32_t>{-1, 0, 0, 2, 1});
}

TEST_CASE("wrong lists are refused where they are wrong") {
    const std::string good = fixture("eztree_list.json");
    const auto error = [&](const std::string& from, const std::string& to) {
        return error_of(replaced(good, from, to), "e.json");
    };
    CHECK(error("\"length\": 4", "\"length\": \"4\"").find("e.json:3: ") == 0);
    CHECK(error("\"length\": 4", "\"length\": -4") == "e.json:3: is below 0, expected 0 or more");
    CHECK(error("\"length\": 4", "\"breadth\": 4") ==
          "e.json:3: branch 0 has no length, expected level, origin, orientation, length and radius");
    CHECK(error("\"level\": 0", "\"level\": 0.5") == "e.json:3: is no level, expected a whole number from 0");
    CHECK(error("[0, 3, 0]", "[0, 3]") == "e.json:4: has not all of x, y and z, expected three numbers");
    CHECK(error("[0, 3, 0]", "[0, 1e999, 0]").find("e.json:4: ") == 0);
    CHECK(error("\"level\": 2", "\"level\": 1").find("as many on each, or a field parent") != std::string::npos);
    CHECK(error_of(good.substr(0, good.size() / 2), "e.json").find("e.json:") == 0);
    damage(good, "d.json", 1);
}

TEST_CASE("real lists: every branch begins and is as long and thick as its list says, on the curves of its preset") {
    for (const char* name : {"eztree/eztree_ash_small.branches.json", "eztree/eztree_pine_small.branches.json"}) {
        const auto content = foreign_case(name);
        if (!content) return;
        const auto list = nlohmann::json::parse(*content).at("branches");
        ImportOptions options;
        options.unit = 1;
        for (const bool with_preset : {true, false}) {
            const Imported in =
                imported(with_preset ? *content : replaced(*content, "\"options\"", "\"other\""), name, options);
            const Splines& s = in.splines;
            INFO(name << " " << with_preset);
            CHECK(in.notes_hold(with_preset ? "those of the preset" : "drawn through"));
            REQUIRE(s.branches() == list.size());
            double worst = 0;
            for (std::size_t b = 0; b < list.size(); ++b) {
                const auto first = std::size_t(s.first_point[b]);
                const auto& o = list[b].at("origin");
                worst = std::max(worst, (s.point[first] - Vec3(o[0], o[1], o[2])).norm());
                CHECK(s.radius[first] == Approx(list[b].at("radius").get<double>()).epsilon(1e-5));
                // Drawn through its children, a branch cuts their corners: it is never longer.
                const double length = branch_length(s, b), listed = list[b].at("length");
                CHECK(length == Approx(listed).epsilon(1e-5));
                CHECK(s.level[b] == list[b].at("level").get<int>());
                if (s.parent[b] < 0) continue;
                // The place on the parent is where the branch begins.
                const auto host = std::size_t(s.parent[b]);
                double arc = s.parent_at[b] * branch_length(s, host), off = 1e300;
                for (auto k = std::size_t(s.first_point[host]); k + 1 < std::size_t(s.first_point[host + 1]); ++k) {
                    const double piece = (s.point[k + 1] - s.point[k]).norm();
                    const double t = piece > 0 ? arc / piece : 0;
                    if (t >= -1e-6 && t <= 1 + 1e-6)
                        off = std::min(off, (s.point[k] + t * (s.point[k + 1] - s.point[k]) - s.point[first]).norm());
                    arc -= piece;
                }
                worst = std::max(worst, off);
            }
            CHECK(worst < 2e-4); // the lists are printed with seven digits, orientations summed over sections
        }
    }
}
