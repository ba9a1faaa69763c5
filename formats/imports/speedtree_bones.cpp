#include "speedtree_bones.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "pipe_rule.h"
#include <algorithm>

namespace bough::speedtree {
namespace {

std::vector<std::int32_t> order_of(const std::vector<Bone>& bones) {
    std::vector<std::int32_t> parent;
    parent.reserve(bones.size());
    for (const Bone& b : bones) parent.push_back(b.parent);
    return parents_first(parent).order;
}

double length_of(const Bone& b) {
    return (b.end - b.start).norm();
}

Vec3 direction_of(const Bone& b) {
    return (b.end - b.start).normalized();
}

// Length of the longest way from each bone's start to a tip, over starts (and ends where given).
std::vector<double> longest_way(const std::vector<Bone>& bones, const std::vector<std::int32_t>& order) {
    std::vector<double> way(bones.size(), 0);
    for (std::size_t k = order.size(); k-- > 0;) {
        const std::int32_t i = order[k];
        const Bone& b = bones[i];
        if (b.has_end) way[i] = std::max(way[i], length_of(b));
        if (b.parent >= 0) way[b.parent] = std::max(way[b.parent], way[i] + (b.start - bones[b.parent].start).norm());
    }
    return way;
}

// Of two children of a bone without an end, whether a is the better one to end at.
bool better_end(const std::vector<Bone>& bones, const std::vector<double>& way, std::int32_t a, std::int32_t b) {
    const Bone& parent = bones[bones[a].parent];
    const bool same_a = bones[a].generator == parent.generator, same_b = bones[b].generator == parent.generator;
    if (same_a != same_b) return same_a;
    const double way_a = way[a] + (bones[a].start - parent.start).norm();
    const double way_b = way[b] + (bones[b].start - parent.start).norm();
    if (std::abs(way_a - way_b) > 1e-6 * std::max(way_a, way_b)) return way_a > way_b;
    if (parent.parent < 0) return false;
    const Vec3 before = parent.start - bones[parent.parent].start;
    return before.dot((bones[a].start - parent.start).normalized()) >
           before.dot((bones[b].start - parent.start).normalized());
}

// Length of all bones from each bone's start on outward.
std::vector<double> wood_beyond(const std::vector<Bone>& bones, const std::vector<std::int32_t>& order) {
    std::vector<double> wood(bones.size(), 0);
    for (std::size_t k = order.size(); k-- > 0;) {
        const std::int32_t i = order[k];
        wood[i] += length_of(bones[i]);
        if (bones[i].parent >= 0) wood[bones[i].parent] += wood[i];
    }
    return wood;
}

double extent_of(const std::vector<Bone>& bones) {
    Vec3 low = bones.front().start, high = low;
    for (const Bone& b : bones) {
        low = low.cwiseMin(b.start).cwiseMin(b.end);
        high = high.cwiseMax(b.start).cwiseMax(b.end);
    }
    return (high - low).norm();
}

// The bone that goes on each bone's branch, -1: none. Starts and ends are printed with 6 digits, which is what the
// tolerance allows for; a bone that leaves the side of another starts at least 0.4 radii away.
std::vector<std::int32_t> continuations(const std::vector<Bone>& bones) {
    std::vector<std::int32_t> next(bones.size(), -1);
    const double rounding = 1e-5 * extent_of(bones);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const Bone& b = bones[i];
        if (b.parent < 0) continue;
        const Bone& p = bones[b.parent];
        if (b.generator != p.generator || (b.start - p.end).norm() > rounding + 1e-3 * length_of(p)) continue;
        std::int32_t& best = next[b.parent];
        if (best < 0 || direction_of(p).dot(direction_of(b)) > direction_of(p).dot(direction_of(bones[best])))
            best = std::int32_t(i);
    }
    return next;
}

// Radius at the tip of a branch whose last radius entry is still to be found.
double tip_radius(const ImportedBranch& b) {
    const std::size_t n = b.point.size();
    const double last = b.radius[n - 2];
    if (n < 3) return last;
    const double before = (b.point[n - 2] - b.point[n - 3]).norm(), length = (b.point[n - 1] - b.point[n - 2]).norm();
    if (!(before > 0)) return last;
    return std::clamp(last - (b.radius[n - 3] - last) * length / before, 0.1 * last, last);
}

} // namespace

void complete_ends(std::vector<Bone>& bones, ImportNotes& notes) {
    const std::vector<std::int32_t> order = order_of(bones);
    const std::vector<double> way = longest_way(bones, order);
    std::vector<std::int32_t> ends_at(bones.size(), -1);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const std::int32_t p = bones[i].parent;
        if (p < 0 || bones[p].has_end) continue;
        if (ends_at[p] < 0 || better_end(bones, way, std::int32_t(i), ends_at[p])) ends_at[p] = std::int32_t(i);
    }
    std::size_t missing = 0;
    for (const std::int32_t i : order) {
        Bone& b = bones[i];
        if (b.has_end) continue;
        ++missing;
        b.has_end = true;
        if (ends_at[i] >= 0)
            b.end = bones[ends_at[i]].start;
        else
            b.end = b.parent >= 0 ? Vec3(b.start + (b.start - bones[b.parent].start)) : b.start;
    }
    if (missing > 0)
        notes.lines.push_back(counted(missing, "bone", "bones") +
                              " without End: taken to the start of the bone that goes on, "
                              "at tips as long as the step from the parent");
}

void complete_radii(std::vector<Bone>& bones, ImportNotes& notes) {
    const std::size_t missing =
        std::size_t(std::count_if(bones.begin(), bones.end(), [](const Bone& b) { return !(b.radius > 0); }));
    if (missing == 0) return;
    const std::vector<std::int32_t> order = order_of(bones);
    const std::vector<double> wood = wood_beyond(bones, order), way = longest_way(bones, order);
    const std::size_t thickest = std::size_t(
        std::max_element(bones.begin(), bones.end(), [](const Bone& a, const Bone& b) { return a.radius < b.radius; }) -
        bones.begin());
    const double known = bones[thickest].radius, known_wood = wood[thickest];
    for (const std::int32_t i : order) {
        Bone& b = bones[i];
        if (b.radius > 0) continue;
        const bool root = b.parent < 0;
        const double anchor = root ? known : bones[b.parent].radius, anchor_wood = root ? known_wood : wood[b.parent];
        if (root && !(known > 0))
            b.radius = way[i] / pipe_slenderness;
        else
            b.radius = anchor_wood > 0 ? anchor * std::sqrt(wood[i] / anchor_wood) : anchor;
    }
    notes.lines.push_back(counted(missing, "bone", "bones") + " without Radius: taken from the " +
                          (known > 0 ? "nearest thicker bone" : "tree's size") + " and the length of wood beyond each");
    notes.radii_guessed = !(known > 0);
}

BoneBranches branches_of_bones(const std::vector<Bone>& bones) {
    BoneBranches result;
    if (bones.empty()) return result;
    const std::vector<std::int32_t> order = order_of(bones), next = continuations(bones);
    result.branch_of.assign(bones.size(), -1);
    std::vector<double> arc(bones.size(), 0), length; // at each bone's start within its branch; of each branch
    std::vector<std::int32_t> first, last;            // bones of each branch
    for (const std::int32_t i : order) {
        const Bone& b = bones[i];
        const bool goes_on = b.parent >= 0 && next[b.parent] == i;
        if (goes_on) {
            result.branch_of[i] = result.branch_of[b.parent];
            arc[i] = length[result.branch_of[i]];
            result.branches[result.branch_of[i]].radius.back() = b.radius;
        } else {
            result.branch_of[i] = std::int32_t(result.branches.size());
            ImportedBranch branch;
            branch.parent = b.parent < 0 ? -1 : result.branch_of[b.parent];
            branch.point.push_back(b.start);
            branch.radius.push_back(b.radius);
            result.branches.push_back(std::move(branch));
            length.push_back(0);
            first.push_back(i);
            last.push_back(i);
        }
        last[result.branch_of[i]] = i;
        ImportedBranch& branch = result.branches[result.branch_of[i]];
        length[result.branch_of[i]] += (b.end - branch.point.back()).norm();
        branch.point.push_back(b.end);
        branch.radius.push_back(b.radius);
    }
    for (std::size_t k = 0; k < result.branches.size(); ++k) {
        ImportedBranch& branch = result.branches[k];
        const double tip = bones[last[k]].tip;
        branch.radius.back() = tip > 0 ? tip : tip_radius(branch);
        if (branch.parent < 0) continue;
        const Bone& parent = bones[bones[first[k]].parent];
        const double on_parent = projected(parent.start, parent.end, branch.point.front()) * length_of(parent);
        const double total = length[branch.parent];
        if (total > 0) branch.parent_at = std::min(1.0, (arc[bones[first[k]].parent] + on_parent) / total);
    }
    return result;
}

} // namespace bough::speedtree
