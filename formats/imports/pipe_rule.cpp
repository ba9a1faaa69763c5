#include "pipe_rule.h"
#include "formats/plain_text.h"
#include "lib/model/polyline.h"
#include <algorithm>
#include <limits>
#include <tuple>

namespace bough {
namespace {

using Branches = std::vector<ImportedBranch>;

bool known(double radius) {
    return radius > 0;
}

bool tapers_to_a_point(const ImportedBranch& b) {
    return b.radius.size() > 1 && !known(b.radius.back()) && known(b.radius[b.radius.size() - 2]);
}

// Branch indices, parents first, and each branch's children from its tip to its base.
struct Family {
    std::vector<std::int32_t> order;
    std::vector<std::int32_t> child, first;
};

Family family_of(const Branches& branches) {
    Family f;
    std::vector<std::int32_t> parent;
    parent.reserve(branches.size());
    for (const ImportedBranch& b : branches) parent.push_back(b.parent);
    f.order = parents_first(parent).order;
    for (std::size_t b = 0; b < branches.size(); ++b)
        if (parent[b] >= 0) f.child.push_back(std::int32_t(b));
    std::sort(f.child.begin(), f.child.end(), [&](std::int32_t a, std::int32_t b) {
        return std::tuple(parent[a], -branches[a].parent_at, a) < std::tuple(parent[b], -branches[b].parent_at, b);
    });
    f.first.assign(branches.size() + 1, 0);
    for (const std::int32_t c : f.child) ++f.first[parent[c] + 1];
    for (std::size_t b = 0; b < branches.size(); ++b) f.first[b + 1] += f.first[b];
    return f;
}

// Tips beyond each point of each branch: r^n in units of a tip's; and the longest way from each branch's base to a tip.
struct Carried {
    std::vector<std::vector<double>> tips;
    std::vector<double> way;
};

Carried carried_by(const Branches& branches, const Family& f) {
    Carried c{std::vector<std::vector<double>>(branches.size()), std::vector<double>(branches.size(), 0)};
    for (std::size_t i = f.order.size(); i-- > 0;) {
        const std::int32_t b = f.order[i];
        const std::vector<double> arc = arc_lengths(branches[b].point);
        c.way[b] = arc.empty() ? 0 : arc.back();
        c.tips[b].assign(arc.size(), 1);
        double sum = 1;
        std::int32_t next = f.first[b];
        for (std::size_t k = arc.size(); k-- > 0;) {
            for (; next < f.first[b + 1] && branches[f.child[next]].parent_at * arc.back() >= arc[k]; ++next) {
                const std::int32_t child = f.child[next];
                sum += c.tips[child].empty() ? 0 : c.tips[child].front();
                c.way[b] = std::max(c.way[b], branches[child].parent_at * arc.back() + c.way[child]);
            }
            c.tips[b][k] = sum;
        }
    }
    return c;
}

double thickness(double tips) {
    return std::pow(tips, 1 / pipe_exponent);
}

// Radius of a tip that the rule has: the median over the known points, else from the longest way of the thickest trunk.
double tip_radius(const Branches& branches, const Carried& carried) {
    std::vector<double> ratio;
    for (std::size_t b = 0; b < branches.size(); ++b)
        for (std::size_t k = 0; k < branches[b].radius.size(); ++k)
            if (known(branches[b].radius[k])) ratio.push_back(branches[b].radius[k] / thickness(carried.tips[b][k]));
    if (!ratio.empty()) {
        const auto middle = ratio.begin() + std::ptrdiff_t(ratio.size() / 2);
        std::nth_element(ratio.begin(), middle, ratio.end());
        return *middle;
    }
    double tips = 0, way = 0;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        if (branches[b].parent >= 0 || branches[b].point.empty() || carried.tips[b].front() < tips) continue;
        if (carried.tips[b].front() > tips || carried.way[b] > way) way = carried.way[b];
        tips = carried.tips[b].front();
    }
    return way / pipe_slenderness / thickness(std::max(1.0, tips));
}

// For each child of b, how thick b is where it grows.
void measure_hosts(const Branches& branches, const Family& f, std::int32_t b, std::vector<double>& host) {
    const ImportedBranch& branch = branches[b];
    if (f.first[b] == f.first[b + 1] || branch.point.size() < 2) return;
    const std::vector<double> arc = arc_lengths(branch.point);
    std::size_t k = arc.size() - 1; // children stand from the tip to the base
    for (std::int32_t c = f.first[b]; c < f.first[b + 1]; ++c) {
        const double at = branches[f.child[c]].parent_at * arc.back();
        while (k > 1 && arc[k - 1] > at) --k;
        const double length = arc[k] - arc[k - 1];
        const double t = length > 0 ? std::clamp((at - arc[k - 1]) / length, 0.0, 1.0) : 0;
        host[f.child[c]] = (1 - t) * branch.radius[k - 1] + t * branch.radius[k];
    }
}

// Between two known points: straight over the arc.
void interpolate(ImportedBranch& b, const std::vector<double>& arc, std::size_t from, std::size_t to) {
    for (std::size_t k = from + 1; k < to; ++k) {
        const double length = arc[to] - arc[from];
        const double t = length > 0 ? (arc[k] - arc[from]) / length : 0;
        b.radius[k] = (1 - t) * b.radius[from] + t * b.radius[to];
    }
}

void fill_branch(ImportedBranch& b, const std::vector<double>& tips, double tip, double most) {
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < b.radius.size(); ++k)
        if (known(b.radius[k])) at.push_back(k);
    if (at.empty()) {
        const double scale = std::min(tip, most / thickness(tips.front()));
        for (std::size_t k = 0; k < b.radius.size(); ++k) b.radius[k] = scale * thickness(tips[k]);
        return;
    }
    const bool pointed = tapers_to_a_point(b);
    const std::vector<double> arc = arc_lengths(b.point);
    const auto from = [&](std::size_t known_at, std::size_t k) {
        b.radius[k] = b.radius[known_at] * thickness(tips[k] / tips[known_at]);
    };
    for (std::size_t k = 0; k < at.front(); ++k) from(at.front(), k);
    for (std::size_t k = at.back() + 1; k < b.radius.size() && !pointed; ++k) from(at.back(), k);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) interpolate(b, arc, at[i], at[i + 1]);
}

} // namespace

void fill_radii(Branches& branches, ImportNotes& notes) {
    std::size_t points = 0, unknown = 0;
    std::vector<char> wanting(branches.size(), false);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const std::vector<double>& radius = branches[b].radius;
        const auto count = std::size_t(std::count_if(radius.begin(), radius.end(), known));
        const std::size_t lacks = radius.size() - count - tapers_to_a_point(branches[b]);
        wanting[b] = lacks > 0;
        unknown += lacks;
        points += radius.size();
    }
    if (unknown == 0) return;
    const Family family = family_of(branches);
    const Carried carried = carried_by(branches, family);
    const double tip = tip_radius(branches, carried);
    std::vector<double> host(branches.size(), 0);
    for (const std::int32_t b : family.order) {
        constexpr double any = std::numeric_limits<double>::infinity();
        if (wanting[b]) fill_branch(branches[b], carried.tips[b], tip, host[b] > 0 ? host[b] : any);
        measure_hosts(branches, family, b, host);
    }
    notes.lines.push_back(std::to_string(unknown) + " of " + std::to_string(points) +
                          " radii are missing or 0; filled by the pipe rule (r^" + shown(pipe_exponent) +
                          " is the sum over what grows on) with tips of " + shown(tip) + " in the file's unit");
    notes.radii_guessed = unknown == points;
}

} // namespace bough
