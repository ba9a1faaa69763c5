#include "speedtree_spines.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "pipe_rule.h"
#include "polyline_search.h"
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace bough::speedtree {
namespace {

// Finds the branch whose first point is nearest: first points, each place once, sorted along the axis on which they lie
// widest apart and searched outward from the wanted place.
class NearestStart {
public:
    explicit NearestStart(const std::vector<ImportedBranch>& branches) : branches_(branches), order_(branches.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        if (order_.empty()) return;
        Vec3 low = start(0), high = low;
        for (const ImportedBranch& b : branches) {
            low = low.cwiseMin(b.point.front());
            high = high.cwiseMax(b.point.front());
        }
        (high - low).maxCoeff(&axis_);
        std::stable_sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) { return before(a, b); });
        const auto same = [&](std::int32_t a, std::int32_t b) { return start(a) == start(b); };
        order_.erase(std::unique(order_.begin(), order_.end(), same), order_.end());
    }
    std::int32_t find(const Vec3& p) const {
        const auto middle = std::lower_bound(order_.begin(), order_.end(), p[axis_],
                                             [&](std::int32_t i, double wanted) { return start(i)[axis_] < wanted; });
        std::int32_t best = -1;
        double distance = std::numeric_limits<double>::infinity();
        const auto closer = [&](std::int32_t i) {
            if (distance == 0 || std::abs(start(i)[axis_] - p[axis_]) > distance) return false;
            const double d = (start(i) - p).norm();
            if (d < distance) {
                best = i;
                distance = d;
            }
            return true;
        };
        for (auto up = middle; up != order_.end() && closer(*up);) ++up;
        for (auto down = middle; down != order_.begin() && closer(*(down - 1));) --down;
        return best;
    }

private:
    const Vec3& start(std::int32_t i) const { return branches_[i].point.front(); }
    // All of one place stand side by side, in the order of their branches.
    bool before(std::int32_t a, std::int32_t b) const {
        for (const Eigen::Index k : {axis_, (axis_ + 1) % 3, (axis_ + 2) % 3})
            if (start(a)[k] != start(b)[k]) return start(a)[k] < start(b)[k];
        return false;
    }
    const std::vector<ImportedBranch>& branches_;
    std::vector<std::int32_t> order_;
    Eigen::Index axis_ = 0;
};

std::vector<std::int32_t> spine_of_bones(const BoneBranches& bones, const std::vector<ImportedBranch>& branches) {
    const NearestStart nearest(branches);
    std::vector<std::int32_t> spine_of_chain;
    for (const ImportedBranch& chain : bones.branches) spine_of_chain.push_back(nearest.find(chain.point.front()));
    std::vector<std::int32_t> spine;
    for (const std::int32_t chain : bones.branch_of) spine.push_back(spine_of_chain[chain]);
    return spine;
}

double radius_at(const ImportedBranch& b, const OnPolyline& place) {
    if (b.point.size() < 2) return b.radius.front();
    return (1 - place.t) * b.radius[place.segment] + place.t * b.radius[place.segment + 1];
}

std::optional<double> median_or_none(std::vector<double>& values) {
    if (values.empty()) return {};
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void add_ratio(std::vector<double>& ratios, double found, double spine) {
    if (found > 0 && spine > 0) ratios.push_back(found / spine);
}

std::vector<double> bone_ratios(const File& file, const SpineBranches& spines) {
    std::vector<double> ratios;
    BranchSearch search(spines.branches);
    for (std::size_t i = 0; i < file.bones.size(); ++i) {
        if (spines.branch_of_bone[i] < 0) continue;
        const auto k = std::size_t(spines.branch_of_bone[i]);
        add_ratio(ratios, file.bones[i].radius, radius_at(spines.branches[k], search.nearest(k, file.bones[i].start)));
    }
    return ratios;
}

std::vector<double> bark_ratios(const File& file, const SpineBranches& spines) {
    std::vector<double> ratios;
    BranchSearch search(spines.branches);
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
        if (file.objects[i].surface.empty()) continue; // read for objects with a spine alone
        const auto k = std::size_t(spines.branch_of_object[i]);
        const ImportedBranch& b = spines.branches[k];
        if (b.point.size() < 2) continue;
        for (const Vec3& p : file.objects[i].surface) {
            const OnPolyline place = search.nearest(k, p);
            add_ratio(ratios, place.distance, radius_at(b, place));
        }
    }
    return ratios;
}

// A bone is 0.84 to 1.0 times as thick as its spine: ratios somewhat below a known conversion mean that conversion.
double known_factor(double ratio) {
    constexpr std::array<double, 6> conversions{1, 2.54, 25.4, 3.28084, 30.48, 12};
    double best = ratio, off = std::numeric_limits<double>::infinity();
    const auto consider = [&](double factor) {
        const double of = ratio / factor;
        if (of < 0.8 || of > 1.1 || std::abs(std::log(of)) >= off) return;
        off = std::abs(std::log(of));
        best = factor;
    };
    for (const double c : conversions) {
        for (const double ten : {1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3}) {
            if (c != 1 && ten != 1) continue;
            consider(c * ten);
            consider(ten / c);
        }
    }
    return best;
}

double largest_extent(const std::vector<ImportedBranch>& branches) {
    Vec3 low = branches.front().point.front(), high = low;
    for (const ImportedBranch& b : branches) {
        for (const Vec3& p : b.point) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    return (high - low).maxCoeff();
}

bool has_radii(const ImportedBranch& b) {
    return std::any_of(b.radius.begin(), b.radius.end(), [](double r) { return r > 0; });
}

// A spine without radii gets those of its bones, each at the point where the bone begins, the tip that of their last.
void take_radii_of_bones(const File& file, const BoneBranches& bones, SpineBranches& spines, ImportNotes& notes) {
    std::vector<char> wanting;
    for (const ImportedBranch& b : spines.branches) wanting.push_back(!has_radii(b));
    std::size_t taken = 0;
    BranchSearch search(spines.branches);
    for (std::size_t i = 0; i < file.bones.size(); ++i) {
        const std::int32_t k = spines.branch_of_bone[i];
        if (k < 0 || !wanting[k] || !(file.bones[i].radius > 0)) continue;
        ImportedBranch& b = spines.branches[k];
        const OnPolyline place = search.nearest(std::size_t(k), file.bones[i].start);
        const std::size_t point = std::min(place.segment + (place.t > 0.5), b.point.size() - 1);
        taken += !(b.radius[point] > 0);
        b.radius[point] = file.bones[i].radius;
        double& tip = b.radius.back();
        if (!(tip > 0)) tip = bones.branches[bones.branch_of[i]].radius.back();
    }
    if (taken > 0)
        notes.lines.push_back(counted(taken, "point", "points") +
                              " of spines without radii given the Radius of their bones");
}

double radius_factor(const File& file, const SpineBranches& spines, std::optional<double> unit, ImportNotes& notes) {
    std::vector<double> ratios = bone_ratios(file, spines);
    const char* yardstick = " Radius of bones";
    if (ratios.empty()) {
        ratios = bark_ratios(file, spines);
        yardstick = " distances of bark points";
    }
    if (const auto ratio = median_or_none(ratios)) {
        const double factor = known_factor(*ratio);
        if (factor != 1)
            notes.lines.push_back("radii of spines multiplied by " + shown(factor) +
                                  " to the scale of positions: median of " + std::to_string(ratios.size()) + yardstick +
                                  " over spine radius is " + shown(*ratio));
        return factor;
    }
    notes.lines.push_back("radii of spines taken as metres: the file has neither bones nor bark to measure them by");
    return 1 / (unit ? *unit : likely_unit(largest_extent(spines.branches)));
}

} // namespace

SpineBranches branches_of_spines(File& file, const BoneBranches& bones, std::optional<double> unit,
                                 ImportNotes& notes) {
    SpineBranches result;
    std::vector<std::int32_t> parent;
    for (const Object& o : file.objects) parent.push_back(o.parent);
    result.branch_of_object.assign(file.objects.size(), -1);
    result.branches.reserve(file.objects.size()); // the search below keeps where they are
    BranchSearch search(result.branches);
    for (const std::int32_t i : parents_first(parent).order) {
        Object& o = file.objects[i];
        const std::int32_t above = o.parent < 0 ? -1 : result.branch_of_object[o.parent];
        if (o.spine.empty()) {
            result.branch_of_object[i] = above;
            continue;
        }
        ImportedBranch b;
        b.parent = above;
        if (above >= 0) b.parent_at = search.nearest(std::size_t(above), o.spine.front()).fraction;
        b.point = std::move(o.spine);
        b.radius = std::move(o.spine_radius);
        result.branch_of_object[i] = std::int32_t(result.branches.size());
        result.branches.push_back(std::move(b));
    }
    result.branch_of_bone = spine_of_bones(bones, result.branches);
    if (std::any_of(result.branches.begin(), result.branches.end(), has_radii)) {
        const double factor = radius_factor(file, result, unit, notes);
        for (ImportedBranch& b : result.branches)
            for (double& r : b.radius) r *= factor;
    }
    take_radii_of_bones(file, bones, result, notes);
    fill_radii(result.branches, notes);
    return result;
}

} // namespace bough::speedtree
