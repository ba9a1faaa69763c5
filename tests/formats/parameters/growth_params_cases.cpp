// Other people's presets: branches per level against what the rules of each program give, worked out here from the
// parameters and the lengths that grew, and against counts of the programs themselves: Blender 3.4's Sapling and
// friggog's tree-gen (in Blender 3.4), run with the seeds 0 to 5 and 1 to 6.
#include "tests/support/params_support.h"

using namespace bough;
using namespace bough::test;
using Catch::Detail::Approx;

namespace {

std::optional<GrowthParameters> preset(const std::string& name) {
    const auto content = foreign_case("params/" + name);
    if (!content) return {};
    return read_params(*content, name).growth;
}

// Per seed: branches of each level, then leaves and flowers.
std::vector<std::vector<double>> counts(const GrowthParameters& p, std::uint64_t seeds, bool leaves) {
    std::vector<std::vector<double>> result(5);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const Splines s = grown(p, seed, leaves);
        for (int n = 0; n < 4; ++n) result[std::size_t(n)].push_back(double(measure::of_level(s, n).size()));
        std::size_t petals = 0;
        for (std::size_t i = 0; i < s.leaves(); ++i) petals += s.is_petal(i);
        result[4].push_back(double(s.leaves() - petals) + double(petals) / p.petals);
    }
    return result;
}

// The number of pieces that stems of a level come in, each chance to split making 1 + splits of one.
void check_pieces(const GrowthParameters& p, int level, double splits, int chances, double first) {
    std::vector<double> pieces;
    for (std::uint64_t seed = 0; seed < (level == 0 ? 40u : 3u); ++seed) {
        const Splines s = grown(p, seed, false);
        const std::vector<std::size_t> all = measure::of_level(s, level), whole = whole_stems(s, level);
        std::vector<double> of(s.branches(), 0);
        for (const std::size_t b : all) {
            std::size_t root = b;
            while (s.parent[root] >= 0 && s.level[std::size_t(s.parent[root])] == level)
                root = std::size_t(s.parent[root]);
            ++of[root];
        }
        for (const std::size_t b : whole) pieces.push_back(of[b]);
    }
    CAPTURE(level, pieces.size());
    const double wanted = first * std::pow(1 + splits, chances);
    CHECK(mean(pieces) == Approx(wanted).margin(4 * std::sqrt(variance(pieces) / double(pieces.size())) + 1e-9));
}

} // namespace

TEST_CASE("Arbaro's presets without splits: children and leaves of each stem by its length and place") {
    struct {
        const char* name;
        double boughs, branches, length, leaves;
    } const presets[] = {{"arbaro_quaking_aspen.xml", 50, 30, 0.3, 25},
                         {"arbaro_lombardy_poplar.xml", 40, 30, 0.3, 12},
                         {"arbaro_palm.xml", 33, 0, 0, 250}};
    for (const auto& c : presets) {
        const auto p = preset(c.name);
        if (!p) return;
        CAPTURE(c.name);
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const Splines s = grown(*p, seed);
            REQUIRE(measure::of_level(s, 0).size() == 1);
            REQUIRE(measure::of_level(s, 1).size() == std::size_t(c.boughs));
            for (const std::size_t b : measure::of_level(s, 1)) {
                CHECK(measure::last(s, b) - measure::first(s, b) == std::size_t(p->level[1].curve_res));
                if (c.branches == 0) continue;
                const double number =
                    c.branches * (0.2 + 0.8 * measure::length(s, b) / measure::length(s, 0) / c.length);
                CHECK(double(measure::children(s, b).size()) == Approx(std::floor(number)).margin(1));
            }
            double leaves = 0;
            const auto last = measure::of_level(s, p->levels - 1);
            for (const std::size_t b : last) leaves += c.leaves * (0.5 + 0.5 * s.parent_at[b]);
            CHECK(double(s.leaves()) == Approx(leaves).margin(4 * 0.5 * std::sqrt(double(last.size()))));
        }
    }
}

TEST_CASE("Arbaro's presets with splits: what splits off shares its stem's children") {
    const auto oak = preset("arbaro_ca_black_oak.xml");
    if (!oak) return;
    check_pieces(*oak, 0, 0.4, 6, 3);
    check_pieces(*oak, 1, 0.2, 9, 1);
    check_pieces(*oak, 2, 0.1, 2, 1);
    std::vector<double> boughs;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        boughs.push_back(double(whole_stems(grown(*oak, seed, false), 1).size()));
    CHECK(mean(boughs) == Approx(40).margin(4 * std::sqrt(variance(boughs) / double(boughs.size()))));
}

TEST_CASE("Arbaro's willow stays in its envelope, and weeps") {
    const auto p = preset("arbaro_weeping_willow.xml");
    if (!p) return;
    const Splines s = grown(*p, 4, false);
    const double scale = measure::length(s, 0) / 0.8;
    std::size_t down = 0, twigs = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.level[b] == 0) continue;
        for (std::size_t i = measure::first(s, b) + 1; i <= measure::last(s, b); ++i) {
            const Vec3& at = s.point[i];
            const double ratio = (scale - at.y()) / (scale * 0.95);
            REQUIRE((ratio >= 0 && ratio <= 1));
            const double width = ratio < 0.4 ? std::pow(ratio / 0.4, 0.5) : std::pow((1 - ratio) / 0.4, 0.001);
            REQUIRE(std::hypot(at.x(), at.z()) <= scale * 0.4 * width * (1 + 1e-9));
        }
        if (s.level[b] != 2) continue;
        ++twigs;
        down += measure::end_direction(s, b).y() < 0;
    }
    CHECK(double(down) > 0.9 * double(twigs));
}

TEST_CASE("Sapling's presets have as many branches and leaves as in Blender") {
    if (const auto p = preset("sapling_quaking_aspen.json")) {
        const auto ours = counts(*p, 4, true);
        CHECK(ours[1] == std::vector<double>(4, 30));
        CHECK(ours[4] == std::vector<double>(4, 441));
    }
    if (const auto p = preset("sapling_small_maple.json")) {
        const auto ours = counts(*p, 12, true);
        same_mean(ours[0], {16, 13, 16, 18, 16, 15});
        same_mean(ours[1], {322, 280, 313, 303, 309, 326});
        same_mean(ours[2], {2844, 2828, 2935, 2886, 2942, 2885});
        same_mean(ours[4], {18145, 17416, 18195, 17891, 17987, 18116});
    }
    if (const auto p = preset("sapling_weeping_willow.json")) {
        const auto ours = counts(*p, 12, true);
        same_mean(ours[0], {11, 7, 10, 9, 7, 6});
        same_mean(ours[1], {300, 273, 275, 264, 181, 209});
        same_mean(ours[2], {980, 990, 941, 945, 880, 873});
        same_mean(ours[4], {32676, 31984, 31610, 31015, 27978, 28795});
    }
}

TEST_CASE("tree-gen's presets have as many branches and leaves as in Blender") {
    if (const auto p = preset("treegen_apple.json")) {
        const auto ours = counts(*p, 12, true);
        CHECK(ours[0] == std::vector<double>(12, 1));
        same_mean(ours[1], {237, 226, 243, 250, 193, 224});
        same_mean(ours[2], {1120, 965, 1018, 1092, 1022, 1003});
        same_mean(ours[4], {28796, 22854, 31561, 26421, 35778, 26348});
    }
    if (const auto p = preset("treegen_small_pine.json")) {
        const auto ours = counts(*p, 12, true);
        same_mean(ours[1], {715, 695, 601, 739, 627, 683});
        same_mean(ours[4], {59702, 57477, 57722, 59318, 63965, 60172});
    }
    if (const auto p = preset("treegen_weeping_willow.json")) {
        const auto ours = counts(*p, 6, false);
        same_mean(ours[0], {7, 6, 6});
        same_mean(ours[1], {151, 147, 150});
        same_mean(ours[2], {1687, 1567, 1489});
        same_mean(ours[3], {39082, 33944, 33158});
        // Of stems that no other splits off, every point lies in the envelope.
        const Splines s = grown(*p, 2);
        const double scale = 15 * s.leaf_length[0] / 0.13; // leaves grow with the tree; the trunk may be pruned
        for (const std::size_t b : whole_stems(s, 2))
            for (std::size_t i = measure::first(s, b) + 1; i <= measure::last(s, b); ++i) {
                const Vec3& at = s.point[i];
                const double ratio = (scale - at.y()) / (scale * 0.95);
                const double width = ratio < 0.4 ? std::pow(ratio / 0.4, 0.5) : std::pow((1 - ratio) / 0.4, 0.001);
                REQUIRE(std::hypot(at.x(), at.z()) <= scale * 0.4 * width * (1 + 1e-9));
            }
    }
}
