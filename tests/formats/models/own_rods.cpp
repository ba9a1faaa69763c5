#include "formats/exports/gltf.h"
#include "lib/growth/segment.h"
#include "lib/model/wood.h"
#include "tests/support/import_support.h"
#include <filesystem>
#include <unistd.h>

using namespace bough;
using namespace bough::test;

namespace {

// A trunk that bends, with a bough beside its axis, a twig on that, a leaf and an apple.
Splines orchard_tree() {
    Splines s;
    s.parent = {-1, 0, 1, 0};
    s.parent_at = {0, 0.6, 0.639, 1};
    s.level = {0, 1, 2, 1};
    s.point = {{0, 0, 0},     {0, 1, 0},       {0.2, 2, 0.1}, {0.1, 1.2, 0}, {0.8, 1.6, 0.1},
               {1.4, 1.7, 0}, {0.9, 1.62, .1}, {1, 1.9, 0.3}, {0.2, 2, 0.1}, {0.1, 2.6, 0.2}};
    s.first_point = {0, 3, 6, 8, 10};
    s.radius = {0.1, 0.08, 0.05, 0.03, 0.02, 0.01, 0.008, 0.004, 0.05, 0.01};
    s.leaf_branch = {2, 3};
    s.leaf_at = {1, 0.5};
    s.leaf_position = {{1, 1.9, 0.3}, {0.15, 2.3, 0.15}};
    s.leaf_rotation = {Quat::Identity(), Quat::Identity()};
    s.leaf_length = {0.1, 0.1};
    s.leaf_width = {0.05, 0.05};
    s.fruit_branch = {1};
    s.fruit_at = {1};
    s.fruit_position = {{1.4, 1.7, 0}};
    s.fruit_center = {{1.4, 1.6, 0}};
    s.fruit_radius = {0.04};
    REQUIRE_FALSE(check(s));
    return s;
}

std::string glb_of_tree(const Tree& tree, std::size_t joints, bool instances, bool x_along) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bough_own_rods_" + std::to_string(getpid()) + ".glb")).string();
    const JointGroups groups = merge_joints(tree, joints, !instances);
    const Skin skin = build_skin(tree, {8, !instances});
    GltfOptions options;
    options.leaf_instances = instances;
    options.x_along = x_along;
    Output output(path);
    GltfWriter writer(output, skin, tree, groups, options);
    writer.finish();
    output.finish();
    const std::string content = content_of(path);
    std::filesystem::remove(path);
    return content;
}

double length_of(const Splines& s, std::size_t b) {
    double length = 0;
    for (auto k = std::size_t(s.first_point[b]); k + 1 < std::size_t(s.first_point[b + 1]); ++k)
        length += (s.point[k + 1] - s.point[k]).norm();
    return length;
}

} // namespace

TEST_CASE("our own .glb is read as the tree it shows, whatever joints were merged, with leaves and fruit in it") {
    const Splines drawn = orchard_tree();
    const Tree tree = segment(drawn, wood_presets().front(), {});
    for (const std::size_t joints : {std::size_t(1000), std::size_t(6), std::size_t(1)})
        for (const bool instances : {false, true})
            for (const bool x_along : {false, true}) {
                CAPTURE(joints, instances, x_along);
                const Imported back = imported(glb_of_tree(tree, joints, instances, x_along), "own.glb");
                CHECK(back.notes_hold("3 leaves, petals and fruit left out"));
                CHECK(back.notes.lines.size() == 1);
                CHECK(back.notes.up_from == "stated");
                REQUIRE(back.splines.parent == drawn.parent);
                for (std::size_t b = 0; b < drawn.branches(); ++b) {
                    CAPTURE(b);
                    const auto first = std::size_t(drawn.first_point[b]),
                               last = std::size_t(drawn.first_point[b + 1] - 1);
                    const auto own_first = std::size_t(back.splines.first_point[b]),
                               own_last = std::size_t(back.splines.first_point[b + 1] - 1);
                    CHECK((back.splines.point[own_first] - drawn.point[first]).norm() < 2e-6);
                    CHECK((back.splines.point[own_last] - drawn.point[last]).norm() < 2e-6);
                    CHECK(back.splines.radius[own_first] == Approx(drawn.radius[first]).epsilon(1e-5));
                    CHECK(back.splines.radius[own_last] == Approx(drawn.radius[last]).epsilon(1e-5));
                    CHECK(length_of(back.splines, b) == Approx(length_of(drawn, b)).epsilon(0.02)); // chords
                    CHECK(back.splines.parent_at[b] == Approx(drawn.parent_at[b]).margin(0.02));
                }
            }
}

TEST_CASE("extras that are not as we write them are passed over: the joints are then bones") {
    std::string content = glb_of_tree(segment(orchard_tree(), wood_presets().front(), {}), 1000, false, false);
    const std::size_t at = content.find("bough_wood\":[0,-1");
    REQUIRE(at != std::string::npos);
    content.replace(at, 17, "bough_wood\":[0.5 ");
    const Imported back = imported(content, "own.glb");
    CHECK(back.notes_hold("bones measured on the mesh"));
}
