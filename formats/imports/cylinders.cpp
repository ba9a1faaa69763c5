#include "cylinders.h"
#include "clearly_more.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>

namespace bough {
namespace {

std::vector<double> lengths_of(const Cylinders& c) {
    std::vector<double> length(c.size());
    for (std::size_t i = 0; i < c.size(); ++i) length[i] = (c.end[i] - c.start[i]).norm();
    return length;
}

// Length of the longest way from each cylinder's start to a tip.
std::vector<double> longest_way(const Cylinders& c, const std::vector<std::int32_t>& order) {
    std::vector<double> way = lengths_of(c);
    for (std::size_t k = order.size(); k-- > 0;) {
        const std::int32_t i = order[k], p = c.parent[i];
        if (p >= 0) way[p] = std::max(way[p], (c.end[p] - c.start[p]).norm() + way[i]);
    }
    return way;
}

// How far off a cylinder's axis or end a child may begin and still touch it: its radius, else a tenth of its length.
double reach(const Cylinders& c, std::int32_t i) {
    return c.radius[i] > 0 ? c.radius[i] : 0.1 * (c.end[i] - c.start[i]).norm();
}

bool may_go_on(const Cylinders& c, std::int32_t child) {
    const std::int32_t p = c.parent[child];
    if (!c.branch.empty()) return c.branch[child] == c.branch[p];
    const double near = std::max(c.radius[p], 0.25 * (c.end[p] - c.start[p]).norm());
    return (c.start[child] - c.end[p]).norm() <= near;
}

// The child that goes on each cylinder, -1: none.
std::vector<std::int32_t> continuations(const Cylinders& c, const std::vector<std::int32_t>& order) {
    const std::vector<double> way = longest_way(c, order);
    std::vector<std::int32_t> next(c.size(), -1);
    for (std::size_t i = 0; i < c.size(); ++i) {
        const std::int32_t p = c.parent[i];
        if (p < 0 || !may_go_on(c, std::int32_t(i))) continue;
        std::int32_t& best = next[p];
        const bool thicker = best >= 0 && clearly_more(c.radius[i], c.radius[best]);
        const bool thinner = best >= 0 && clearly_more(c.radius[best], c.radius[i]);
        if (best < 0 || thicker || (!thinner && clearly_more(way[i], way[best]))) best = std::int32_t(i);
    }
    return next;
}

struct Gaps {
    std::size_t count = 0;
    double widest = 0; // [file unit]
    void add(double gap) {
        ++count;
        widest = std::max(widest, gap);
    }
};

// Branches that grow point by point, and where on them each cylinder came to lie.
class Grouping {
public:
    explicit Grouping(const Cylinders& c) : c_(c), branch_of_(c.size(), -1), end_(c.size(), 0) {}
    void begin(std::int32_t cylinder);
    void go_on(std::int32_t cylinder);
    std::vector<ImportedBranch> finish();
    Gaps gaps;

private:
    void add_point(ImportedBranch& b, const Vec3& p, double radius) {
        b.point.push_back(p);
        b.radius.push_back(radius);
    }
    const Cylinders& c_;
    std::vector<ImportedBranch> branches_;
    std::vector<std::int32_t> branch_of_, end_; // of each cylinder; the point of that branch where it ends
    struct JointOnParent {
        std::int32_t point; // of the parent's branch, before the joint
        double t;           // fraction of the piece from that point to the next
    };
    std::vector<JointOnParent> place_; // of each branch on its parent
};

void Grouping::begin(std::int32_t i) {
    ImportedBranch b;
    JointOnParent place{0, 0};
    const std::int32_t p = c_.parent[i];
    if (p >= 0) {
        b.parent = branch_of_[p];
        const ImportedBranch& on = branches_[b.parent];
        place.point = end_[p] - 1;
        const Vec3 &from = on.point[place.point], &to = on.point[place.point + 1];
        place.t = projected(from, to, c_.start[i]);
        const Vec3 nearest = from + place.t * (to - from);
        const double gap = (c_.start[i] - nearest).norm();
        if (gap > reach(c_, p) + c_.radius[i]) {
            add_point(b, nearest, c_.radius[i]);
            gaps.add(gap);
        }
    }
    add_point(b, c_.start[i], c_.radius[i]);
    add_point(b, c_.end[i], c_.radius[i]);
    branch_of_[i] = std::int32_t(branches_.size());
    end_[i] = std::int32_t(b.point.size()) - 1;
    branches_.push_back(std::move(b));
    place_.push_back(place);
}

void Grouping::go_on(std::int32_t i) {
    const std::int32_t p = c_.parent[i];
    ImportedBranch& b = branches_[branch_of_[p]];
    const double gap = (c_.start[i] - b.point.back()).norm();
    if (gap > reach(c_, p)) {
        add_point(b, c_.start[i], c_.radius[i]);
        gaps.add(gap);
    }
    add_point(b, c_.end[i], c_.radius[i]);
    branch_of_[i] = branch_of_[p];
    end_[i] = std::int32_t(b.point.size()) - 1;
}

// Lengths of branches are known only now.
std::vector<ImportedBranch> Grouping::finish() {
    std::vector<std::vector<std::size_t>> on(branches_.size());
    for (std::size_t k = 0; k < branches_.size(); ++k)
        if (branches_[k].parent >= 0) on[branches_[k].parent].push_back(k);
    std::vector<double> arc;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        if (on[k].empty()) continue;
        const std::vector<Vec3>& point = branches_[k].point;
        arc.assign(1, 0);
        for (std::size_t j = 1; j < point.size(); ++j) arc.push_back(arc.back() + (point[j] - point[j - 1]).norm());
        for (const std::size_t child : on[k]) {
            const auto j = std::size_t(place_[child].point);
            const double at = arc[j] + place_[child].t * (arc[j + 1] - arc[j]);
            branches_[child].parent_at = arc.back() > 0 ? std::min(1.0, at / arc.back()) : 0;
        }
    }
    return std::move(branches_);
}

} // namespace

std::vector<ImportedBranch> branches_of(Cylinders&& c, const std::string& name, ImportNotes& notes) {
    const ParentsFirst sorted = parents_first(c.parent);
    if (sorted.cycle >= 0)
        throw InputError(file_line(name, c.line[sorted.cycle]), "is its own ancestor, expected a tree");
    const std::vector<std::int32_t> next = continuations(c, sorted.order);
    Grouping grouping(c);
    std::size_t roots = 0;
    for (const std::int32_t i : sorted.order) {
        const std::int32_t p = c.parent[i];
        roots += p < 0;
        if (p >= 0 && next[p] == i)
            grouping.go_on(i);
        else
            grouping.begin(i);
    }
    if (grouping.gaps.count > 0)
        notes.lines.push_back(counted(grouping.gaps.count, "gap", "gaps") +
                              " between a cylinder and its parent bridged, the widest of " +
                              shown(grouping.gaps.widest) + " units");
    if (roots > 1) notes.lines.push_back(std::to_string(roots) + " cylinders have no parent: each begins a trunk");
    return grouping.finish();
}

} // namespace bough
