// Parameters of other programs: what is read, what is refused, and that a tree follows them. Numbers are worked out here
// from the parameters in the fixtures.
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "tests/support/params_support.h"
#include "tests/support/sanitized.h"

using namespace bough;
using namespace bough::test;
using Catch::Detail::Approx;

namespace {

std::string refusal(const std::string& content, const std::string& name) {
    try {
        read_params(content, name);
    } catch (const InputError& e) {
        const std::string text = e.what();
        CHECK(text.find('\n') == std::string::npos);
        CHECK(text.compare(0, name.size(), name) == 0);
        return text;
    }
    return {};
}

bool holds(const std::string& text, const std::string& part) {
    INFO(text << " | " << part);
    const bool there = text.find(part) != std::string::npos;
    CHECK(there);
    return there;
}

} // namespace

TEST_CASE("An Arbaro species: its parameters, and Arbaro's defaults for the rest") {
    const Read r = read_params(fixture("arbaro_small.xml"), "small.xml");
    const GrowthParameters& p = r.growth;
    CHECK(p.rules == GrowthRules::arbaro);
    CHECK(p.name == "small");
    CHECK(p.level[1].branches == 12);
    CHECK(p.level[1].branch_dist == 0); // Arbaro's 1: spread over the segment
    CHECK(p.ratio_power == 1);
    CHECK(p.leaves == 2.5); // a quarter of the leaves, twice as long
    CHECK(p.leaf_scale == Approx(0.2));
    CHECK(p.leaf_stem == 0.5);
    CHECK(p.level[2].down_angle == 30);
    CHECK(p.level[2].rotate == 120);
    CHECK(p.pipe_exponent == 0);
    holds(r.notes, "not honoured: Lobes, LobeDepth (bodies are round)");
    CHECK(r.notes.find("Smooth") == std::string::npos); // is 0
}

TEST_CASE("A tree by Arbaro's rules has the branches, lengths and angles of its parameters") {
    const GrowthParameters p = read_params(fixture("arbaro_small.xml"), "small.xml").growth;
    std::vector<double> angles, leaves, heights;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Splines s = grown(p, seed);
        REQUIRE(measure::of_level(s, 0).size() == 1);
        REQUIRE(measure::of_level(s, 1).size() == 12);
        const double height = measure::length(s, 0);
        CHECK((height >= 5 && height <= 7));
        heights.push_back(height);
        CHECK(measure::last(s, 0) - measure::first(s, 0) == 4);
        for (const std::size_t b : measure::of_level(s, 1)) {
            CHECK(measure::last(s, b) - measure::first(s, b) == 5);
            CHECK(measure::length(s, b) == Approx(0.4 * height));
            CHECK(s.point[measure::first(s, b)].y() >= 0.2 * height);
            angles.push_back(measure::angle(measure::start_direction(s, b), Vec3::UnitY()));
        }
        leaves.push_back(double(s.leaves()));
        for (const double length : s.leaf_length) CHECK(length == Approx(0.2));
    }
    const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
    CHECK((*low >= 40 && *low < 41 && *high <= 60 && *high > 59));
    CHECK(mean(angles) == Approx(50).margin(4 * 10 / std::sqrt(3.0 * double(angles.size()))));
    CHECK(mean(heights) == Approx(6).margin(4 / std::sqrt(3.0 * double(heights.size()))));
    // 12 stems of 2.5 leaves, each 2 or 3.
    CHECK(mean(leaves) == Approx(30).margin(4 * 0.5 * std::sqrt(12.0 / double(leaves.size()))));
}

TEST_CASE("tree-gen's dict as Python text, and its own numbers of branches") {
    const Read r = read_params(fixture("tree_gen_small.py"), "tree_gen_small.py");
    const GrowthParameters& p = r.growth;
    CHECK(p.rules == GrowthRules::tree_gen);
    CHECK(p.name == "tree_gen_small");
    CHECK(p.ratio_power == 1.2);
    CHECK(p.tropism.norm() == 0);
    holds(r.notes, "not honoured: bevel_res (of the mesh alone)");
    // Its rule: 40 times 0.9 to 1.1, over the part that is not bare, dealt to five segments, what falls on the bare
    // part left out, and what falls where the trunk is thinner than 0.1 mm.
    std::vector<double> wanted;
    for (int k = 0; k < 2000; ++k) {
        const double each = 40 * (0.9 + 0.2 * (k + 0.5) / 2000) / 0.75 / 5;
        double left = 0;
        int number = 0;
        for (int segment = 0; segment < 5; ++segment) {
            const int here = int(left + each);
            left += each - here;
            for (int i = 0; i < here; ++i) {
                const double at = (segment + double(i) / here) / 5;
                number += at > 0.25;
            }
        }
        wanted.push_back(number);
    }
    std::vector<double> numbers, angles;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Splines s = grown(p, seed);
        const auto boughs = measure::of_level(s, 1);
        numbers.push_back(double(boughs.size()));
        CHECK((numbers.back() >= *std::min_element(wanted.begin(), wanted.end()) &&
               numbers.back() <= *std::max_element(wanted.begin(), wanted.end())));
        const double height = measure::length(s, 0);
        CHECK((height >= 4.5 && height <= 5.5));
        for (const std::size_t b : boughs) {
            CHECK(measure::length(s, b) == Approx(0.3 * height));
            CHECK(measure::last(s, b) - measure::first(s, b) == 4);
            CHECK(s.point[measure::first(s, b)].y() > 0.25 * height);
            angles.push_back(measure::angle(measure::start_direction(s, b), Vec3::UnitY()));
        }
        // 16 leaves times the tree's size on each stem, less the one at its start, which is bare.
        const double each = 16 * height / 5;
        CHECK(double(s.leaves()) <= double(boughs.size()) * each);
        CHECK(double(s.leaves()) >= double(boughs.size()) * (std::floor(each) - 1));
    }
    same_mean(numbers, wanted);
    CHECK(mean(angles) == Approx(50).margin(4 * 10 / std::sqrt(3.0 * double(angles.size()))));
}

TEST_CASE("An old Sapling preset: one attractUp, leaf angles of the level below the last") {
    const Read r = read_params(fixture("sapling_old.json"), "old.json");
    const GrowthParameters& p = r.growth;
    CHECK(p.rules == GrowthRules::sapling);
    CHECK(p.level[1].attraction_up == 0);
    CHECK(p.level[2].attraction_up == 0.5);
    CHECK(p.leaf_angles == std::vector<double>{35, 5, -90, 0});
    CHECK(p.prune_ratio == 0);
    holds(r.notes, "bevel (of Blender's curves, mesh, armature or panels)");
    // Its rule: 40 places a 40th apart, a quarter of 41 of them left out; the last is the tip's.
    const int boughs = 40 - int(0.25 * 41) - 1 + 1;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Splines s = grown(p, seed);
        REQUIRE(measure::of_level(s, 1).size() == std::size_t(boughs));
        const double height = measure::length(s, 0);
        CHECK((height >= 4.5 && height <= 5.5));
        std::size_t leaves = 0;
        for (const std::size_t b : measure::of_level(s, 1)) {
            CHECK(measure::last(s, b) - measure::first(s, b) == 5);
            CHECK(measure::length(s, b) == Approx(0.4 * height));
            const double at = s.point[measure::first(s, b)].y() / height;
            const double up = (1 - at) / 0.75;
            const double wanted = at > 1 - 1e-9 ? 0 : 60 - 20 * (1 - up) * (1 - up);
            CHECK(measure::angle(measure::start_direction(s, b), Vec3::UnitY()) == Approx(wanted).margin(1e-4));
            leaves += 12; // a whole stem's, 12 places of which the last is the tip
        }
        CHECK(s.leaves() == leaves);
    }
}

TEST_CASE("The same parameters by another program's rules are another tree") {
    GrowthParameters p = read_params(fixture("arbaro_small.xml"), "small.xml").growth;
    const Splines arbaro = grown(p, 3);
    p.rules = GrowthRules::bough;
    CHECK(grown(p, 3).point != arbaro.point);
}

TEST_CASE("Bodies asked for are met with other programs' parameters, too") {
    for (const char* name : {"arbaro_small.xml", "tree_gen_small.py", "sapling_old.json"}) {
        const GrowthParameters p = read_params(fixture(name), name).growth;
        for (const std::int64_t bodies : {100, 3000}) { // fewer than the tree has, and more
            INFO(name << ", " << bodies << " bodies");
            const Tree tree = segment(grow_bodies(p, 1, {true, false, false}, bodies), wood_presets().front(), {});
            CHECK(double(tree.size_bodies()) == Approx(double(bodies)).epsilon(0.1));
        }
    }
}

TEST_CASE("Parameter files that are broken are refused in one line that names the place") {
    const std::string xml = fixture("arbaro_small.xml"), python = fixture("tree_gen_small.py"),
                      json = fixture("sapling_old.json");
    holds(refusal("", "x"), "x: is empty, expected");
    holds(refusal("  \n", "x"), "x: is empty, expected");
    holds(refusal("hello", "x"), "x:1: ends early, expected = after the dict's name");
    holds(refusal(xml.substr(0, xml.size() / 2), "x.xml"), "x.xml:");
    holds(refusal(python.substr(0, python.size() / 2), "x.py"), "expected");
    holds(refusal(json.substr(0, json.size() / 2), "x.json"), "expected");
    holds(refusal("<tree/>", "x.xml"), "x.xml:1: <tree>, expected Arbaro's <arbaro>");
    holds(refusal("{}", "x.json"), "has no parameter of a known program");
    holds(refusal(replaced(xml, "\"Ratio\" value=\"0.02\"", "\"Ratio\" value=\"0,02\""), "x.xml"),
          "x.xml:10: Ratio: is \"0,02\", expected a number, 1e-06 to 1, with a decimal point");
    holds(refusal(replaced(xml, "\"Ratio\"", "\"Rato\""), "x.xml"),
          "x.xml:10: unknown parameter \"Rato\", the nearest known one is Ratio");
    holds(refusal(replaced(xml, "\"Levels\" value=\"2\"", "\"Levels\" value=\"9\""), "x.xml"),
          "x.xml:6: Levels: is \"9\", expected 1 to 4");
    holds(refusal(replaced(xml, "\"12\"", "\"12.5\""), "x.xml"), "expected a whole number");
    holds(refusal(replaced(xml, "\"Scale\"", "\"Shape\""), "x.xml"), "\"Shape\" is there twice");
    holds(refusal(replaced(xml, "<param name=\"Shape\"", "<parm name=\"Shape\""), "x.xml"), "<parm>, expected <param");
    holds(refusal(replaced(python, "'levels': 2", "'levels': 'two'"), "x.py"),
          "x.py:6: levels: is \"two\", expected a number");
    holds(refusal(replaced(python, "[1, 40, 0, 0]", "[1, 40, 0]"), "x.py"),
          "branches: is \"[1, 40, 0]\", expected a list of 4 numbers");
    holds(refusal(replaced(python, "[5, 4, 0, 0]", "[5, 0, 0, 0]"), "x.py"),
          "expected whole numbers, 1 to 1000 for level 1");
    holds(refusal(replaced(python, "'g_scale_v'", "'g_scal_v'"), "x.py"),
          "unknown parameter \"g_scal_v\", the nearest known one is g_scale_v");
    holds(refusal(replaced(python, "0.02,", "__import__('os'),"), "x.py"), "expected a number");
    holds(refusal(replaced(json, "\"rMode\": \"rotate\"", "\"rMode\": \"spin\""), "x.json"),
          "expected original, rotate or random");
    holds(refusal(replaced(json, "\"shape\": \"3\"", "\"shape\": \"9\""), "x.json"),
          "shape: is \"9\", expected 0 to 8 or 10");
    holds(refusal(replaced(json, "\"ratio\": 0.02", "\"ratio\": 1e999"), "x.json"), "expected a number");
    holds(refusal(replaced(json, "true", "maybe"), "x.json"), "expected a number, true or false");
}

TEST_CASE("Of levels that are not grown, any number is taken") {
    for (const char* content : {R"({"levels": 1, "curveRes": [2, 5, 92233720368547758073, 1]})",
                                "tree = {'levels': 1, 'shape': 0, 'curve_res': [2, 5, 92233720368547758073, 1]}"})
        CHECK(read_params(content, "x").growth.level[0].curve_res == 2);
}

TEST_CASE("A Sapling stem that would split into millions is refused by name, at once") {
    const auto preset = [](int res, const std::string& splits, int base) {
        return "{\"levels\": 2, \"curveRes\": [3, " + std::to_string(res) + ", 3, 1], \"segSplits\": [0, " + splits +
               ", 0, 0], \"branches\": [0, 3, 1, 1], \"baseSplits\": " + std::to_string(base) + "}";
    };
    holds(refusal(preset(40, "2", 0), "x.json"),
          "x.json:1: segSplits: is \"[0, 2, 0, 0]\", expected fewer, so that a stem");
    holds(refusal(preset(1000, "0.1", 0), "x.json"), "level 1 splits into at most 1e6 over its curveRes");
    GrowthParameters p = read_params(preset(12, "2", 3), "x.json").growth;
    CHECK(grown(p, 1, false).branches() > 3 * 1024); // each of three or more, at ten places
    p.level[1].curve_res = 40;
    CHECK_THROWS_WITH(grow(p, 1, {}), Catch::StartsWith("level[1].seg_splits: is 2, expected fewer"));
    p.level[1].curve_res = 12;
    p.level[0].curve_res = 40;
    p.level[0].seg_splits = 1;
    CHECK_THROWS_WITH(grow(p, 1, {}), Catch::StartsWith("level[0].seg_splits: is 1, expected fewer"));
}

TEST_CASE("A file of a million lines is read in one pass, its errors' lines are right") {
    const std::string blank(20'000'000, '\n');
    std::string list, params;
    for (int i = 0; i < 2000; ++i) {
        list += "\"made up " + std::to_string(i) + "\": 1,\n";
        params += "<param name=\"made up " + std::to_string(i) + "\" value=\"1\"/>\n";
    }
    holds(refusal("{" + blank + list + "\"levels\": x}", "x.json"), "x.json:20002001: \"x}\", expected a number");
    holds(refusal(replaced(fixture("arbaro_small.xml"), "<species name=\"small\">",
                           "<species name=\"small\">" + blank + params + "<parm/>"),
                  "x.xml"),
          "<parm>, expected <param");
}

TEST_CASE("Ten thousand trunks find their places, as far apart as there is room") {
    GrowthParameters p = read_params(fixture("tree_gen_small.py"), "small.py").growth;
    p.levels = 1;
    p.leaves = 0;
    p.scale_v = 0;
    const int trunks = sanitized ? 1000 : 10000;
    p.level[0].branches = trunks;
    p.level[0].length = 0.1; // there is room for all of them
    const Splines s = grown(p, 4, false);
    REQUIRE(s.branches() == std::size_t(trunks));
    const double apart = 2.5 * p.scale * p.level[0].length * p.ratio * p.level[0].radius_mod;
    const double far = std::sqrt(trunks / 2.5 * p.scale * p.ratio);
    double nearest = far, farthest = 0;
    for (std::size_t a = 0; a < s.branches(); ++a) {
        const Vec3 here = s.point[std::size_t(s.first_point[a])];
        farthest = std::max(farthest, here.norm());
        for (std::size_t b = 0; b < a; ++b)
            nearest = std::min(nearest, (s.point[std::size_t(s.first_point[b])] - here).norm());
    }
    CHECK(nearest >= apart);
    CHECK(nearest < 1.1 * apart);
    CHECK(farthest <= far);
    CHECK(farthest > 0.99 * far);
}

TEST_CASE("An XML entity bomb does not grow") {
    std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY a \"aaaaaaaaaa\">";
    for (char c = 'b'; c <= 'j'; ++c) {
        bomb += std::string("<!ENTITY ") + c + " \"";
        for (int i = 0; i < 10; ++i) bomb += std::string("&") + char(c - 1) + ";";
        bomb += "\">";
    }
    bomb += "]><arbaro><species name=\"&j;\"><param name=\"Ratio\" value=\"&j;\"/></species></arbaro>";
    holds(refusal(bomb, "bomb.xml"), "Ratio: is \"&j;\", expected a number");
}

TEST_CASE("Damaged parameter files are read or refused in one line") {
    std::mt19937 random(5);
    for (const char* name : {"arbaro_small.xml", "tree_gen_small.py", "sapling_old.json"}) {
        const std::string content = fixture(name);
        for (std::size_t cut = 0; cut < content.size(); cut += 7) refusal(content.substr(0, cut), name);
        for (int round = 0; round < 1000; ++round) {
            std::string broken = content;
            for (int flips = 1 + round % 4; flips > 0; --flips)
                broken[random() % broken.size()] =
                    round % 2 ? char(random() % 256) : "0123456789-.,<>/\"' e[(]"[random() % 23];
            refusal(broken, name);
        }
    }
}
