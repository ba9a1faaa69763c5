// Other people's exports of SpeedTree, against each other.
#include "formats/imports/on_polyline.h"
#include "lib/growth/segment.h"
#include "lib/model/wood.h"
#include "lib/study/modes.h"
#include "tests/support/import_support.h"
#include <algorithm>

using namespace bough;
using namespace bough::test;

namespace {

// How far leaves point along the wood that carries them, on average.
double mean_cosine(const Splines& s) {
    double sum = 0;
    for (std::size_t l = 0; l < s.leaves(); ++l) {
        const std::int32_t b = s.leaf_branch[l];
        const double length = branch_length(s, b);
        double arc = 0;
        for (std::int32_t k = s.first_point[b]; k + 1 < s.first_point[b + 1]; ++k) {
            const Vec3 piece = s.point[k + 1] - s.point[k];
            arc += piece.norm();
            if (arc / length < s.leaf_at[l] - 1e-9 && k + 2 < s.first_point[b + 1]) continue;
            sum += piece.normalized().dot(s.leaf_rotation[l] * Vec3::UnitZ());
            break;
        }
    }
    return sum / double(s.leaves());
}

std::int32_t leaf_nearest(const Splines& s, const Vec3& p) {
    std::size_t best = 0;
    for (std::size_t l = 0; l < s.leaves(); ++l)
        if ((s.leaf_position[l] - p).norm() < (s.leaf_position[best] - p).norm()) best = l;
    return std::int32_t(best);
}

} // namespace

TEST_CASE("one tree in centimetres with spines, in metres with bones, merged: the same tree") {
    const auto spines_file = foreign_case("speedtree/SimpleTree_01_spines_cm.xml");
    const auto bones_file = foreign_case("speedtree/SimpleTree_01_groups_m.xml");
    const auto merged_file = foreign_case("speedtree/SimpleTree_03_merged_cm.xml");
    if (!spines_file || !bones_file || !merged_file) return;
    const Splines spines = imported(*spines_file, "spines.xml").splines,
                  bones = imported(*bones_file, "bones.xml").splines,
                  merged = imported(*merged_file, "merged.xml").splines;
    CHECK(spines.points() == 436);
    CHECK(bones.points() == 105 + 23);
    for (const Splines* s : {&spines, &bones, &merged}) {
        CHECK(s->branches() == 23);
        CHECK(s->leaves() == 39);
        CHECK(std::count(s->parent.begin(), s->parent.end(), -1) == 1);
        CHECK(std::count(s->level.begin(), s->level.end(), 1) == 6);
        CHECK(std::count(s->level.begin(), s->level.end(), 2) == 16);
        CHECK(top_of(*s) == Approx(11.6444).margin(1e-3));
        CHECK(s->radius[0] ==
              Approx(0.2).epsilon(0.05)); // bones of the trunk have 0.84 of its radius, the bark has all
        CHECK(total_length(*s) == Approx(total_length(spines)).epsilon(0.03));
    }
    // Branches: same joint, same place on the parent, same tip, same radius at the joint; spines only have more points.
    std::vector<std::int32_t> spine_of_bone_branch;
    for (std::size_t b = 0; b < bones.branches(); ++b) {
        const Vec3 joint = bones.point[bones.first_point[b]];
        std::size_t same = 0;
        for (std::size_t c = 0; c < spines.branches(); ++c)
            if ((spines.point[spines.first_point[c]] - joint).norm() <
                (spines.point[spines.first_point[same]] - joint).norm())
                same = c;
        spine_of_bone_branch.push_back(std::int32_t(same));
        CHECK(near(spines.point[spines.first_point[same]], joint, 1e-4));
        CHECK(near(spines.point[spines.first_point[same + 1] - 1], bones.point[bones.first_point[b + 1] - 1], 1e-4));
        CHECK(spines.parent_at[same] == Approx(bones.parent_at[b]).margin(0.02));
        if (b > 0)
            CHECK(spines.radius[spines.first_point[same]] == Approx(bones.radius[bones.first_point[b]]).epsilon(1e-4));
        if (b > 0)
            CHECK(spines.radius[spines.first_point[same + 1] - 1] ==
                  Approx(bones.radius[bones.first_point[b + 1] - 1]).epsilon(0.35));
        if (bones.parent[b] >= 0) CHECK(spines.parent[same] == spine_of_bone_branch[bones.parent[b]]);
    }
    // All along the wood, and so in how it sways.
    for (std::size_t b = 0; b < bones.branches(); ++b) {
        const auto same = std::size_t(spine_of_bone_branch[b]);
        const std::vector<Vec3> line(spines.point.begin() + spines.first_point[same],
                                     spines.point.begin() + spines.first_point[same + 1]);
        for (std::int32_t k = bones.first_point[b]; k + 1 < bones.first_point[b + 1]; ++k) {
            const OnPolyline at = nearest_on(line, bones.point[k]);
            const double* radius = &spines.radius[std::size_t(spines.first_point[same]) + at.segment];
            CHECK(bones.radius[k] == Approx((1 - at.t) * radius[0] + at.t * radius[1]).epsilon(0.05));
        }
    }
    const Tree of_spines = segment(spines, wood_presets().front(), {}),
               of_bones = segment(bones, wood_presets().front(), {}),
               of_merged = segment(merged, wood_presets().front(), {});
    const auto sway = [](const Tree& tree, const Vec3& way) {
        return sway_along(SmallMotion(tree, Vec3(0, -9.81, 0), Pose::drawn), way).frequency;
    };
    for (const Vec3& way : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ())})
        for (const Tree* other : {&of_bones, &of_merged})
            CHECK(sway(*other, way) == Approx(sway(of_spines, way)).epsilon(0.05));
    for (std::size_t l = 0; l < bones.leaves(); ++l) {
        for (const Splines* other : {&spines, &merged}) {
            const std::int32_t same = leaf_nearest(*other, bones.leaf_position[l]);
            CHECK(near(other->leaf_position[same], bones.leaf_position[l], 1e-4));
            CHECK(other->leaf_length[same] == Approx(bones.leaf_length[l]).epsilon(1e-4));
            CHECK(other->leaf_width[same] == Approx(bones.leaf_width[l]).epsilon(1e-4));
            // By the object tree here, by the bone's ID there.
            if (other == &spines) CHECK(other->leaf_branch[same] == spine_of_bone_branch[bones.leaf_branch[l]]);
        }
    }
    // Leaves were turned a little between the two exports, but grow outward in both.
    CHECK(mean_cosine(bones) > 0.8);
    CHECK(mean_cosine(spines) > 0.75);
}

TEST_CASE("a small hand-written export with units, axis and bare bones") {
    const auto content = foreign_case("speedtree/leafrefs_on_trunk.xml");
    if (!content) return;
    const Splines s = imported(*content, "leafrefs.xml").splines;
    CHECK(s.branches() == 1);
    CHECK(near(s.point[1], {0, 1, 0}));
    REQUIRE(s.leaves() == 1);
    CHECK(near(s.leaf_position[0], {0.1, 1.25, 0.1}));
    CHECK(s.leaf_length[0] == Approx(0.3));
}
