#include "spline_nodes.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <limits>
#include <numeric>

namespace bough {
namespace {

constexpr double on_axis = 1e-6; // of the parent's length
constexpr double snap = 1e-9;    // of a branch's length: a place this near to a point is the point

// Branches in the order in which they leave their parents, parent after parent, and where each parent's begin.
struct Children {
    std::vector<std::int32_t> branch;
    std::vector<std::size_t> first;
};

Children children_of(const Splines& s) {
    Children made;
    made.branch.resize(s.branches());
    std::iota(made.branch.begin(), made.branch.end(), 0);
    std::stable_sort(made.branch.begin(), made.branch.end(), [&](std::int32_t a, std::int32_t b) {
        const auto i = std::size_t(a), k = std::size_t(b);
        return s.parent[i] != s.parent[k] ? s.parent[i] < s.parent[k] : s.parent_at[i] < s.parent_at[k];
    });
    made.first.assign(s.branches() + 2, 0);
    for (const std::int32_t p : s.parent) ++made.first[std::size_t(p + 2)];
    std::partial_sum(made.first.begin(), made.first.end(), made.first.begin());
    made.first.erase(made.first.begin()); // of roots, which nothing bears
    return made;
}

class Builder {
public:
    explicit Builder(const Splines& s)
        : s_(s), children_(children_of(s)), start_(s.branches(), -1), begins_(s.branches(), -1),
          tree_of_(s.branches(), 0), off_axis_(s.branches(), false), length_(s.branches(), 0) {}

    SplineNodes build() {
        for (std::size_t b = 0; b < s_.branches(); ++b) add_branch(b);
        count_losses();
        return std::move(n_);
    }

private:
    // The next node of branch b.
    std::int32_t add(std::size_t b, const Vec3& point, double radius, std::int32_t parent) {
        const auto made = std::int32_t(n_.parent.size());
        n_.point.push_back(point);
        n_.radius.push_back(radius);
        n_.parent.push_back(parent);
        n_.tree.push_back(tree_of_[b]);
        branch_of_.push_back(std::int32_t(b));
        goes_on_.push_back(-1);
        if (begins_[b] < 0) begins_[b] = made;
        if (parent >= 0 && branch_of_[std::size_t(parent)] == std::int32_t(b)) goes_on_[std::size_t(parent)] = made;
        return made;
    }

    // What branch b begins with: a root, its parent's node, or a node of its own off the axis.
    std::int32_t add_base(std::size_t b) {
        const auto first = std::size_t(s_.first_point[b]);
        if (s_.parent[b] < 0) {
            tree_of_[b] = std::int32_t(n_.trees++);
            return add(b, s_.point[first], s_.radius[first], -1);
        }
        const auto p = std::size_t(s_.parent[b]), from = std::size_t(start_[b]);
        tree_of_[b] = tree_of_[p];
        if ((n_.point[from] - s_.point[first]).norm() <= on_axis * length_[p]) return start_[b];
        off_axis_[b] = true;
        return add(b, s_.point[first], s_.radius[first], start_[b]);
    }

    void add_branch(std::size_t b) {
        const auto first = std::size_t(s_.first_point[b]), end = std::size_t(s_.first_point[b + 1]);
        for (std::size_t i = first; i + 1 < end; ++i) length_[b] += (s_.point[i + 1] - s_.point[i]).norm();
        const double near = snap * length_[b];
        const auto at = [&](std::size_t child) {
            return s_.parent_at[std::size_t(children_.branch[child])] * length_[b];
        };
        std::size_t child = children_.first[b];
        const std::size_t children_end = children_.first[b + 1];
        // Children up to this arc length leave from the node.
        const auto bear = [&](double arc, std::int32_t node) {
            for (; child < children_end && at(child) <= arc + near; ++child)
                start_[std::size_t(children_.branch[child])] = node;
        };
        std::int32_t node = add_base(b);
        double arc = 0;
        bear(0, node);
        for (std::size_t i = first; i + 1 < end; ++i) {
            const double piece = (s_.point[i + 1] - s_.point[i]).norm();
            while (child < children_end && at(child) < arc + piece - near) {
                const double place = at(child), t = (place - arc) / piece;
                node = add(b, (1 - t) * s_.point[i] + t * s_.point[i + 1],
                           (1 - t) * s_.radius[i] + t * s_.radius[i + 1], node);
                bear(place, node);
            }
            node = add(b, s_.point[i + 1], s_.radius[i + 1], node);
            arc += piece;
            bear(i + 2 < end ? arc : std::numeric_limits<double>::infinity(), node);
        }
    }

    void count_losses() {
        for (std::size_t b = 0; b < s_.branches(); ++b) {
            if (s_.parent[b] < 0) continue;
            const auto first = std::size_t(s_.first_point[b]), p = std::size_t(s_.parent[b]);
            const auto from = std::size_t(start_[b]), own = std::size_t(begins_[b]);
            n_.off_axis += off_axis_[b];
            n_.base_radius += !off_axis_[b] && s_.radius[first] != s_.radius[first + 1];
            const bool foot = branch_of_[from] != std::int32_t(p) || n_.parent[from] < 0;
            n_.at_foot += foot;
            if (foot) continue;
            const std::int32_t next = goes_on_[from];
            n_.goes_on += next < 0 || n_.radius[own] >= n_.radius[std::size_t(next)] * (1 - 1e-6);
        }
    }

    const Splines& s_;
    Children children_;
    SplineNodes n_;
    std::vector<std::int32_t> start_;  // of each branch: its parent's node that it leaves from
    std::vector<std::int32_t> begins_; // its first node of its own
    std::vector<std::int32_t> tree_of_;
    std::vector<char> off_axis_;
    std::vector<double> length_;
    std::vector<std::int32_t> branch_of_, goes_on_; // of each node: the branch it is of, the next node of that
};

} // namespace

SplineNodes nodes_of(const Splines& splines) {
    return Builder(splines).build();
}

std::vector<std::string> losses(const SplineNodes& nodes, const Splines& splines) {
    std::vector<std::string> lines;
    const auto note = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) lines.push_back(counted(count, one, many));
    };
    note(splines.leaves(), "leaf or petal left out, which a skeleton does not hold",
         "leaves and petals left out, which a skeleton does not hold");
    note(splines.fruits(), "fruit left out, which a skeleton does not hold",
         "fruit left out, which a skeleton does not hold");
    note(nodes.off_axis, "branch begins off its parent's axis: a piece from the axis leads to it",
         "branches begin off their parent's axis: a piece from the axis leads to each");
    note(nodes.base_radius,
         "branch's radius at its base left out, where the parent's node stands: readers take that of its first piece",
         "branches' radius at their base left out, where the parent's node stands: readers take that "
         "of their first piece");
    note(nodes.goes_on,
         "branch is no thinner than what goes on from where it leaves, or nothing does: readers may take it for its "
         "parent's own",
         "branches are no thinner than what goes on from where they leave, or nothing does: readers may "
         "take them for their parent's own");
    note(nodes.at_foot,
         "branch leaves its parent at its foot: readers take it for a trunk, or for a branch of what that grows on",
         "branches leave their parent at its foot: readers take them for trunks, or for branches of what "
         "that grows on");
    if (!splines.material.empty() || !splines.color.empty())
        lines.push_back("wood and colours left out, which a skeleton does not hold");
    return lines;
}

} // namespace bough
