#include "armature.h"
#include "formats/imports/nearest_segment.h"
#include "formats/imports/pipe_rule.h"
#include "formats/imports/polyline_search.h"
#include "formats/imports/speedtree_bones.h"

namespace bough {
namespace {

// Behind the branches that are there, each with the place that its base is nearest to, of a branch of bones or another twig.
void add_twigs(std::vector<ImportedBranch>& branches, const std::vector<Twig>& twigs) {
    const std::size_t bones = branches.size();
    for (const Twig& twig : twigs) {
        branches.emplace_back();
        branches.back().point = twig.point;
        branches.back().radius = twig.radius;
    }
    std::vector<Vec3> point;
    std::vector<double> radius;
    std::vector<std::int32_t> base;
    std::vector<LineSegment> segment;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        base.push_back(std::int32_t(point.size()));
        for (std::size_t k = 0; k < branches[b].point.size(); ++k) {
            const auto at = std::int32_t(point.size());
            if (k > 0) segment.push_back({at - 1, at, std::int32_t(b)});
            point.push_back(branches[b].point[k]);
            radius.push_back(branches[b].radius[k]);
        }
    }
    const SegmentSearch search(point, radius, base, std::move(segment), branches.size());
    BranchSearch on(branches);
    const auto grow_on = [&](ImportedBranch& branch, std::int32_t parent) {
        branch.parent = parent;
        if (parent >= 0) branch.parent_at = on.nearest(std::size_t(parent), branch.point.front()).fraction;
    };
    // The nearest branch of bones that is as thick there.
    const auto bone_wood = [&](const ImportedBranch& branch) {
        std::int32_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < bones; ++c) {
            const OnPolyline at = on.nearest(c, branch.point.front());
            const double* r = &branches[c].radius[at.segment];
            const double lacks = std::max(0.0, branch.radius.front() - (1 - at.t) * r[0] - at.t * r[1]);
            if (at.distance + 100 * lacks < least) least = at.distance + 100 * lacks, best = std::int32_t(c);
        }
        return best;
    };
    for (std::size_t b = bones; b < branches.size(); ++b) {
        const SegmentPlace place = search.nearest(base[b], std::int32_t(b));
        grow_on(branches[b], place.segment.piece);
        const double there =
            place.segment.piece < 0 ? 0 : (1 - place.t) * radius[place.segment.a] + place.t * radius[place.segment.b];
        if (branches[b].radius.front() > 1.5 * there)
            grow_on(branches[b], bone_wood(branches[b])); // its own was not found
    }
    // Twigs that end up on one another in a circle go to the bones' wood.
    for (std::size_t b = bones; b < branches.size(); ++b) {
        std::size_t steps = 0;
        for (std::int32_t at = std::int32_t(b); at >= std::int32_t(bones) && steps <= branches.size(); ++steps)
            at = branches[std::size_t(at)].parent;
        if (steps <= branches.size()) continue;
        grow_on(branches[b], bone_wood(branches[b]));
    }
}

} // namespace

ImportedTree tree_of(const Armature& armature, ImportNotes& notes) {
    ImportedTree tree;
    tree.branches = speedtree::branches_of_bones(armature.bones).branches;
    fill_radii(tree.branches, notes);
    if (!armature.twigs.empty()) add_twigs(tree.branches, armature.twigs);
    return tree;
}

} // namespace bough
