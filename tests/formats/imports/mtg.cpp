// Multiscale tree graphs: a shrub worked out by hand, the same in other dress, a real one against another reading, what has
// no geometry, and damage.
#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

TEST_CASE("an MTG of two scales: runs, branches, entities without position, diameters in mm beside positions in cm") {
    const Imported in = imported(fixture("shrub.mtg"), "shrub.mtg");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 4);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 1, -1});
    CHECK(s.first_point == std::vector<std::int32_t>{0, 3, 6, 8, 10});
    const std::vector<Vec3> points{{0, 0, 0}, {0, 1, 0},     {0, 3, 0},        {0, 1, 0}, {0.5, 1.5, 0},
                                   {1, 2, 0}, {0.5, 1.5, 0}, {0.5, 1.5, -0.3}, {4, 0, 0}, {4, 1.5, 0}};
    for (std::size_t k = 0; k < points.size(); ++k) CHECK(near(s.point[k], points[k]));
    // 50 on a plant 300 high: in cm 6 times as high as thick, in mm 60.
    for (const auto& [k, r] : {std::pair(0, 0.025), std::pair(1, 0.02), std::pair(2, 0.01), std::pair(3, 0.005),
                               std::pair(4, 0.005), std::pair(5, 0.0025), std::pair(8, 0.015), std::pair(9, 0.015)})
        CHECK(s.radius[std::size_t(k)] == Approx(r));
    CHECK(s.radius[6] > 0); // has none in the file, and grows on 5 mm
    CHECK(s.radius[6] <= 0.005 + 1e-12);
    CHECK(s.parent_at[1] == Approx(1.0 / 3));
    CHECK(s.parent_at[2] == Approx(0.5));
    CHECK(in.notes_hold("diameters multiplied by 0.1"));
    CHECK(in.notes_hold("7 of 15 entities without a position"));
    CHECK(in.notes_hold("taken as cm"));
    CHECK(in.notes_hold("taken as Z"));
}

TEST_CASE("another plant begins with '/' at scale 1, whatever was before") {
    const Splines s =
        imported(fixture("shrub.mtg") + "/P3/A1\t\t\t\t0\t30\t-400\t0\n^/E1\t\t\t\t100\t30\t-400\t0\n", "p.mtg")
            .splines;
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 1, -1, -1});
    CHECK(near(s.point.back(), {-4, 1, 0}));
}

TEST_CASE("options decide unit and axis, and with them the scale of diameters") {
    ImportOptions options;
    options.unit = 0.001;
    options.up = 'z';
    const Splines s = imported(fixture("shrub.mtg"), "shrub.mtg", options).splines;
    CHECK(near(s.point[2], {0, 0.3, 0}));
    CHECK(s.radius[0] == Approx(0.0025)); // 0.3 m high: 0.1 mm, 60 times as high as thick again
}

TEST_CASE("a graph without positions is refused with what it lacks") {
    const std::string good = fixture("shrub.mtg");
    CHECK(error_of(replaced(good, "TopDia\tXX", "TopDia\tLength"), "m.mtg")
              .find("m.mtg:24: has no positions, its features "
                    "are ZZ, TopDia, Length, YY; expected") == 0);
    const auto foreign = foreign_case("skeleton/wij10.mtg");
    if (!foreign) return;
    const std::string error = error_of(*foreign, "wij10.mtg");
    CHECK(error.find("wij10.mtg:45: has no positions, its features are diabase, diasom, longueur, nbfruit, rem") == 0);
}

TEST_CASE("wrong MTGs are refused with their line") {
    const std::string good = fixture("shrub.mtg");
    const auto error = [&](const std::string& from, const std::string& to) {
        return error_of(replaced(good, from, to), "m.mtg");
    };
    CHECK(error("\t\t+A2", "\t\t+Q2") == "m.mtg:29: entity \"Q2\" is of no class that CLASSES names");
    CHECK(error("\t\t+A2", "\t\t=A2").find("m.mtg:29: \"=A2\" does not begin with an edge") == 0);
    CHECK(error("\t150\t10", "\t15O\t10") == "m.mtg:30: ZZ is \"15O\", expected a finite number or nothing");
    CHECK(error("A\t2\tFREE", "A\ttwo\tFREE").find("m.mtg:8: class \"A\" has the scale \"two\"") == 0);
    CHECK(error("ENTITY-CODE", "ENTITIES").find("m.mtg:24: begins with \"ENTITIES\"") == 0);
    CHECK(error_of(good.substr(0, good.find("MTG:")), "m.mtg").find("ends before the section MTG") !=
          std::string::npos);
    damage(good, "d.mtg", 1);
}

TEST_CASE("a real MTG agrees with another reading of it") {
    // By a script over the rows split at tabs (last three cells: XX, YY, ZZ), without classes or edges: 356 rows have a
    // position, ZZ from -0.359779 to 0.456144; a row "^<S" goes on from the last position with as many leading tabs, a row
    // "/S1" from the last one with a tab less; the distances sum up to 9.505105606.
    const auto content = foreign_case("skeleton/reconstructed_appletree.mtg");
    if (!content) return;
    ImportOptions options;
    options.unit = 1;
    const Splines s = imported(*content, "apple.mtg", options).splines;
    double low = 1e300;
    for (const Vec3& p : s.point) low = std::min(low, p.y());
    CHECK(low == Approx(-0.359779));
    CHECK(top_of(s) == Approx(0.456144));
    CHECK(total_length(s) == Approx(9.505105606).epsilon(1e-9));
    CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == 1);
}
