// formats/imports/mesh_measure.h: a twig's mesh as what a twig weighs and how much air it meets.
#include "formats/imports/mesh_measure.h"
#include "lib/growth/segment.h"
#include "tests/support/import_support.h"
#include "tests/support/speedtree_sample.h"

using namespace bough;
using namespace bough::test;

TEST_CASE("A twig is a twig") {
    const Imported found = imported(speedtree_sample::file({}, "", speedtree_sample::references(1)), "t.xml");
    CHECK(found.notes_hold("2 leaves are twigs by their meshes"));
    // Six squares of 0.1 m, a stalk of three rectangles that is open at its ends; the second at half the size.
    const double stalk = 3 * 0.01 * std::sqrt(3.0), area = 0.06 + stalk;
    CHECK(found.splines.leaf_length[0] * found.splines.leaf_width[0] / 2 == Approx(area));
    CHECK(found.splines.leaf_length[1] * found.splines.leaf_width[1] / 2 == Approx(area / 4));
    CHECK(found.splines.leaf_count == std::vector<std::int32_t>{7, 7});
    const Tree tree = segment(found.splines, wood_presets().front(), {});
    const std::size_t first = tree.size_bodies() - 2;
    REQUIRE(is_clump(tree, first));
    const Material& wood = wood_presets().front();
    CHECK(tree.mass[first] == Approx(area * wood.leaf_thickness * wood.leaf_density));
    // A closed box counts one side of its sheets.
    const std::vector<Vec3> box{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    std::vector<std::array<std::int32_t, 3>> faces;
    for (const auto& q :
         {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {0, 4, 7, 3}}) {
        faces.push_back({q[0], q[1], q[2]});
        faces.push_back({q[0], q[2], q[3]});
    }
    CHECK(measured(box, faces).area == Approx(3));
    CHECK(measured(box, faces).pieces == 1);
    faces.pop_back();
    CHECK(measured(box, faces).area == Approx(5.5));
}
