#include "formats/documents/species.h"
#include "lib/growth/segment.h"
#include "lib/plan/pose.h"
#include "lib/study/modes.h"
#include "tests/support/grow_measure.h"
#include "tests/support/sanitized.h"
#include "tests/support/simulate.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

using namespace bough;
using namespace bough::measure;

namespace {

Species named(const std::string& name) {
    for (const SpeciesFile& file : species_files())
        if (file.name == name) return read_species(file.content, name);
    FAIL("no species " << name);
    return {};
}

std::vector<Species> all_species() {
    std::vector<Species> all;
    for (const SpeciesFile& file : species_files()) all.push_back(read_species(file.content, std::string(file.name)));
    return all;
}

// Its tree of seed 2, bare or with leaves and fruit, grown once for all cases.
const Splines& whole(const Species& species, bool in_leaf) {
    static std::map<std::pair<std::string, bool>, Splines> grown;
    const auto [at, first_time] = grown.try_emplace({species.name, in_leaf});
    if (first_time) at->second = grow(species.growth, 2, {in_leaf, false, in_leaf});
    return at->second;
}

double height(const Splines& s) {
    double top = 0;
    for (const Vec3& p : s.point) top = std::max(top, p.y());
    return top;
}

// Diameter of the first trunk 1.3 m above the ground.
double breast_diameter(const Splines& s) {
    for (std::size_t i = first(s, 0); i < last(s, 0); ++i) {
        const double below = s.point[i].y(), above = s.point[i + 1].y();
        if (below <= 1.3 && above > 1.3)
            return 2 * (s.radius[i] + (1.3 - below) / (above - below) * (s.radius[i + 1] - s.radius[i]));
    }
    FAIL("the trunk does not reach 1.3 m");
    return 0;
}

double mass_of(const Tree& tree, Kind kind) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == kind) sum += tree.mass[i];
    return sum;
}

// Oven-dry mass above ground [kg] of a tree of diameter d [cm], and of its foliage: Jenkins, Chojnacky, Heath, Birdsey,
// "National-scale biomass estimators for United States tree species", Forest Science 49 (2003), tables 4 and 6.
struct Jenkins {
    double b0, b1, f0, f1;
    double all(double d) const { return std::exp(b0 + b1 * std::log(d)); }
    double foliage(double d) const { return all(d) * std::exp(f0 + f1 / d); }
};
const std::map<std::string, Jenkins> jenkins = {
    {"willow", {-2.2094, 2.3867, -4.0813, 5.8816}}, {"cherry", {-2.4800, 2.4835, -4.0813, 5.8816}},
    {"apple", {-2.4800, 2.4835, -4.0813, 5.8816}},  {"maple", {-2.0127, 2.4342, -4.0813, 5.8816}},
    {"oak", {-2.0127, 2.4342, -4.0813, 5.8816}},    {"birch", {-1.9123, 2.3651, -4.0813, 5.8816}},
    {"pine", {-2.5356, 2.4349, -2.9584, 4.4766}},
};
// Basic density over 1000 kg/m^3 (USDA Wood Handbook; apple: common wood tables).
const std::map<std::string, double> basic_density = {{"willow", 0.36}, {"cherry", 0.47}, {"apple", 0.61},
                                                     {"maple", 0.56},  {"oak", 0.56},    {"birch", 0.48},
                                                     {"pine", 0.34}};
constexpr double dry_leaf = 0.4; // oven-dry over fresh mass of leaves, within 0.3 to 0.5

} // namespace

TEST_CASE("The paper's four species and four more are there") {
    std::vector<std::string> names;
    for (const Species& s : all_species()) names.push_back(s.name);
    for (const char* name : {"willow", "cherry", "apple", "maple", "oak", "birch", "pine", "palm"})
        CHECK(std::count(names.begin(), names.end(), name) == 1);
}

// (In leaf: resolve.cpp.)
TEST_CASE("Each species has the number of bodies asked for") {
    for (const Species& species : all_species()) {
        Splines s = whole(species, false);
        for (const std::int64_t bodies : cases<std::int64_t>(1, {100, 5000})) {
            INFO(species.name << " " << bodies);
            ask_for_bodies(s, bodies);
            CHECK(std::abs(double(count_bodies(s, {})) / double(bodies) - 1) <= 0.1);
            CHECK_FALSE(check(s).has_value());
        }
    }
}

TEST_CASE("An odd number of bodies is met") {
    const Species oak = named("oak");
    for (const std::uint64_t seed : {7, 8, 9}) {
        const Splines s = grow_bodies(oak.growth, seed, {}, 137);
        CHECK_FALSE(check(s).has_value());
        CHECK(std::abs(double(count_bodies(s, {})) / 137 - 1) <= 0.1);
        CHECK(s.branches() > 10);
    }
}

TEST_CASE("Each species stands: height, diameter and buckling as in real trees") {
    for (const Species& species : all_species()) {
        INFO(species.name);
        const Splines& s = whole(species, false);
        const double h = height(s), d = breast_diameter(s);
        const Material& wood = species.growth.wood;
        const double buckles = 0.79 * std::cbrt(wood.youngs_modulus / (wood.density * 9.81)) * std::cbrt(d * d);
        INFO("height " << h << " m, diameter " << d << " m, height at which it would buckle " << buckles << " m");
        CHECK(h < 0.6 * buckles); // trees keep a factor of about 2 to 4 (McMahon 1973)
        CHECK(h > 0.15 * buckles);
        CHECK(h / d > 15); // open-grown oaks to slender palms
        CHECK(h / d < 80);
    }
}

TEST_CASE("A willow's strands all hang") {
    const Splines& s = whole(named("willow"), false);
    std::int64_t strands = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.level[b] != 3) continue;
        ++strands;
        const double base = s.point[first(s, b)].y();
        double top = base;
        for (std::size_t i = first(s, b); i <= last(s, b); ++i) top = std::max(top, s.point[i].y());
        INFO("strand " << b << " of " << length(s, b) << " m");
        REQUIRE(top - base < 0.3);
        if (length(s, b) > 1) REQUIRE(base - s.point[last(s, b)].y() > 0.6 * length(s, b));
    }
    CHECK(strands > 5000);
}

TEST_CASE("Nothing grows into the ground") {
    for (const SpeciesFile& file : species_files()) {
        const Species species = read_species(file.content, std::string(file.name));
        for (const double part : cases<double>(1, {1, 0.4, 0.2})) {
            const Splines s = grow(at_age(species, part * species.mature_age), 1, {true, true, true});
            INFO(species.name << " at " << part << " of its age");
            for (std::size_t b = 0; b < s.branches(); ++b)
                for (auto i = std::size_t(s.first_point[b]); i < std::size_t(s.first_point[b + 1]); ++i)
                    REQUIRE(s.point[i].y() >= 0);
        }
    }
}

TEST_CASE("Wood and leaves weigh what trees of that diameter weigh") {
    for (const auto& [name, source] : jenkins) {
        const Species species = named(name);
        const Splines s = grow(species.growth, 1, {true, false, false});
        const Tree tree = segment(s, species.growth.wood, {});
        const double d = 100 * breast_diameter(s);
        const double dry = 1000 * basic_density.at(name) / species.growth.wood.density;
        const double wood = dry * mass_of(tree, Kind::branch) / (source.all(d) - source.foliage(d));
        const double leaves = dry_leaf * mass_of(tree, Kind::leaf) / source.foliage(d);
        INFO(name << ", diameter " << d << " cm: wood " << wood << ", leaves " << leaves << " of the estimate");
        // The estimators are of forest trees; trees in the open have more crown for their diameter, fruit trees most.
        CHECK(wood > 0.5);
        CHECK(wood < (name == "apple" ? 3 : 2));
        CHECK(leaves > 0.5);
        CHECK(leaves < (name == "apple" ? 4 : 2.5));
    }
}

TEST_CASE("A pine sways as conifers do, at three ages") {
    // Moore & Maguire (2004), 602 conifers: f = 0.0766 + 3.1219 d[cm] / H[m]^2. Clear wood on rigid ground is faster than
    // a standing stem with knots, bark and roots that give: up to 1.6 times is taken as their range.
    const Species pine = named("pine");
    for (const double age : {10.0, 25.0, 60.0}) {
        const Splines s = grow(at_age(pine, age), 1, {true, false, false});
        const Tree tree = segment(s, pine.growth.wood, {});
        const double h = height(s),
                     f = sway_along(SmallMotion(tree, {0, -9.81, 0}, Pose::drawn), Vec3::UnitX()).frequency;
        const double measured = 0.0766 + 3.1219 * 100 * breast_diameter(s) / (h * h);
        INFO("age " << age << ", height " << h << " m: " << f << " Hz, conifers " << measured << " Hz");
        CHECK(f > measured / 1.6);
        CHECK(f < measured * 1.6);
    }
}

TEST_CASE("No branch is bent by its load more than most_sag, and every joint holds the drawn pose") {
    for (const Species& species : all_species()) {
        INFO(species.name);
        const Splines& s = whole(species, true);
        const Tree tree = segment(s, species.growth.wood, {});
        // The turn of each joint under gravity, K^-1 tau, summed along each branch as vectors of its pieces.
        const StartPose pose = start_pose(tree, {0, -9.81, 0}, Pose::drawn); // throws where a joint does not hold
        std::vector<double> bent(s.branches(), 0.0), twisted(s.branches(), 0.0);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            if (tree.kind[i] != Kind::branch) continue;
            bent[std::size_t(tree.branch[i])] += pose.theta[i].head<2>().norm();
            twisted[std::size_t(tree.branch[i])] += std::abs(pose.theta[i].z());
        }
        // The springs of one or two pieces take their whole load at the joint: 1.5 times the wood's own bending under
        // an even load, twice its twist under one leaf.
        CHECK(*std::max_element(bent.begin(), bent.end()) < 1.7 * species.growth.most_sag);
        CHECK(*std::max_element(twisted.begin(), twisted.end()) < 2.2 * species.growth.most_sag);
    }
}

TEST_CASE("Each species stays where it was drawn") {
    // An equilibrium that is not stable doubles its rounding errors many times in ten seconds.
    for (const Species& species : all_species()) {
        Splines splines = whole(species, true);
        INFO(species.name);
        ask_for_bodies(splines, 1000);
        const Tree tree = segment(splines, species.growth.wood, {});
        simulate::PlainRun<double> run(tree, Scene());
        const std::vector<Vec3> drawn = run.state.x_w;
        run.steps(300);
        double moved = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            moved = std::max(moved, (run.state.x_w[i] - drawn[i]).norm());
        CHECK(moved < 1e-10);
    }
}

TEST_CASE("Trees grow with age, as tall and as thick as the species says") {
    for (const Species& species : all_species()) {
        INFO(species.name);
        const double mature = species.growth.scale * species.growth.level[0].length;
        const GrowthParameters grown = at_age(species, species.mature_age);
        CHECK(grown.scale * grown.level[0].length == Approx(mature));
        double before = 0;
        for (const double age : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0}) {
            const GrowthParameters p = at_age(species, age);
            const double h = p.scale * p.level[0].length;
            CHECK(h > before);
            CHECK(p.ratio * h / (species.growth.ratio * mature) ==
                  Approx(std::pow(h / mature, species.diameter_power)));
            before = h;
        }
        // A young tree is a tree, with some leaves on it.
        const Splines young = grow(at_age(species, 3), 1, {true, false, false});
        CHECK_FALSE(check(young).has_value());
        CHECK(young.branches() > 1);
        CHECK(young.leaves() > 0);
        CHECK_NOTHROW(at_age(species, 0.1));
        for (const double age : {0.0, 0.099, double(NAN), double(INFINITY)})
            CHECK_THROWS_WITH(at_age(species, age),
                              Catch::Contains("age: is") && Catch::Contains("expected 0.1 years"));
    }
}

TEST_CASE("Seasons: cherries blossom in spring and bear in summer, broad leaves fall, needles stay") {
    const auto tree = [](const char* name, Season season) {
        const Species species = named(name);
        return grow(in_season(species, species.growth, season), 1, {true, true, true});
    };
    const auto petals = [](const Splines& s) { return std::count(s.leaf_kind.begin(), s.leaf_kind.end(), 1); };
    const Splines spring = tree("cherry", Season::spring), summer = tree("cherry", Season::summer),
                  winter = tree("cherry", Season::winter);
    CHECK(petals(spring) > 10000);
    CHECK(petals(spring) % 5 == 0);
    CHECK(spring.fruits() == 0);
    CHECK(petals(summer) == 0);
    CHECK(summer.fruits() > 100);
    CHECK(summer.leaves() > 10000);
    CHECK(winter.leaves() == 0);
    CHECK(winter.fruits() == 0);
    CHECK(tree("pine", Season::winter).leaves() > 10000);
    const Species maple = named("maple");
    const Vec3 autumn = colors_in_season(maple, Season::autumn)[1], green = colors_in_season(maple, Season::summer)[1];
    CHECK(autumn[0] > autumn[1]);
    CHECK(green[1] > green[0]);
}

TEST_CASE("A species document says where it is wrong") {
    const std::string good(species_files().front().content);
    const auto message = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const auto at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
        try {
            read_species(text, "x.json");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("read");
    };
    CHECK(message("\"shape\"", "\"shap\"") != "read");
    CHECK_THAT(message("\"shape\"", "\"shap\""), Catch::Contains("shap"));
    CHECK_THAT(message("\"material\": \"", "\"material\": \"un"), Catch::Contains("/material"));
    CHECK_THAT(message("\"levels\": 4", "\"levels\": 3"), Catch::Contains("expected 3"));
    CHECK_THAT(message("\"levels\": 4", "\"levels\": 9"), Catch::Contains("/levels"));
    CHECK_THAT(message("\"ratio\": 0", "\"ratio\": -0"), Catch::Contains("ratio"));
    CHECK_THAT(message("\"season_leaves\": [", "\"season_leaves\": [1, "), Catch::Contains("season_leaves"));
    CHECK_THAT(message("\"version\": 1", "\"version\": 2"), Catch::Contains("version"));
}
