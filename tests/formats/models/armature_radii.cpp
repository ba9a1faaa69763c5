// Radii of bones by the mesh that they move.
#include "formats/models/armature.h"
#include "tests/support/import_support.h"
#include "tests/support/tubes.h"

using namespace bough;
using namespace bough::test;

// The fixture's armature stands at x = 3; both matrices say so. A square tube with corners 0.1 off bones from y = 0 to 2.
TEST_CASE("a skin whose bind matrices are not its nodes' is measured where its mesh stands, or not at all") {
    const std::string good = fixture("moved_armature.dae");
    const std::string scaled =
        replaced(replaced(good, "<node id=\"rig\" type=\"NODE\">",
                          "<node id=\"empty\" type=\"NODE\"><scale>10 10 10</scale><node id=\"rig\" type=\"NODE\">"),
                 "</visual_scene>", "</node></visual_scene>");
    const auto with = [](const std::string& file, const std::string& bind, const std::string& inverse) {
        std::string text =
            replaced(file, "<bind_shape_matrix>1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1", "<bind_shape_matrix>" + bind);
        if (inverse.empty()) return text;
        text = replaced(text, "1 0 0 -3 0 1 0 0 0 0 1 0 0 0 0 1", inverse);
        return replaced(text, "1 0 0 -3 0 1 0 -1 0 0 1 0 0 0 0 1", "1 0 0 0 0 1 0 -1 0 0 1 0 0 0 0 1");
    };
    const std::string one = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", ten = "10 0 0 30 0 10 0 0 0 0 10 0 0 0 0 1";
    struct Case {
        std::string file;
        double radius;
        bool elsewhere;
    };
    const Case cases[] = {{good, 0.1, false},
                          {with(good, one, one), 0.1, false}, // bound before it was moved
                          {with(good, one, ""), 0.1, true},   // the mesh is bound as if it stood at the origin
                          {replaced(good, "<bind_shape_matrix>1 0 0 3", "<bind_shape_matrix>1 0 0 6"), 0.1, true},
                          {with(scaled, one, one), 1, false}, // all within what scales it
                          {with(scaled, ten, one), 1, true},  // scaled twice
                          {with(scaled, one, ""), 1, true}};  // not at all
    for (const Case& c : cases) {
        INFO(&c - cases);
        const Imported in = imported(c.file, "m.dae");
        for (const double r : in.splines.radius) CHECK(r == Approx(c.radius * std::sqrt(0.5)));
        CHECK(in.notes_hold("measured where the mesh's own node stands") == c.elsewhere);
        CHECK(in.notes_hold("radii of 2 of 2 bones measured"));
    }
    // Where the node would put it beside the bones as well, nothing is measured.
    const std::string beside =
        replaced(with(good, "1 0 0 40 0 1 0 0 0 0 1 0 0 0 0 1", ""), "<node id=\"mesh\" type=\"NODE\">",
                 "<node id=\"mesh\" type=\"NODE\"><translate>40 0 0</translate>");
    const Imported in = imported(beside, "m.dae");
    CHECK(in.notes_hold("times the armature's size beside its bones: radii are not measured on it"));
    CHECK(in.notes_hold("by the pipe rule"));
    for (const double r : in.splines.radius) CHECK(r < 0.05);
}

// A stem of four bones of 1.5 m, the last without a stated end, whose twigs of 2 m have no bones and so move with the stem's.
TEST_CASE("twigs without bones of their own make no stem thicker and no tip longer") {
    const std::vector<Vec3> axis{{0, 0, 0}, {0, 1.5, 0}, {0, 3, 0}, {0, 4.5, 0}, {0, 5.2, 0}};
    const std::vector<double> radius{0.06, 0.05, 0.04, 0.03, 0.02};
    const auto scene_of = [&](bool twigs, bool thick) {
        ModelScene scene;
        for (std::int32_t k = 0; k < 4; ++k) {
            scene.parent.push_back(k - 1);
            scene.role.push_back(NodeRole::joint);
            scene.name.push_back("bone." + std::to_string(k));
            scene.place.push_back(axis[std::size_t(k)]);
            scene.axes.push_back(Mat3::Identity());
            scene.tip.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        }
        BarkSurface mesh;
        add_tube(mesh, axis, radius, {0, 1, 2, 3}, 8);
        for (std::int32_t b = 0; twigs && b < 4; ++b)
            for (int k = 0; k < 20; ++k) {
                const Vec3 base = axis[std::size_t(b)] + 0.05 * k * (axis[std::size_t(b) + 1] - axis[std::size_t(b)]);
                const Vec3 out(std::cos(2.4 * k), 1, std::sin(2.4 * k));
                add_tube(mesh, {base, base + 0.7 * out, base + 1.4 * out}, {0.015, 0.01, 0.005}, {b}, 6);
            }
        if (thick) add_tube(mesh, {{3, 3.1, 0}, {3, 4.4, 0}}, {0.2, 0.2}, {2}, 8); // far from the bone, no twig
        scene.vertex = mesh.point;
        scene.face = mesh.triangle;
        scene.vertex_node = mesh.bone;
        return scene;
    };
    for (const bool twigs : {false, true})
        for (const bool thick : {false, true}) {
            ImportNotes notes;
            const Armature armature = armature_of(scene_of(twigs, thick), Vec3::UnitY(), notes);
            REQUIRE(armature.bones.size() == 4);
            for (std::size_t b = 0; b < 4; ++b) CHECK(armature.bones[b].radius == Approx(radius[b]).epsilon(0.01));
            CHECK(armature.bones[3].tip == Approx(radius[4]).epsilon(0.01));
            CHECK(near(armature.bones[3].end, axis[4], 1e-6));
            CHECK(armature.twigs.size() == std::size_t(twigs ? 80 : 0));
            // Their wood is in the tree: of the twigs as much as their frusta hold.
            ImportNotes none;
            double wood = 0, twigs_wood = 0;
            const ImportedTree tree = tree_of(armature, none);
            for (std::size_t b = 0; b < tree.branches.size(); ++b) {
                const ImportedBranch& branch = tree.branches[b];
                CHECK((branch.parent >= 0) == (b > 0));
                for (std::size_t k = 1; k < branch.point.size(); ++k) {
                    const double r = branch.radius[k - 1], q = branch.radius[k];
                    (b == 0 ? wood : twigs_wood) +=
                        (r * r + r * q + q * q) * (branch.point[k] - branch.point[k - 1]).norm();
                }
            }
            const auto frusta = [](double r, double q, double length) { return (r * r + r * q + q * q) * length; };
            if (twigs && !thick)
                CHECK(twigs_wood == Approx(80 * (frusta(0.015, 0.01, 0.7 * std::sqrt(2.0)) +
                                                 frusta(0.01, 0.005, 0.7 * std::sqrt(2.0))))
                                        .epsilon(0.2));
            for (const std::string& line : notes.lines) CHECK(line.find("twice as thick") == std::string::npos);
        }
    ModelScene swollen = scene_of(true, false);
    for (Vec3& p : swollen.vertex)
        if (p.y() > 2.99) p.x() *= 3, p.z() *= 3;
    ImportNotes notes;
    armature_of(swollen, Vec3::UnitY(), notes);
    CHECK(std::any_of(notes.lines.begin(), notes.lines.end(), [](const std::string& line) {
        return line.find("the bark of 1 bone is more than twice as thick as that of the bone before (\"bone.2\"") == 0;
    }));
}
