#include "leaf_hosts.h"
#include "nearest_segment.h"
#include <algorithm>

namespace bough {

void find_hosts(const std::vector<ImportedBranch>& branches, std::vector<ImportedLeaf>& leaves) {
    const auto lacks_host = [](const ImportedLeaf& leaf) { return leaf.branch < 0; };
    if (std::none_of(leaves.begin(), leaves.end(), lacks_host)) return;
    std::vector<Vec3> point; // of all branches, then of the leaves
    std::vector<LineSegment> segments;
    for (std::size_t b = 0; b < branches.size(); ++b)
        for (std::size_t k = 0; k < branches[b].point.size(); ++k) {
            const auto at = std::int32_t(point.size());
            if (k > 0) segments.push_back({at - 1, at, std::int32_t(b)});
            point.push_back(branches[b].point[k]);
        }
    const std::size_t wood = point.size();
    for (const ImportedLeaf& leaf : leaves)
        if (lacks_host(leaf)) point.push_back(leaf.position);
    // Without radii and bases what is nearest is nearest in space, and nothing is left out.
    const std::vector<double> radius(point.size(), -1);
    const std::vector<std::int32_t> base(branches.size(), -1);
    const SegmentSearch search(point, radius, base, std::move(segments), branches.size());
    const auto no_group = std::int32_t(branches.size());
    std::size_t next = wood;
    for (ImportedLeaf& leaf : leaves)
        if (lacks_host(leaf)) leaf.branch = search.nearest(std::int32_t(next++), no_group).segment.piece;
}

} // namespace bough
