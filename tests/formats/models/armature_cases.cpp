// Other people's armatures: against each other, and against what their curves and meshes say.
#include "tests/support/import_support.h"
#include <array>
#include <map>
#include <set>

using namespace bough;
using namespace bough::test;

namespace {

ImportOptions beside_cases() {
    ImportOptions options;
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    options.folder = std::string(folder ? folder : "") + "/sapling";
    return options;
}

} // namespace

// The figures of the CSV were had by adding up, in Python, the distances of its 1287 knots along its 346 splines:
// 189.8141 m in 941 steps, 5.077638 m high; x -1.935979 to 1.745624, y (up is z) -2.109290 to 1.754024.
TEST_CASE("one tree as FBX, COLLADA and glTF joints: each other's, and the knots of its curves") {
    const auto table = foreign_case("sapling/sapling_small_pine_s0.csv");
    const auto fbx = foreign_case("sapling/sapling_small_pine_s0_arm.armonly.fbx");
    const auto dae = foreign_case("sapling/sapling_small_pine_s0_arm.armonly.dae");
    const auto glb = foreign_case("sapling/sapling_small_pine_s0_arm.armonly.glb");
    if (!table || !fbx || !dae || !glb) return;
    std::set<std::array<long, 3>> knots; // in millimetres, and their neighbours
    std::istringstream rows(*table);
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
        double spline = 0, point = 0, x = 0, y = 0, z = 0;
        REQUIRE(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf", &spline, &point, &x, &y, &z) == 5);
        for (long a = -1; a <= 1; ++a)
            for (long b = -1; b <= 1; ++b)
                for (long c = -1; c <= 1; ++c)
                    knots.insert({std::lround(1e3 * x) + a, std::lround(1e3 * z) + b, std::lround(-1e3 * y) + c});
    }
    const std::pair<const std::string*, const char*> files[] = {{&*fbx, "p.fbx"}, {&*dae, "p.dae"}, {&*glb, "p.glb"}};
    for (const auto& [content, name] : files) {
        const Imported in = imported(*content, name);
        const Splines& s = in.splines;
        INFO(name);
        CHECK(segments(s) == 941);
        CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == 1);
        CHECK(top_of(s) == Approx(5.077638).epsilon(1e-5));
        std::size_t off = 0; // points that are no knots: ends of tips, which FBX and glTF do not say
        for (const Vec3& p : s.point)
            off += !knots.contains({std::lround(1e3 * p.x()), std::lround(1e3 * p.y()), std::lround(1e3 * p.z())});
        if (std::string(name) == "p.dae") {
            CHECK(off == 0);
            CHECK(total_length(s) == Approx(189.8141).epsilon(1e-6));
        } else {
            CHECK(off < 275);
            CHECK(total_length(s) == Approx(189.8141).epsilon(0.005));
            CHECK(in.notes_hold("275 bones without an end: as long as the bone they go on from"));
        }
    }
    const Splines a = imported(*fbx, "p.fbx").splines, b = imported(*glb, "p.glb").splines;
    REQUIRE(a.points() == b.points());
    double apart = 0;
    for (std::size_t k = 0; k < a.points(); ++k) {
        double least = 1e300;
        for (std::size_t j = 0; j < b.points(); ++j) least = std::min(least, (a.point[k] - b.point[j]).norm());
        apart = std::max(apart, least);
    }
    CHECK(apart < 1e-4);
}

// 158 bones (Blender writes one more for glTF that moves the unweighted vertices); the mesh's largest y in the glTF is
// 17.311044 m, as `max` of its POSITION says. The armature with end bones tells where all 30 tips are.
TEST_CASE("skinned armatures: one tree as FBX, glb, gltf, COLLADA, with and without ends") {
    const std::map<std::string, bool> files{{"sapling_quaking_aspen_s0_skin.fbx", true},
                                            {"sapling_quaking_aspen_s0_skin.glb", true},
                                            {"sapling_quaking_aspen_s0_skin.gltf", true},
                                            {"sapling_quaking_aspen_s0_skin.dae", false},
                                            {"sapling_quaking_aspen_s0_armleaf.armonly.fbx", false}};
    for (const auto& [file, meshed] : files) {
        const auto content = foreign_case("sapling/" + file);
        if (!content) return;
        const Imported in = imported(*content, file, beside_cases());
        INFO(file);
        CHECK(segments(in.splines) == 158);
        CHECK(in.splines.branches() == 30);
        CHECK(total_length(in.splines) == Approx(116.7656).epsilon(1e-4));
        CHECK(top_of(in.splines) == Approx(17.311).epsilon(1e-4));
        CHECK(in.notes_hold(" of 158 bones measured") == meshed);
        CHECK(in.notes_hold("without an end: they reach") == meshed);
        CHECK_FALSE(in.notes_hold("as long as the bone"));
    }
}

// The add-on's curve is 0.23766 m thick at the ground; its Skin modifier draws squares of twice that.
TEST_CASE("Sapling's skinned trunk is as thick as its curve") {
    for (const char* file : {"sapling_quaking_aspen_s0_skin.fbx", "sapling_quaking_aspen_s0_skin.glb"})
        if (const auto content = foreign_case(std::string("sapling/") + file)) {
            const Imported in = imported(*content, file, beside_cases());
            CHECK(in.splines.radius[0] == Approx(0.23766).epsilon(0.01));
            CHECK(in.notes_hold("Skin modifier"));
        }
}

// The armature of the pine without a mesh; its curves say 0.0986 m.
TEST_CASE("a trunk of unknown thickness is guessed as trees are") {
    for (const char* file : {"sapling_small_pine_s0_arm.armonly.glb", "sapling_small_pine_s0_arm.armonly.fbx"})
        if (const auto content = foreign_case(std::string("sapling/") + file)) {
            const Imported in = imported(*content, file);
            const double slenderness = top_of(in.splines) / (2 * in.splines.radius[0]);
            CHECK((slenderness > 20 && slenderness < 45));
            CHECK(in.notes_hold("m thick at the base by the tree's size"));
        }
}

TEST_CASE("models that are no trees are read as their bones are") {
    if (const auto skin = foreign_case("models/simple_skin.gltf")) {
        // Two joints at (0, 1, 0); the upper one moves the vertices up to y = 2 most.
        const Splines s = imported(*skin, "skin.gltf").splines;
        CHECK(segments(s) == 1);
        CHECK(near(s.point[0], {0, 1, 0}, 1e-6));
        CHECK(top_of(s) == Approx(2));
    }
    if (const auto fbx = foreign_case("models/animation_with_skeleton.fbx"))
        CHECK(segments(imported(*fbx, "a.fbx").splines) == 14); // the bones that assimp counts
}
