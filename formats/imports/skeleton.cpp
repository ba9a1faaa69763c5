#include "skeleton.h"
#include "clearly_more.h"
#include "formats/plain_text.h"
#include "formats/release.h"
#include "lib/base/counted.h"

namespace bough {
namespace {

bool is_loose(const Skeleton& s, std::int32_t node) {
    return !s.loose.empty() && s.loose[node];
}

// Puts nodes that stand where their parent stands out of the tree: their children get the parent. Returns how many.
std::size_t join_coincident(Skeleton& s, const std::vector<std::int32_t>& order, std::vector<char>& joined) {
    joined.assign(s.parent.size(), false);
    std::size_t count = 0;
    for (const std::int32_t i : order) {
        const std::int32_t p = s.parent[i];
        if (p < 0) continue;
        if (joined[p]) s.parent[i] = s.parent[p];
        if (is_loose(s, i) || s.point[i] != s.point[s.parent[i]]) continue;
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
        if (p < 0 || joined[i] || is_loose(s, i)) continue;
        way[p] = std::max(way[p], way[i] + (s.point[i] - s.point[p]).norm());
    }
    return way;
}

double straightness(const Skeleton& s, std::int32_t child) {
    const std::int32_t p = s.parent[child];
    if (is_loose(s, p)) return 0; // nothing comes before it
    const Vec3 before = s.point[p] - s.point[s.parent[p]];
    return before.normalized().dot((s.point[child] - s.point[p]).normalized());
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
        if (p < 0 || joined[i] || s.parent[p] < 0 || is_loose(s, i)) continue;
        if (next[p] < 0 || goes_before(s, way, i, next[p])) next[p] = i;
    }
    return next;
}

// The first one or two points of the branch that begins with this node's segment, or at a loose node.
void begin_at(const Skeleton& s, std::int32_t node, ImportedBranch& b) {
    const std::int32_t p = s.parent[node];
    if (!is_loose(s, node)) {
        const bool root_radius = s.parent[p] < 0 && s.radius[p] >= 0;
        b.point.push_back(s.point[p]);
        b.radius.push_back(root_radius ? s.radius[p] : s.radius[node]);
    }
    b.point.push_back(s.point[node]);
    b.radius.push_back(s.radius[node]);
}

// Fills branches whose sizes are known, so that no vector is larger than it must be.
void fill(const Skeleton& s, const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& branch_of,
          const std::vector<std::int32_t>& count, std::vector<ImportedBranch>& branches) {
    for (std::size_t b = 0; b < branches.size(); ++b) {
        branches[b].point.reserve(std::size_t(count[b]));
        branches[b].radius.reserve(std::size_t(count[b]));
    }
    for (const std::int32_t i : order) {
        if (branch_of[i] < 0) continue;
        ImportedBranch& b = branches[branch_of[i]];
        if (b.point.empty()) {
            begin_at(s, i, b);
            continue;
        }
        b.point.push_back(s.point[i]);
        b.radius.push_back(s.radius[i]);
    }
}

// A loose node at a root begins a branch of the first trunk there; a root itself is on no branch.
void stand_loose_on_trunks(const Skeleton& s, std::vector<ImportedBranch>& branches,
                           const std::vector<std::int32_t>& start) {
    if (s.loose.empty()) return;
    std::vector<std::int32_t> trunk(s.parent.size(), -1);
    const auto on_root = [&](std::size_t b) { return branches[b].parent < 0; };
    const auto begins_there = [&](std::size_t b) { return branches[b].point.front() == s.point[start[b]]; };
    for (std::size_t b = branches.size(); b-- > 0;)
        if (on_root(b) && begins_there(b)) trunk[start[b]] = std::int32_t(b);
    for (std::size_t b = 0; b < branches.size(); ++b)
        if (on_root(b) && !begins_there(b)) branches[b].parent = trunk[start[b]];
}

} // namespace

std::vector<ImportedBranch> branches_of(Skeleton&& s, const std::string& name, ImportNotes& notes) {
    const ParentsFirst sorted = parents_first(s.parent);
    if (sorted.cycle >= 0)
        throw InputError(file_line(name, s.line[sorted.cycle]), "is its own ancestor, expected a tree");
    const std::vector<std::int32_t>& order = sorted.order;
    release(s.line);
    std::vector<char> joined;
    const std::size_t zero_length = join_coincident(s, order, joined);
    std::vector<std::int32_t> next = continuations(s, order, joined);

    std::vector<ImportedBranch> branches;
    std::vector<std::int32_t> branch_of(s.parent.size(), -1);
    std::vector<double> arc(s.parent.size(), 0), length; // [file unit] within the branch; of the branch
    std::vector<std::int32_t> root_children(s.parent.size(), 0), start, count;
    for (const std::int32_t i : order) {
        const std::int32_t p = s.parent[i];
        if (p < 0 || joined[i]) continue;
        const double segment = is_loose(s, i) ? 0.0 : (s.point[i] - s.point[p]).norm();
        if (next[p] == i) {
            branch_of[i] = branch_of[p];
            ++count[branch_of[i]];
            length[branch_of[i]] = arc[i] = arc[p] + segment;
            continue;
        }
        if (s.parent[p] < 0) ++root_children[p];
        branch_of[i] = std::int32_t(branches.size());
        branches.emplace_back().parent = branch_of[p];
        count.push_back(is_loose(s, i) ? 1 : 2);
        start.push_back(p);
        length.push_back(arc[i] = segment);
    }
    std::size_t lone = 0;
    for (const std::int32_t i : order) lone += s.parent[i] < 0 && root_children[i] == 0;
    std::vector<double> from; // [file unit] of each branch's start within the branch that it leaves
    from.reserve(branches.size());
    for (const std::int32_t p : start) from.push_back(arc[p]);
    // A large tree has no memory to hold these beside the branches.
    release(next, root_children, joined, arc);
    fill(s, order, branch_of, count, branches);
    stand_loose_on_trunks(s, branches, start);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const std::int32_t parent = branches[b].parent;
        if (parent >= 0) branches[b].parent_at = std::min(1.0, from[b] / length[parent]);
    }
    if (zero_length > 0)
        notes.lines.push_back(counted(zero_length, "segment without length joined to its parent",
                                      "segments without length joined to their parent"));
    if (lone > 0) notes.lines.push_back(counted(lone, "root", "roots") + " without a segment left out");
    return branches;
}

} // namespace bough
