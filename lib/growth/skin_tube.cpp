#include "skin_mesh.h"
#include <algorithm>
#include <numbers>

namespace bough {

namespace {

constexpr double point_ratio = 1e-3; // an end ring thinner than this times its neighbour is drawn as a point
constexpr double nested = 0.8;       // how much of its parent's inner radius a collar may fill: room for bends
constexpr double flared = 1.18; // the root ring over the branch's own radius there, where the parent is thick enough
// The collar, within the parent: between the two the tube comes out of it, wider than it goes on
constexpr double collared = 2.2;
constexpr double flare_length = 1.1; // of the branch's radius: from the root ring to where its own radius begins

struct Ring {
    Vec3 center;
    double radius;
    Binding binding;
    Vec3 tangent = Vec3::Zero();
    double v = 0;
};

double radius_at(const Vec3& size, double z) {
    return size.x() > 0 ? size.y() + (size.z() - size.y()) * (z / size.x()) : size.y();
}

// Where on the parent's axis a side branch begins: where its own axis, followed back, comes nearest to the parent's
// (at most 45 degrees down from its joint), kept away from free ends of the parent's tube.
double collar_place(const Vec3& joint, const Vec3& direction, const Vec3& parent_size, const BranchTube& tube) {
    const double off = std::hypot(joint.x(), joint.y());
    double back = 0;
    if (off > 0) {
        const double outward = (joint.x() * direction.x() + joint.y() * direction.y()) / off;
        if (outward > 0) back = std::clamp(direction.z() / outward, -1.0, 1.0) * off;
    }
    const double length = parent_size.x();
    return std::clamp(joint.z() - back, tube.parent_base ? 0.25 * length : 0.0,
                      tube.parent_tip ? 0.75 * length : length);
}

// The two rings where a side branch leaves its parent: the collar, within the parent and moved by it alone, and the
// root ring, where the branch comes out: at its joint, or further along it by what is left to the parent's surface.
void add_junction(std::vector<Ring>& rings, const Tree& tree, const DrawnPose& pose, const BranchTube& tube) {
    const std::size_t body = std::size_t(tube.piece.front()), parent = std::size_t(tree.parent[body]);
    const Vec3& joint = tree.joint_position[body];
    const Vec3& size = tree.size[body];
    const Vec3& parent_size = tree.size[parent];
    const double place = collar_place(joint, tree.joint_rotation[body] * Vec3::UnitZ(), parent_size, tube);
    const Vec3 collar(0, 0, place);
    const double thickness = radius_at(parent_size, place);
    double room = thickness * std::cos(std::numbers::pi / tube.parent_sides);
    if (tube.parent_base) room = std::min(room, place);
    if (tube.parent_tip) room = std::min(room, parent_size.x() - place);
    const double out = std::clamp(thickness - (joint - collar).norm(), 0.0, 0.25 * size.x());
    const double t = size.x() > 0 ? out / size.x() : 0;
    const double own = radius_at(size, out), flare = std::max(own, std::min(flared * own, nested * thickness));
    const double begins =
        out + flare_length * own; // only on a piece that is long enough for it, of a tube that is round enough
    const bool flares = tube.sides > 3 && flare > 1.02 * own && begins < 0.45 * size.x();
    rings.push_back(
        {pose.at(parent, collar), std::min(flares ? collared * own : size.y(), nested * room), bound_to(parent)});
    rings.push_back(
        {pose.at(body, {0, 0, out}), flares ? flare : own, {std::int32_t(body), std::int32_t(parent), float(0.5 - t)}});
    if (flares)
        rings.push_back({pose.at(body, {0, 0, begins}),
                         radius_at(size, begins),
                         {std::int32_t(body), std::int32_t(parent), float(0.5 * (0.5 - t))}});
}

// Rings from base to tip, without tangents and v.
void place_rings(std::vector<Ring>& rings, const Tree& tree, const DrawnPose& pose, const BranchTube& tube) {
    const auto& piece = tube.piece;
    const bool side = tube.parent_sides > 0;
    if (side) add_junction(rings, tree, pose, tube);
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const std::size_t body = std::size_t(piece[k]);
        const Vec3& size = tree.size[body];
        if (k > 0) {
            const double radius = (tree.size[std::size_t(piece[k - 1])].z() + size.y()) / 2;
            rings.push_back({pose.x_w[body], radius, {piece[k], piece[k - 1], 0.5f}});
        } else if (!side) {
            rings.push_back({pose.x_w[body], size.y(), bound_to(body)});
        }
        if (tube.sides > 3)
            rings.push_back({pose.at(body, {0, 0, size.x() / 2}), (size.y() + size.z()) / 2, bound_to(body)});
    }
    const std::size_t last = std::size_t(piece.back());
    const Vec3& size = tree.size[last];
    rings.push_back({pose.at(last, {0, 0, size.x()}), size.z(), bound_to(last)});
}

// The circumference at the branch's base, which is the unit of v; of its thickest ring where it starts from a point.
double unit_of_v(const std::vector<Ring>& rings, double base_radius) {
    double radius = base_radius;
    if (!(radius > 0))
        for (const Ring& ring : rings) radius = std::max(radius, ring.radius);
    return radius > 0 ? 2 * std::numbers::pi * radius : 1;
}

// Tangents halve the angle between the stretches before and after a ring. v is the arc length from the branch's joint
// (`start` at the first ring) over the circumference.
void finish_rings(std::vector<Ring>& rings, double start, double circumference, Vec3 before) {
    double arc = start;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        rings[i].v = arc / circumference;
        Vec3 after = before;
        if (i + 1 < rings.size()) {
            const Vec3 stretch = rings[i + 1].center - rings[i].center;
            const double length = stretch.norm();
            if (length > 0) after = stretch / length;
            arc += length;
        }
        const Vec3 both = i == 0 ? after : Vec3(before + after);
        rings[i].tangent = both.norm() > 1e-6 ? both.normalized() : after;
        before = after;
    }
}

// Carries x, perpendicular to unit vector `from`, along the least turn that takes it to unit vector `to`.
Vec3 carry(const Vec3& x, const Vec3& from, const Vec3& to) {
    const double c = 1 + from.dot(to);
    const Vec3 turned = c > 1e-9 ? Vec3(x - (x.dot(to) / c) * (from + to)) : x;
    return (turned - turned.dot(to) * to).normalized();
}

// One vertex a side, all at the same place, so that each triangle of a closed end has its own stretch of bark.
std::int32_t add_end(Skin& skin, const Ring& ring, const Vec3& normal, double v, int sides) {
    std::int32_t first = 0;
    for (int j = 0; j < sides; ++j) {
        const std::int32_t added = add_vertex(skin, ring.center, normal, (j + 0.5) / sides, v, ring.binding);
        if (j == 0) first = added;
    }
    return first;
}

std::int32_t add_ring(Skin& skin, const Ring& ring, const Vec3& x, double slope, int sides) {
    const Vec3 y = ring.tangent.cross(x);
    std::int32_t first = 0;
    for (int j = 0; j <= sides; ++j) {
        const double angle = 2 * std::numbers::pi * (j % sides) / sides; // the seam's columns are the same to the bit
        const Vec3 out = std::cos(angle) * x + std::sin(angle) * y;
        const std::int32_t added =
            add_vertex(skin, ring.center + ring.radius * out, (out - slope * ring.tangent).normalized(),
                       double(j) / sides, ring.v, ring.binding);
        if (j == 0) first = added;
    }
    return first;
}

double slope_at(const std::vector<Ring>& rings, std::size_t i) {
    const Ring& a = rings[i == 0 ? 0 : i - 1];
    const Ring& b = rings[std::min(i + 1, rings.size() - 1)];
    const double length = (rings[i].center - a.center).norm() + (b.center - rings[i].center).norm();
    return length > 0 ? (b.radius - a.radius) / length : 0;
}

} // namespace

void add_tube(Skin& skin, const Tree& tree, const DrawnPose& pose, const BranchTube& tube) {
    const std::size_t body = std::size_t(tube.piece.front());
    const Vec3 axis = pose.R_wb[body].col(2);
    std::vector<Ring> rings;
    place_rings(rings, tree, pose, tube);
    const double circumference = unit_of_v(rings, tree.size[body].y());
    double start = 0;
    if (tube.parent_sides > 0)
        start = (rings[1].center - pose.x_w[body]).norm() - (rings[1].center - rings[0].center).norm();
    finish_rings(rings, start, circumference, axis);

    const int n = tube.sides;
    const std::size_t count = rings.size();
    const Ring &base = rings[0], &tip = rings[count - 1];
    const bool point_tip = tip.radius <= point_ratio * rings[count - 2].radius;
    const bool point_base = base.radius <= point_ratio * rings[1].radius && !(point_tip && count == 2);
    const std::size_t begin = point_base ? 1 : 0, end = point_tip ? count - 1 : count;

    auto triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) { skin.triangle.push_back({a, b, c}); };
    const double base_v = base.v - (point_base ? 0 : base.radius / circumference);
    const std::int32_t base_end = add_end(skin, base, -base.tangent, base_v, n);
    Vec3 x = carry(pose.R_wb[body].col(0), axis, rings[begin].tangent);
    std::int32_t lower = 0;
    for (std::size_t i = begin; i < end; ++i) {
        if (i > begin) x = carry(x, rings[i - 1].tangent, rings[i].tangent);
        const std::int32_t upper = add_ring(skin, rings[i], x, slope_at(rings, i), n);
        for (std::int32_t j = 0; j < n; ++j) {
            if (i == begin) {
                triangle(base_end + j, upper + j + 1, upper + j);
            } else {
                triangle(lower + j, lower + j + 1, upper + j + 1);
                triangle(lower + j, upper + j + 1, upper + j);
            }
        }
        lower = upper;
    }
    const double tip_v = tip.v + (point_tip ? 0 : tip.radius / circumference);
    const std::int32_t tip_end = add_end(skin, tip, tip.tangent, tip_v, n);
    for (std::int32_t j = 0; j < n; ++j) triangle(lower + j, lower + j + 1, tip_end + j);
}

} // namespace bough
