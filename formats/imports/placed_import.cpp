#include "placed_import.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double far_aside = 10, far_above = 1; // of the tree's extent
constexpr double tallest = 120, lowest = 0.1;   // [m]
constexpr double given_tallest = 10 * tallest;
constexpr const char* right = "; are its coordinates, or --units, right?";
constexpr double farthest = 1e30, smallest = 1e-30; // [m]

struct Box {
    Vec3 low, high;
};

Box box_of(const Splines& s) {
    Box box{s.point.front(), s.point.front()};
    for (const Vec3& p : s.point) {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    return box;
}

} // namespace

void bring_to_origin(Splines& s, ImportNotes& notes) {
    const Box box = box_of(s);
    const double extent = (box.high - box.low).maxCoeff();
    Vec3 base = Vec3::Zero();
    double ground = box.high.y();
    std::size_t roots = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.parent[b] >= 0) continue;
        const Vec3& p = s.point[s.first_point[b]];
        base += p;
        ground = std::min(ground, p.y());
        ++roots;
    }
    base /= double(std::max<std::size_t>(1, roots));
    base.y() = ground;
    const double aside = std::max(std::abs(base.x()), std::abs(base.z()));
    if (aside <= far_aside * extent && std::abs(ground) <= far_above * extent) return;
    notes.moved = -base;
    for (Vec3& p : s.point) p -= base;
    for (Vec3& p : s.leaf_position) p -= base;
    for (Vec3& p : s.fruit_position) p -= base;
    for (Vec3& p : s.fruit_center) p -= base;
    notes.lines.push_back("far from the origin: moved so that its base stands there, by " + shown(-base.x()) + ", " +
                          shown(-base.y()) + ", " + shown(-base.z()) + " m (x, y up, z)");
}

void name_absurd_scale(const Splines& s, bool unit_given, ImportNotes& notes) {
    const Box box = box_of(s);
    const double height = box.high.y() - box.low.y();
    if (height <= (unit_given ? given_tallest : tallest) && (unit_given || height >= lowest)) return;
    notes.lines.push_back("the tree is " + shown(height) + " m high, " +
                          (height > tallest ? "no tree is: " : "hardly a tree: ") +
                          (unit_given ? "is --units right?" : "is the unit right? (--units overrides)"));
}

void refuse_too_far(const Splines& s, double reach, const std::string& name) {
    if (s.point.empty()) return;
    const Box box = box_of(s);
    reach = std::max({reach, box.high.cwiseAbs().maxCoeff(), box.low.cwiseAbs().maxCoeff()});
    for (const double r : s.radius) reach = std::max(reach, r);
    if (reach > farthest)
        throw InputError(name, "reaches " + shown(reach) + " m, expected at most " + shown(farthest) + " m" + right);
}

void refuse_too_small(const Splines& s, const std::string& name) {
    const Box box = box_of(s);
    if (const double extent = (box.high - box.low).maxCoeff(); extent < smallest)
        throw InputError(name, "is " + shown(extent) + " m large, expected at least " + shown(smallest) + " m" + right);
}

} // namespace bough
