#include "skeleton.h"
#include "plain_text.h"

namespace bough {
namespace {

// Puts nodes that stand where their parent stands out of the tree: their children get the parent. Returns how many.
std::size_t join_coincident(Skeleton& s, const std::vector<std::int32_t>& order, std::vector<char>& joined) {
    joined.assign(s.parent.size(), false);
    std::size_t count = 0;
    for (const std::int32_t i : order) {
        const std::int32_t p = s.parent[i];
        if (p < 0) continue;
        if (joined[p]) s.parent[i] = s.parent[p];
        if (s.point[i] != s.point[s.parent[i]]) continue;
        joined[i] = true;
        ++count;
    }
    return count;
}

// Length of the longest way from each node to a tip.
std::vector<double> longest_way(const Skeleton& s, const std::vector<std::int32_t>& order,
                                const std::vector<char>& joined) {
    std::vector<double> way(s.parent.size(), 0);
    for (std::size_t k = order.size(); k-- > 0;) {
        const std::int32_t i = order[k];
        const std::int32_t p = s.parent[i];
        if (p < 0 || joined[i]) continue;
        way[p] = std::max(way[p], way[i] + (s.point[i] - s.point[p]).norm());
    }
    return way;
}

double straightness(const Skeleton& s, std::int32_t child) {
    const std::int32_t p = s.parent[child];
    const Vec3 before = s.point[p] - s.point[s.parent[p]];
    return before.normalized().dot((s.point[child] - s.point[p]).normalized());
}

bool clearly_more(double a, double b) {
    return a > b * (1 + 1e-6);
}

// Whether child a of a node goes on rather than child b.
bool goes_before(const Skeleton& s, const std::vector<double>& way, std::int32_t a, std::int32_t b) {
    if (clearly_more(s.radius[a], s.radius[b])) return true;
    if (clearly_more(s.radius[b], s.radius[a])) return false;
    const std::int32_t p = s.parent[a];
    const double way_a = way[a] + (s.point[a] - s.point[p]).norm(), way_b = way[b] + (s.point[b] - s.point[p]).norm();
    if (clearly_more(way_a, way_b)) return true;
    if (clearly_more(way_b, way_a)) return false;
    return straightness(s, a) > straightness(s, b);
}

// The child that continues each node's branch; -1 for tips and for roots.
std::vector<std::int32_t> continuations(const Skeleton& s, const std::vector<std::int32_t>& order,
                                        const std::vector<char>& joined) {
    const std::vector<double> way = longest_way(s, order, joined);
    std::vector<std::int32_t> next(s.parent.size(), -1);
    for (const std::int32_t i : order) {
        const std::int32_t p = s.parent[i];
        if (p < 0 || joined[i] || s.parent[p] < 0) continue;
        if (next[p] < 0 || goes_before(s, way, i, next[p])) next[p] = i;
    }
    return next;
}

ImportedBranch begun_at(const Skeleton& s, std::int32_t node, std::int32_t parent_branch) {
    const std::int32_t p = s.parent[node];
    const bool root_radius = s.parent[p] < 0 && s.radius[p] >= 0;
    ImportedBranch b;
    b.parent = parent_branch;
    b.point = {s.point[p], s.point[node]};
    b.radius = {root_radius ? s.radius[p] : s.radius[node], s.radius[node]};
    return b;
}

} // namespace

std::vector<ImportedBranch> branches_of(Skeleton&& s, const std::string& name, ImportNotes& notes) {
    const ParentsFirst sorted = parents_first(s.parent);
    if (sorted.cycle >= 0)
        throw InputError(file_line(name, s.line[sorted.cycle]), "is its own ancestor, expected a tree");
    const std::vector<std::int32_t>& order = sorted.order;
    std::vector<char> joined;
    const std::size_t zero_length = join_coincident(s, order, joined);
    const std::vector<std::int32_t> next = continuations(s, order, joined);

    std::vector<ImportedBranch> branches;
    std::vector<std::int32_t> branch_of(s.parent.size(), -1);
    std::vector<double> arc(s.parent.size(), 0), length; // [file unit] within the branch; of the branch
    std::vector<std::int32_t> root_children(s.parent.size(), 0), start;
    for (const std::int32_t i : order) {
        const std::int32_t p = s.parent[i];
        if (p < 0 || joined[i]) continue;
        const double segment = (s.point[i] - s.point[p]).norm();
        if (next[p] == i) {
            branch_of[i] = branch_of[p];
            branches[branch_of[i]].point.push_back(s.point[i]);
            branches[branch_of[i]].radius.push_back(s.radius[i]);
            length[branch_of[i]] = arc[i] = arc[p] + segment;
            continue;
        }
        if (s.parent[p] < 0) ++root_children[p];
        branch_of[i] = std::int32_t(branches.size());
        branches.push_back(begun_at(s, i, branch_of[p]));
        start.push_back(p);
        length.push_back(arc[i] = segment);
    }
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const std::int32_t parent = branches[b].parent;
        if (parent >= 0) branches[b].parent_at = std::min(1.0, arc[start[b]] / length[parent]);
    }
    std::size_t lone = 0;
    for (const std::int32_t i : order) lone += s.parent[i] < 0 && root_children[i] == 0;
    if (zero_length > 0)
        notes.lines.push_back(std::to_string(zero_length) + " segments without length joined to their parent");
    if (lone > 0) notes.lines.push_back(std::to_string(lone) + " roots without a segment left out");
    return branches;
}

} // namespace bough
