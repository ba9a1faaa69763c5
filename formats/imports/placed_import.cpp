#include "placed_import.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "lib/model/check_parts.h"
#include <algorithm>
#include <cmath>
#include <functional>

namespace bough {
namespace {

constexpr double aside = 0.01;                          // of the tree's extent
constexpr double floats = 0.5, floats_of_extent = 0.05; // [m]; [1]: stems of one stool begin at several heights
constexpr double tallest = 120, lowest = 0.1;           // [m]
constexpr double given_tallest = 10 * tallest;
constexpr const char* right = "; are its coordinates, or --units, right?";
constexpr double smallest = 1e-30; // [m] an inertia goes with the fifth power of a length, and does not vanish
constexpr double far = 100;        // of the median distance: trees stay below it, a neuron's axon below aloof

struct Oddness {
    double extent, median; // least share of the tree's extent, least multiple of the median radius
};
constexpr Oddness refused{1, 100}, noted{0.25, 20};

double middle_of(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::int64_t branch_at(const Splines& s, std::size_t point) {
    const auto after = std::upper_bound(s.first_point.begin(), s.first_point.end(), std::int32_t(point));
    return after - s.first_point.begin() - 1;
}

std::string place_text(const Vec3& p) {
    return shown(p.x() + 0.0) + ", " + shown(p.y() + 0.0) + ", " + shown(p.z() + 0.0) + " m (x, y up, z)";
}

void find_thick(const Splines& s, const std::string& name, ImportNotes& notes) {
    if (notes.odd_radius_told) return;
    const Box box = box_of(s.point);
    const auto odd = odd_radius(s.radius, (box.high - box.low).maxCoeff(), "m");
    if (!odd) return;
    const std::string found = "the radius of branch " + std::to_string(branch_at(s, odd->at)) + " at " +
                              place_text(s.point[odd->at]) + " is " + odd->text;
    if (odd->is_refused) throw InputError(name, found + "; expected less than the tree is large");
    notes.lines.push_back(found + ": is it a slip?");
}

// Where the middle of points is, and within what half of them are [m].
struct Spread {
    Vec3 middle;
    double half;
};

Spread spread_of(const std::vector<Vec3>& points) {
    Spread spread{Vec3::Zero(), 0};
    std::vector<double> values(points.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(points.begin(), points.end(), values.begin(), [=](const Vec3& p) { return p[axis]; });
        spread.middle[axis] = middle_of(values);
    }
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](const Vec3& p) { return (p - spread.middle).norm(); });
    spread.half = middle_of(values);
    return spread;
}

// The farthest of `points`, called by its index, beside the spread of the branches' own.
void find_far(const std::vector<Vec3>& points, const Spread& spread,
              const std::function<std::string(std::size_t)>& called, const std::string& name, ImportNotes& notes) {
    double most = 0;
    std::size_t worst = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const double distance = (points[k] - spread.middle).norm(); distance > most) most = distance, worst = k;
    if (!(most > far * spread.half) || spread.half == 0) return;
    const std::string found = called(worst) + " is at " + place_text(points[worst]) + ", " + shown(most) +
                              " m from the middle of the tree, half of which is within " + shown(spread.half) + " m";
    if (most > aloof * spread.half) throw InputError(name, found + "; expected all of it in one place" + right);
    notes.lines.push_back(found + ": is it a slip?");
}

// A leaf or fruit that is larger than the whole tree, and a hundred times as large as others.
void find_large(const std::vector<double>& sizes, const Splines& s, const std::string& called,
                const std::string& name) {
    if (sizes.empty()) return;
    std::vector<double> values(sizes);
    const double median = middle_of(values);
    const auto most = std::max_element(sizes.begin(), sizes.end());
    const Box box = box_of(s.point);
    const double extent = (box.high - box.low).maxCoeff();
    if (!(*most > refused.extent * extent && *most > refused.median * median)) return;
    throw InputError(name, "the " + called + std::to_string(most - sizes.begin()) + " is " + shown(*most) +
                               " m in a tree that is " + shown(extent) + " m large, with a median of " + shown(median) +
                               " m; expected less than the tree is large");
}

} // namespace

Box box_of(std::span<const Vec3> points) {
    Box box{points.front(), points.front()};
    for (const Vec3& p : points) {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    return box;
}

void set_on_ground(Splines& s, bool keep, ImportNotes& notes) {
    const Box box = box_of(s.point);
    const double extent = (box.high - box.low).maxCoeff();
    Vec3 base = Vec3::Zero();
    double ground = box.high.y(), highest = box.low.y();
    std::size_t roots = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.parent[b] >= 0) continue;
        const Vec3& p = s.point[s.first_point[b]];
        base += p;
        ground = std::min(ground, p.y());
        highest = std::max(highest, p.y());
        ++roots;
    }
    if (keep) {
        if (ground < -noted_height)
            notes.lines.push_back("its foot is " + shown(-ground) +
                                  " m below the ground, y = 0, under which no wind blows (--keep-place)");
        return;
    }
    if (highest - ground > std::min(floats, floats_of_extent * extent))
        notes.lines.push_back(
            "the highest of its " + std::to_string(roots) + " trunks begins " + shown(highest - ground) +
            " m above the lowest, on whose base the ground is set: in a simulation it begins in the air "
            "(treeconvert --split sets each on the ground)");
    base /= double(std::max<std::size_t>(1, roots));
    base.y() = ground;
    const double off = std::max(std::abs(base.x()), std::abs(base.z()));
    if (off <= aside * extent && std::abs(ground) <= std::min(noted_height, aside * extent)) return;
    notes.moved = -base;
    for (Vec3& p : s.point) p -= base;
    for (Vec3& p : s.leaf_position) p -= base;
    for (Vec3& p : s.fruit_position) p -= base;
    for (Vec3& p : s.fruit_center) p -= base;
    notes.lines.push_back("its foot stood at " + shown(base.x()) + ", " + shown(base.y()) + ", " + shown(base.z()) +
                          " m (x, y up, z): set on the ground at the origin (--keep-place leaves it)");
}

void name_absurd_scale(const Splines& s, bool unit_given, ImportNotes& notes) {
    const Box box = box_of(s.point);
    const double height = box.high.y() - box.low.y();
    if (height <= (unit_given ? given_tallest : tallest) && (unit_given || height >= lowest)) return;
    notes.lines.push_back("the tree is " + shown(height) + " m high, " +
                          (height > tallest ? "no tree is: " : "hardly a tree: ") +
                          (unit_given ? "is --units right?" : "is the unit right? (--units overrides)"));
}

void refuse_too_far(const Splines& s, double reach, const std::string& name) {
    if (s.point.empty()) return;
    const Box box = box_of(s.point);
    reach = std::max({reach, box.high.cwiseAbs().maxCoeff(), box.low.cwiseAbs().maxCoeff()});
    for (const double r : s.radius) reach = std::max(reach, r);
    if (reach > largest_length)
        throw InputError(name,
                         "reaches " + shown(reach) + " m, expected at most " + shown(largest_length) + " m" + right);
}

void refuse_too_small(const Splines& s, const std::string& name) {
    const Box box = box_of(s.point);
    if (const double extent = (box.high - box.low).maxCoeff(); extent < smallest)
        throw InputError(name, "is " + shown(extent) + " m large, expected at least " + shown(smallest) + " m" + right);
}

std::optional<OddRadius> odd_radius(std::span<const double> radius, double extent, const std::string& unit) {
    if (radius.empty()) return {};
    std::vector<double> values(radius.begin(), radius.end());
    const double median = middle_of(values);
    const auto most = std::max_element(radius.begin(), radius.end());
    const auto exceeds = [&](const Oddness& o) { return *most > o.extent * extent && *most > o.median * median; };
    if (!(median > 0) || !exceeds(noted)) return {};
    return OddRadius{std::size_t(most - radius.begin()), exceeds(refused),
                     shown(*most) + " " + unit + " in a tree that is " + shown(extent) +
                         " large, with a median radius of " + shown(median)};
}

void find_outlier(const Splines& s, const std::string& name, ImportNotes& notes) {
    if (s.point.empty()) return;
    find_thick(s, name, notes);
    const Spread spread = spread_of(s.point);
    find_far(
        s.point, spread, [&](std::size_t k) { return "a point of branch " + std::to_string(branch_at(s, k)); }, name,
        notes);
    find_far(
        s.leaf_position, spread, [](std::size_t k) { return "leaf " + std::to_string(k); }, name, notes);
    find_far(
        s.fruit_position, spread, [](std::size_t k) { return "fruit " + std::to_string(k); }, name, notes);
    find_large(s.leaf_length, s, "length of leaf ", name);
    find_large(s.leaf_width, s, "width of leaf ", name);
    find_large(s.fruit_radius, s, "radius of fruit ", name);
}

} // namespace bough
