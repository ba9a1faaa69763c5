#include "formats/imports/imported_tree.h"
#include "formats/imports/speedtree_bark.h"
#include "tests/support/import_support.h"
#include "tests/support/tubes.h"
#include <algorithm>
#include <map>

using namespace bough;
using namespace bough::test;

TEST_CASE("spines of two trunks in centimetres: local points, radii in another scale, decimal commas, BOM") {
    const Imported in = imported(fixture("two_trunks_spines.xml"), "two_trunks_spines.xml");
    const Splines& s = in.splines;
    CHECK(s.name == "Pair");
    CHECK(s.source == "SpeedTree raw XML 10.0 two_trunks_spines.xml (pair.spm)");
    REQUIRE(s.branches() == 3); // the branch stands before its trunk in the file
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, -1});
    CHECK(s.level == std::vector<std::int32_t>{0, 1, 0});
    CHECK(s.first_point == std::vector<std::int32_t>{0, 4, 7, 9});
    CHECK(near(s.point[0], {0.2, 0, 0.1}));
    CHECK(near(s.point[3], {0.2, 4, 0.1}));
    CHECK(near(s.point[7], {-1, 0, 0}));
    // The joint stays 10 cm off the trunk's axis, 150 cm up its 400.
    CHECK(near(s.point[4], {0.3, 1.5, 0.1}));
    CHECK(s.parent_at[1] == Approx(0.375));
    const std::vector<double> radius{0.1, 0.08, 0.05, 0.02, 0.03, 0.02, 0.01, 0.06, 0.03};
    for (std::size_t k = 0; k < radius.size(); ++k) CHECK(s.radius[k] == Approx(radius[k]));
    CHECK(in.notes_hold("multiplied by 100"));
    CHECK(in.notes_hold("taken as cm, because the tree is 400 units high"));
    CHECK(in.notes_hold("taken as Z"));
}

TEST_CASE("leaf references: absolute positions, degrees, Scale times the mesh's bounds") {
    const Splines s = imported(fixture("two_trunks_spines.xml"), "two_trunks_spines.xml").splines;
    REQUIRE(s.leaves() == 2);
    CHECK(s.leaf_branch == std::vector<std::int32_t>{1, 2});
    // 50 of 50 + 50 sqrt(2) along the branch; 240 of 250 up the second trunk, found without a bone.
    CHECK(s.leaf_at[0] == Approx(1 / (1 + std::sqrt(2.0))));
    CHECK(s.leaf_at[1] == Approx(0.96));
    CHECK(near(s.leaf_position[0], {0.8, 1.5, 0.1}));
    CHECK(near(s.leaf_position[1], {-1, 2.4, -0.05}));
    CHECK(s.leaf_length[0] == Approx(0.12));
    CHECK(s.leaf_width[0] == Approx(0.06));
    CHECK(s.leaf_length[1] == Approx(0.06));
    // 90 degrees about the file's z turn the mesh's y to -x; its thin z stays up. Not turned, y is -z in Y up.
    CHECK(near(s.leaf_rotation[0] * Vec3::UnitZ(), {-1, 0, 0}));
    CHECK(near(s.leaf_rotation[0] * Vec3::UnitY(), {0, 1, 0}));
    CHECK(near(s.leaf_rotation[1] * Vec3::UnitZ(), {0, 0, -1}));
    CHECK(near(s.leaf_rotation[1] * Vec3::UnitY(), {0, 1, 0}));
}

TEST_CASE("options override what a file states or leaves open") {
    ImportOptions options;
    options.unit = 0.5;
    options.up = 'y';
    const Imported spines = imported(fixture("two_trunks_spines.xml"), "a.xml", options);
    CHECK(near(spines.splines.point[0], {10, -5, 0}));
    CHECK(spines.splines.radius[0] == Approx(5));
    CHECK_FALSE(spines.notes_hold("--units"));
    options.up = 'z';
    CHECK(near(imported(fixture("forked_bones.xml"), "b.xml", options).splines.point[1], {0, 0, -5}));
}

TEST_CASE("without bones the bark measures the spine's radii, without both they are metres") {
    const std::string bark = fixture("spines_and_bark.xml");
    const Imported measured = imported(bark, "bark.xml");
    CHECK(measured.splines.radius[0] == Approx(0.2));
    CHECK(measured.notes_hold("bark points over spine radius is 100"));
    const Imported bare = imported(replaced(replaced(bark, "<Points", "<Dots"), "</Points", "</Dots"), "bare.xml");
    CHECK(bare.splines.radius[0] == Approx(0.2));
    CHECK(bare.notes_hold("taken as metres"));
}

TEST_CASE("radii are scaled by the nearest known conversion also where bones are thinner than spines") {
    std::string thin = fixture("two_trunks_spines.xml");
    for (const auto& [from, to] : std::map<std::string, std::string>{{"Radius=\"3\"", "Radius=\"2.52\""},
                                                                     {"Radius=\"2\"", "Radius=\"1.68\""},
                                                                     {"Radius=\"6\"", "Radius=\"5.04\""}})
        thin = replaced(thin, from, to);
    CHECK(imported(thin, "thin.xml").splines.radius[0] == Approx(0.1));
}

TEST_CASE("bones alone are grouped into branches") {
    const Imported in = imported(fixture("forked_bones.xml"), "forked_bones.xml");
    const Splines& s = in.splines;
    constexpr double ft = 0.3048;
    REQUIRE(s.branches() == 5);
    // In file order: the trunk, its crooked continuation, the two twigs (parents first), the second trunk.
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0, 0, 0, -1});
    CHECK(s.first_point == std::vector<std::int32_t>{0, 4, 6, 8, 10, 12});
    CHECK(s.parent_at[1] == Approx(1.0 / 3)); // of two that go on, the straight one is the trunk
    CHECK(s.parent_at[2] == Approx(0.5));     // 15 of 30, half a foot off the axis
    CHECK(s.parent_at[3] == Approx(2.0 / 3)); // begins at a bone's end but has another Generator
    CHECK(near(s.point[6], ft * Vec3(0.5, 15, 0)));
    CHECK(near(s.point[3], ft * Vec3(0, 30, 0)));
    // Radius is at each bone's start; the tip's goes on with the taper 0.8 to 0.4, down to a tenth of the last.
    for (const auto& [k, radius] : std::map<int, double>{{0, 1}, {1, 0.8}, {2, 0.4}, {3, 0.04}, {4, 0.5}, {5, 0.5}})
        CHECK(s.radius[k] == Approx(ft * radius));
    REQUIRE(s.leaves() == 1);
    CHECK(s.leaf_branch[0] == 2);
    CHECK(s.leaf_at[0] == Approx(4.5 / 9.5));
    CHECK(s.leaf_length[0] == Approx(0.5 * ft));
    CHECK(s.leaf_width[0] == Approx(0.25 * ft));
    CHECK(in.notes_hold("1 leaf without a mesh"));
    CHECK(in.notes.lines.size() == 1); // unit and up axis are stated
}

TEST_CASE("bones with neither end nor radius get both") {
    const Imported in = imported(fixture("bare_bones.xml"), "bare_bones.xml");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 2);
    CHECK(near(s.point[s.first_point[1] - 1], {0, 3, 0})); // the tip is as long as the step from its parent
    CHECK(near(s.point[s.first_point[1]], {0.05, 1.5, 0}));
    CHECK(near(s.point.back(), {0.1, 2, 0}));
    CHECK(s.parent_at[1] == Approx(0.5));
    // 300 cm high: a 34th thick at the ground; wood beyond: 300 + side, 200 + side, 100, side.
    const double side = std::sqrt(25.0 + 2500.0);
    const double base = 3 / 68.0;
    CHECK(s.radius[0] == Approx(base));
    CHECK(s.radius[1] == Approx(base * std::sqrt((200 + side) / (300 + side))));
    CHECK(s.radius[2] == Approx(base * std::sqrt(100 / (300 + side))));
    CHECK(s.radius[s.first_point[1]] == Approx(base * std::sqrt(side / (300 + side))));
    CHECK(in.notes_hold("0.08824 m thick at the base"));
    // As thick as the user says, all of it alike; so are radii that a file states.
    ImportOptions thick;
    thick.trunk_diameter = 0.2;
    const Imported said = imported(fixture("bare_bones.xml"), "bare_bones.xml", thick);
    for (std::size_t k = 0; k < s.points(); ++k) CHECK(said.splines.radius[k] == Approx(s.radius[k] * 0.1 / base));
    CHECK_FALSE(said.notes_hold("thick at the base"));
    const Imported stated = imported(fixture("forked_bones.xml"), "f.xml"),
                   scaled = imported(fixture("forked_bones.xml"), "f.xml", thick);
    CHECK(scaled.notes_hold("radii multiplied by"));
    double most = 0;
    for (std::size_t b = 0; b < stated.splines.branches(); ++b)
        if (stated.splines.parent[b] < 0) most = std::max(most, stated.splines.radius[stated.splines.first_point[b]]);
    for (std::size_t k = 0; k < scaled.splines.points(); ++k)
        CHECK(scaled.splines.radius[k] == Approx(stated.splines.radius[k] * 0.1 / most));
    CHECK(in.notes_hold("4 bones without End"));
    CHECK(in.notes_hold("4 bones without Radius"));
}

TEST_CASE("a branch without length is left out and what it carries moves to its parent") {
    const std::string flat = replaced(fixture("two_trunks_spines.xml"), "<X>0. 50. 100. </X>", "<X>0. 0. 0. </X>");
    const Imported in = imported(replaced(flat, "<Z>0. 0. 5e+001 </Z>", "<Z>0. 0. 0. </Z>"), "flat.xml");
    REQUIRE(in.splines.branches() == 2);
    CHECK(in.splines.leaf_branch == std::vector<std::int32_t>{0, 1});
    CHECK(in.splines.leaf_at[0] == Approx(0.375));
    CHECK(in.notes_hold("1 branch without length"));
}

TEST_CASE("a leaf of Scale 0 is left out, spines without radii have those of their bones") {
    const std::string good = fixture("two_trunks_spines.xml");
    const Imported bare = imported(replaced(good, "<Scale>12. </Scale>", "<Scale>0 </Scale>"), "s.xml");
    CHECK(bare.splines.leaves() == 1);
    CHECK(bare.notes_hold("1 leaf of Scale 0 left out"));
    std::string thin = good;
    for (int spine = 0; spine < 3; ++spine)
        thin = replaced(replaced(thin, "<Radius>", "<Girth>"), "</Radius>", "</Girth>");
    const Imported filled = imported(thin, "s.xml");
    CHECK(filled.notes_hold("points of spines without radii given the Radius of their bones"));
    CHECK_FALSE(filled.notes_hold("multiplied"));
    CHECK(filled.splines.radius[7] == Approx(0.06)); // the second trunk's bone has Radius 6, in cm
    for (const double r : filled.splines.radius) CHECK(r > 0);
}

TEST_CASE("units and axes in the words that exporters use") {
    const std::string good = fixture("forked_bones.xml");
    for (const auto& [word, metres] :
         std::map<std::string, double>{{"Feet", 0.3048}, {"inches", 0.0254}, {"Meter", 1}, {"CM", 0.01}})
        CHECK(imported(replaced(good, "units=\"ft\"", "units=\"" + word + "\""), "u.xml").splines.point[3].y() ==
              Approx(30 * metres));
    for (const char* word : {"y", "Y-Up", "+Y", "y_up"})
        CHECK(imported(replaced(good, "upAxis=\"Y\"", "upAxis=\"" + std::string(word) + "\""), "u.xml")
                  .splines.point[3]
                  .y() == Approx(30 * 0.3048));
}

TEST_CASE("wrong SpeedTree files are refused with their line") {
    const std::string good = fixture("two_trunks_spines.xml"), bones = fixture("forked_bones.xml");
    const auto error = [&](const std::string& from, const std::string& to) {
        return error_of(replaced(good, from, to), "s.xml");
    };
    CHECK(error("<Z>0. 0. 5e+001 </Z>", "<Z>0. 0. 5e+001x </Z>") ==
          "s.xml:21: <Spine> Z holds \"5e+001x\", expected finite numbers");
    CHECK(error("3e-002 0,02", "3e-002 0,0,2").find("s.xml:22: <Spine> Radius holds \"0,0,2\"") == 0);
    CHECK(error("3e-002 0,02", "-3e-002 0,02").find("s.xml:18: <Spine> Radius holds -0.03") == 0);
    CHECK(error("<X>0. 50. 100. </X>", "<X>0. 50. nan </X>").find("\"nan\"") != std::string::npos);
    CHECK(error("<X>0. 50. 100. </X>", "<X>0. 50. 1e999 </X>").find("\"1e999\"") != std::string::npos);
    CHECK(error("<X>0. 50. 100. </X>", "<X>0. 50. </X>").find("s.xml:18: <Spine> Y holds 3 values, expected 2") == 0);
    CHECK(error("<Spine Count=\"3\">", "<Spine Count=\"4\">").find("s.xml:18: <Spine> says Count 4 but holds 3") == 0);
    CHECK(error("ID=\"3\" ParentID=\"1\"", "ID=\"3\" ParentID=\"11\"")
              .find("s.xml:17: <Object> ParentID 11 does not exist") == 0);
    CHECK(error("ID=\"3\" ParentID=\"1\"", "ID=\"2\" ParentID=\"1\"").find("ID 2 is used twice") != std::string::npos);
    CHECK(error("ID=\"1\" ParentID=\"0\"", "ID=\"1\" ParentID=\"3\"").find("is its own ancestor") != std::string::npos);
    CHECK(error("<BoneID>3 </BoneID>", "<BoneID>99 </BoneID>") ==
          "s.xml:44: <LeafReferences> BoneID 99 does not exist, expected the ID of a Bone or -1");
    CHECK(error("<Scale>12. </Scale>", "<Scale>-1 </Scale>").find("Scale holds -1") != std::string::npos);
    CHECK(error("<Scale>12. </Scale>", "").find("Scale holds 0 values, expected 1") != std::string::npos);
    CHECK(error("<RotAxisZ>1. </RotAxisZ>", "<RotAxisZ>0 </RotAxisZ>").find("axis of no length") != std::string::npos);
    CHECK(error("Radius=\"8,4\"", "Radius=\"8,4.\"").find("s.xml:61: <Bone> Radius is \"8,4.\"") == 0);
    CHECK(error("</Objects>", "</Object>").find("s.xml:59: XML is broken") == 0);
    CHECK(error_of(replaced(bones, "units=\"ft\"", "units=\"cubit\""), "b.xml")
              .find("b.xml:2: <SpeedTreeRaw> units is \"cubit\"") == 0);
    CHECK(error_of(replaced(bones, "upAxis=\"Y\"", "upAxis=\"X\""), "b.xml").find("upAxis is \"X\"") !=
          std::string::npos);
    CHECK(error_of(replaced(bones, " StartY=\"10\"", ""), "b.xml").find("b.xml:15: <Bone> has no StartY") == 0);
    CHECK(error_of(replaced(bones, "ID=\"14\" ParentID=\"11\"", "ID=\"14\" ParentID=\"14\""), "b.xml")
              .find("b.xml:18: <Bone> is its own ancestor") == 0);
    CHECK(error_of("<SpeedTreeRaw><Objects/></SpeedTreeRaw>", "s.xml").find("Raw XML with spines or bones") !=
          std::string::npos);
}

TEST_CASE("files that hold no skeleton are refused with what to do instead") {
    const auto says = [](const std::string& content, const std::string& name, const std::string& text) {
        INFO(name);
        CHECK(error_of(content, name).find(text) != std::string::npos);
    };
    const std::string binary("\0\1\2", 3);
    says("", "a.xml", "is empty");
    says(" \n\t", "a.xml", "is blank");
    for (const char* name : {"oak.srt", "oak.SPM", "oak.st", "oak.st9"})
        says(binary, name, "export it from SpeedTree as Raw XML");
    says("SRT 07.0.0", "oak", "export it from SpeedTree as Raw XML");
    says("Ogawa" + binary, "oak.abc", "Alembic");
    says("PXR-USDC" + binary, "oak.usd", "USD");
    says("#usda 1.0\n", "oak.usda", "USD");
    says("<Trees/>", "a.xml", "neither SpeedTree raw XML");
    says("<?xml version='1.0'?><arbaro/>", "a.xml", "Arbaro");
    says("{\"format\": \"bough-tree\", \"version\": 1}", "oak.tree.json", "\"bough-tree\"");
    says("once upon a time", "a.txt", "unknown format");
    says(binary, "a", "binary");
}

TEST_CASE("damaged SpeedTree files are read or refused in one line") {
    damage(fixture("two_trunks_spines.xml"), "damaged.xml", 3);
    damage(fixture("forked_bones.xml"), "damaged.xml", 1);
    damage(fixture("bare_bones.xml"), "damaged.xml", 1);
}

TEST_CASE("a chain of 4e4 bones is grouped without recursion") {
    std::string text = "<SpeedTreeRaw units=\"m\" upAxis=\"Y\"><Bones>";
    for (int i = 40000; i-- > 0;)
        text += "<Bone ID=\"" + std::to_string(i) + "\" ParentID=\"" + std::to_string(i - 1) +
                "\" Radius=\"0.1\" StartX=\"0\" StartY=\"" + std::to_string(i) +
                "e-3\" StartZ=\"0\" EndX=\"0\" EndY=\"" + std::to_string(i + 1) + "e-3\" EndZ=\"0\"/>";
    const Splines s = imported(text + "</Bones></SpeedTreeRaw>", "deep.xml").splines;
    CHECK(s.branches() == 1);
    CHECK(s.points() == 40001);
    CHECK(top_of(s) == Approx(40));
}

TEST_CASE("very many spines that begin at one place are found by their bones") {
    constexpr int count = 30000; // each looked at by each would be a quarter of a minute
    std::string objects =
        "<Object ID=\"0\"><Spine><X>0 0</X><Y>0 0</Y><Z>0 10</Z><Radius>1 1</Radius></Spine></Object>";
    std::string bones = "<Bone ID=\"0\" ParentID=\"-1\" Radius=\"1\" StartX=\"0\" StartY=\"0\" StartZ=\"0\" EndX=\"0\" "
                        "EndY=\"0\" EndZ=\"10\"/>";
    for (int i = 1; i <= count; ++i) {
        const std::string id = std::to_string(i);
        objects += "<Object ID=\"" + id + "\" ParentID=\"0\"><Spine><X>0 1</X><Y>0 0</Y><Z>5 5</Z><Radius>.1 " +
                   ".1</Radius></Spine></Object>";
        bones += "<Bone ID=\"" + id + "\" ParentID=\"0\" Radius=\".1\" StartX=\"0\" StartY=\"0\" StartZ=\"5.000001\" " +
                 "EndX=\"1\" EndY=\"0\" EndZ=\"5\"/>";
    }
    const Imported in = imported(
        "<SpeedTreeRaw><Objects>" + objects + "</Objects><Bones>" + bones + "</Bones></SpeedTreeRaw>", "fan.xml");
    CHECK(in.splines.branches() == count + 1);
}

TEST_CASE(
    "spines without radii have those of the bones that begin nearest to them, as a search through all finds them") {
    // Spines side by side that fill a wide, deep and low space, many of them at one place or in one plane; each has a bone, which
    // begins a little off and says a thickness of its own.
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    constexpr int count = 400;
    std::vector<Vec3> start;
    std::string objects, bones;
    std::vector<Vec3> bone_start;
    const auto number = [](double v) { return std::to_string(v); }; // of six places, which are read back
    const auto rounded = [&](double v) { return std::stod(number(v)); };
    for (int i = 0; i < count; ++i) {
        Vec3 p(rounded(9 * unit(random)), rounded(5 * unit(random)), rounded(2 * unit(random)));
        if (i % 4 == 1) p.x() = 3;
        if (i % 4 == 2) p = start[random() % start.size()];
        start.push_back(p);
        bone_start.emplace_back(rounded(p.x() + 0.3 * unit(random)), rounded(p.y()),
                                rounded(p.z() + 0.3 * unit(random)));
        const Vec3& b = bone_start.back();
        objects += "<Object ID=\"" + std::to_string(i) + "\" AbsX=\"" + number(p.x()) + "\" AbsY=\"" + number(p.y()) +
                   "\" AbsZ=\"" + number(p.z()) + "\"><Spine><X>0 0</X><Y>0 0</Y><Z>0 1</Z></Spine></Object>";
        bones += "<Bone ID=\"" + std::to_string(i) + "\" ParentID=\"-1\" Radius=\"" + number(0.01 + 0.001 * i) +
                 "\" StartX=\"" + number(b.x()) + "\" StartY=\"" + number(b.y()) + "\" StartZ=\"" + number(b.z()) +
                 "\" EndX=\"" + number(b.x()) + "\" EndY=\"" + number(b.y()) + "\" EndZ=\"" + number(b.z() + 1) +
                 "\"/>";
    }
    ImportOptions options;
    options.unit = 1;
    options.up = 'y';
    const Splines s =
        imported("<SpeedTreeRaw><Objects>" + objects + "</Objects><Bones>" + bones + "</Bones></SpeedTreeRaw>", "x.xml",
                 options)
            .splines;
    REQUIRE(s.branches() == count);
    // Of bones that are nearest to one spine the last one's radius counts.
    std::vector<double> radius(count, 0);
    for (int i = 0; i < count; ++i) {
        int nearest = 0;
        for (int k = 0; k < count; ++k)
            if ((start[k] - bone_start[i]).norm() < (start[nearest] - bone_start[i]).norm()) nearest = k;
        radius[nearest] = 0.01 + 0.001 * i;
    }
    std::size_t told = 0;
    for (int k = 0; k < count; ++k) {
        if (radius[k] == 0) continue; // by the pipe rule
        ++told;
        const std::int32_t first = s.first_point[k];
        CHECK(s.radius[first] == Approx(radius[k]));
    }
    CHECK(told > 200);
}

TEST_CASE("the young maple of data is a tree of three levels with leaves") {
    const Imported in = imported(content_of(std::string(BOUGH_DATA_DIR) + "/young_maple.xml"), "young_maple.xml");
    const Splines& s = in.splines;
    CHECK(*std::max_element(s.level.begin(), s.level.end()) == 2);
    CHECK(s.leaves() >= 60);
    CHECK(s.leaves() <= 110);
    CHECK(top_of(s) > 3.5);
    CHECK(top_of(s) < 5);
    CHECK(s.radius[0] == Approx(0.032));
    CHECK(in.notes_hold("multiplied by 100"));
    // Every leaf sits on its branch.
    for (std::size_t l = 0; l < s.leaves(); ++l) {
        double nearest = 1e9;
        const std::int32_t b = s.leaf_branch[l];
        for (std::int32_t k = s.first_point[b]; k < s.first_point[b + 1]; ++k)
            nearest = std::min(nearest, (s.point[k] - s.leaf_position[l]).norm());
        CHECK(nearest < 0.15);
    }
}

TEST_CASE("bones are as thick as their bark, where that says more than its roughness") {
    // A trunk of four bones with 0.84 of its radius and a flare at its foot, a branch with its own, a branch without any.
    std::vector<speedtree::Bone> bones;
    const auto add = [&](std::int32_t parent, const Vec3& start, const Vec3& end, double radius) {
        speedtree::Bone bone;
        bone.id = 10 + std::int64_t(bones.size()), bone.parent = parent, bone.start = start, bone.end = end;
        bone.has_end = true, bone.radius = radius;
        bone.generator = parent < 0 || start.x() == 0 ? "Trunk" : "Branch";
        bones.push_back(bone);
        return std::int32_t(bones.size()) - 1;
    };
    const std::vector<Vec3> trunk{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}};
    const std::vector<double> radius{0.2, 0.18, 0.16, 0.14, 0.12};
    for (std::int32_t k = 0; k < 4; ++k)
        add(k - 1, trunk[std::size_t(k)], trunk[std::size_t(k) + 1], 0.84 * radius[std::size_t(k)]);
    const std::vector<Vec3> side{{0.1, 0, 2}, {1.1, 0, 2}}, other{{-0.1, 0, 3}, {-1.1, 0, 3}};
    add(1, side[0], side[1], 0.05);
    add(2, other[0], other[1], 0);
    BarkSurface bark;
    std::vector<double> flared = radius;
    flared[0] *= 1.5;
    add_tube(bark, trunk, flared, {0, 1, 2, 3}, 6);
    add_tube(bark, side, {0.051, 0.031}, {4}, 5);
    add_tube(bark, other, {0.04, 0.02}, {5}, 5);
    ImportNotes notes;
    speedtree::take_bark_radii(bark, bones, notes);
    for (std::size_t k = 0; k < 4; ++k) CHECK(bones[k].radius == Approx(radius[k]).epsilon(0.02));
    CHECK(bones[4].radius == 0.05);
    CHECK(bones[5].radius == Approx(0.04).epsilon(1e-3));
    CHECK(bones[5].tip == Approx(0.02).epsilon(1e-3));
    REQUIRE(notes.lines.size() == 2);
    CHECK(notes.lines[0].find("1 branch of 3 multiplied by 1.19") != std::string::npos);
    CHECK(notes.lines[1] == "1 bone without Radius given that of the bark around");

    CHECK_THROWS_WITH(speedtree::parse_bark(fixture("meshed_tree.xml"), "m.xml", {}),
                      Catch::Matchers::Contains("does not exist, expected the ID of a Bone or -1"));
}
