#include "contact.h"
#include "../base/parallel.h"
#include "path_response.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

// Squared distance of a point from the way x ... x + d.
double distance2(const Vec3& point, const Vec3& x, const Vec3& d) {
    const double length2 = d.squaredNorm();
    const double s = length2 > 0 ? std::clamp(Vec3(point - x).dot(d) / length2, 0.0, 1.0) : 0;
    return Vec3(x + s * d - point).squaredNorm();
}

constexpr double slack = 1e-5; // [m] what counts as touching (shape.h), and rounding

bool yields(const Contact& contact, Kind kind) {
    return is_flat(kind) && !contact.leaves;
}

// One contact a pair of free part and tree body: where they meet first.
void add_meeting(const FreeBody& free, std::size_t k, std::int64_t body, const Vec3& d, const Meeting& m,
                 std::vector<ContactPoint>& found) {
    ContactPoint c;
    c.free = k;
    c.body = body;
    c.point = m.at.on_second;
    c.normal = m.at.normal;
    c.way = m.way;
    c.gap = m.way > 0 ? 0 : std::min(0.0, m.at.gap);
    c.arm = c.point - (free.motion.x + m.way * d);
    found.push_back(c);
}

// A point that moves with the tree's body: where it is in the body's frame when they meet, by its axis' way there, and after the step.
void carry_along(ContactPoint& c, const Capsule& own, const Capsule& before, const Capsule& after,
                 const BodyPose& pose) {
    const Vec3 a = before.a + c.way * (after.a - before.a), b = before.b + c.way * (after.b - before.b);
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    const double s = length2 > 0 ? std::clamp(Vec3(c.point - a).dot(along) / length2, 0.0, 1.0) : 0;
    // Along the axis as it lies, and across it as the world has it: a body turns little in a step, or it is met end on.
    c.point_b = own.a + s * (own.b - own.a) + pose.R.transpose() * (c.point - a - s * along);
    c.point = pose.at(c.point_b);
}

// The lowest point of an end: of a branch the rim of its flat end, else of a sphere.
Vec3 lowest(const Vec3& center, double radius, Kind kind, const Vec3& axis) {
    if (kind != Kind::branch) return center - radius * Vec3::UnitY();
    const Vec3 down = axis.y() * axis - Vec3::UnitY(); // across the axis
    const double size = down.norm();
    return size > 1e-9 ? Vec3(center + radius / size * down) : center;
}

void find_ground(const FreeBody& free, std::size_t k, const FreeMotion& end, double height,
                 std::vector<ContactPoint>& found) {
    const FreeMotion& start = free.motion;
    if (std::min(start.x.y(), end.x.y()) - free.bound > height) return;
    const auto low = [&](const FreeMotion& at, const FreePart& part, bool far) {
        const Capsule c = placed(at, part);
        const Vec3 axis = at.q * (part.q * Vec3(Vec3::UnitZ()));
        return lowest(far ? c.b : c.a, far ? c.radius_b : c.radius_a, part.kind, axis);
    };
    for (const FreePart& part : free.parts)
        for (const bool far : {false, true}) {
            if (far && part.kind == Kind::fruit) continue; // one point
            const Vec3 from = low(start, part, far), to = low(end, part, far);
            const double gap = from.y() - height, closes = from.y() - to.y();
            if (std::min(gap, to.y() - height) > 0) continue;
            Meeting m;
            m.way = gap > 0 ? gap / closes : 0;
            const Vec3 at = from + m.way * (to - from);
            m.at = {gap, Vec3::UnitY(), Vec3(at.x(), height, at.z())};
            add_meeting(free, k, -1, Vec3(end.x - start.x), m, found);
            found.back().closing = (1 - m.way) * closes;
        }
}

// A body of the tree through the step.
struct BodyWay {
    std::size_t body;
    Capsule own, start, stop; // in its frame, and placed
    const BodyPose& after;

    BodyWay(const Tree& tree, std::size_t i, const BodyPose& before, const BodyPose& pose)
        : body(i), own(capsule_of(tree.kind[i], tree.size[i])), start(placed(own, Quat(before.R), before.x)),
          stop(placed(own, Quat(pose.R), pose.x)), after(pose) {}
};

void meet_part(const BodyWay& tree, const FreeBody& free, std::size_t k, const FreeMotion& end, const FreePart& part,
               std::vector<ContactPoint>& found) {
    const Capsule from = placed(free.motion, part), to = placed(end, part);
    const Meeting m = meet(from, to, tree.start, tree.stop);
    if (!m.meets) return;
    add_meeting(free, k, std::int64_t(tree.body), Vec3(end.x - free.motion.x), m, found);
    found.back().closing = std::max(0.0, m.at.gap - nearest(to, tree.stop).gap);
    carry_along(found.back(), tree.own, tree.start, tree.stop, tree.after);
}

} // namespace

template <class T>
void find_contacts(const Plan<T>& plan, const Tree& tree, const Subtrees& trees, TreeWay<T> tree_way,
                   const Contact& contact, const FreeBody& free, std::size_t k, const FreeMotion& end, bool brute_force,
                   std::vector<ContactPoint>& found, ContactTests& tests) {
    if (contact.ground && !free.leaf()) find_ground(free, k, end, contact.ground_height, found);
    if (!plan.contact || (yields(contact, free.parts.front().kind) && free.leaf())) return;
    const Vec3 x = free.motion.x, d = end.x - x;
    std::vector<std::uint32_t> stack;
    for (const std::uint32_t root : trees.roots)
        visit_subtree(trees, root, stack, [&](std::size_t i) {
            if (plan.mass[i] == 0) return false; // it fell
            const BodyPose &before = tree_way.before.of(i), &after = tree_way.after.of(i);
            if (!brute_force) {
                ++tests.reaches;
                const double near =
                    double(trees.reach[i]) * (1 + 1e-5) + free.bound; // angles in float, poses in double
                if (distance2(before.x, x, d - (after.x - before.x)) > near * near) return false;
            }
            if (yields(contact, tree.kind[i])) return true;
            const Capsule own = capsule_of(tree.kind[i], tree.size[i]);
            if (!brute_force) {
                const Bound bound = bound_of(own);
                const Vec3 from = before.at(bound.middle), to = after.at(bound.middle);
                const double near = bound.radius + free.bound + slack;
                if (distance2(from, x, d - (to - from)) > near * near) return true;
            }
            ++tests.bodies;
            const BodyWay body(tree, i, before, after);
            tests.pairs += free.parts.size();
            for (const FreePart& part : free.parts) meet_part(body, free, k, end, part, found);
            return true;
        });
}

template <class T>
void find_contacts(const Tree& tree, const NearPairs<T>& near, std::span<const NearPair> pairs, TreeWay<T> tree_way,
                   const Contact& contact, const FreeBody& free, std::size_t k, const FreeMotion& end,
                   std::vector<ContactPoint>& found, ContactTests& tests) {
    if (contact.ground && !free.leaf()) find_ground(free, k, end, contact.ground_height, found);
    for (std::size_t p = 0; p < pairs.size();) {
        const std::uint32_t rank = pairs[p].rank;
        const std::size_t i = near.body_of(rank);
        ++tests.bodies;
        const BodyWay body(tree, i, tree_way.before.of(i), tree_way.after.of(i));
        for (; p < pairs.size() && pairs[p].rank == rank; ++p, ++tests.pairs)
            meet_part(body, free, k, end, free.parts[pairs[p].part], found);
    }
}

Mat3 mobility_of(const FreeBody& free, const Vec3& arm) {
    const Mat3 r = cross_matrix(arm);
    return Mat3::Identity() / free.mass - r * free.inverse_inertia_w() * r;
}

void push(FreeBody& free, const Vec3& arm, const Vec3& impulse) {
    free.motion.v += impulse / free.mass;
    free.motion.omega += free.inverse_inertia_w() * arm.cross(impulse);
}

namespace {

struct Solving {
    Mat3 mobility;                // [1/kg] the free body's and the tree's
    double along = 0, across = 0; // [kg] effective masses
    double target = 0;            // [m/s] least velocity apart
    Vec3 tree_velocity = Vec3::Zero();
    double normal_impulse = 0;
    Vec3 friction = Vec3::Zero();
};

} // namespace

template <class T>
void solve_contacts(const Plan<T>& plan, TreePoses<T>& poses, const TreeResponse<T>& sprung,
                    const TreeResponse<T>& rigid, const Contact& contact, std::vector<FreeBody>& free,
                    std::vector<ContactPoint>& points) {
    if (points.empty()) return;
    std::vector<Solving> solving(points.size());
    const double slow = 2 * plan.scene.gravity.norm() * plan.dt;
    std::vector<std::int64_t> bodies;
    for (const ContactPoint& c : points) {
        bodies.push_back(c.body);
        if (c.body >= 0) poses.of(std::size_t(c.body)); // known from here on
    }
    PathResponse response(plan, poses, sprung, rigid, bodies);
    // What the springs will have made of the trees' velocities at the end of the step in which they answer.
    response.apply_springs();
    parallel_for(points.size(), 5000, [&](std::size_t k) {
        ContactPoint& c = points[k];
        Solving& s = solving[k];
        const Mat3 W = mobility_of(free[c.free], c.arm);
        Vec3 now = Vec3::Zero();
        s.mobility = W;
        double bounces = 1;
        if (c.body >= 0) {
            s.mobility += response.mobility(k, c.point, true);
            now = poses.known(std::size_t(c.body)).velocity_at(c.point);
            s.tree_velocity = now + response.velocity(k, c.point);
            const Mat3 unsprung = W + response.mobility(k, c.point, false);
            bounces = c.normal.dot(s.mobility * c.normal) / c.normal.dot(unsprung * c.normal);
        }
        s.along = 1 / c.normal.dot(s.mobility * c.normal);
        s.across =
            1 / (s.mobility.trace() - c.normal.dot(s.mobility * c.normal)); // at most what any direction across has
        c.approach = -c.normal.dot(Vec3(free[c.free].velocity_at(c.arm) - now));
        s.target = c.approach > slow ? contact.restitution * bounces * c.approach : 0;
        if (c.free_speed > 0) s.target = -c.free_speed;
    });
    double fastest = 0;
    for (const ContactPoint& c : points) fastest = std::max(fastest, c.approach);
    response.forget_impulses();
    // Rounds over all contacts, and between them over those alone that still change: few do after the first.
    constexpr int rounds = 100;
    const double settled = 1e-6 * fastest;
    std::vector<char> changes(points.size(), 1);
    bool all = true;
    for (int round = 0; round < rounds; ++round) {
        double change = 0;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (!all && !changes[k]) continue;
            ContactPoint& c = points[k];
            Solving& s = solving[k];
            changes[k] = 0;
            Vec3 v = free[c.free].velocity_at(c.arm) - s.tree_velocity;
            if (c.body >= 0) v -= response.velocity(k, c.point);
            const double apart = c.normal.dot(v);
            const double before = s.normal_impulse;
            s.normal_impulse = std::max(0.0, before + s.along * (s.target - apart));
            const Vec3 sliding = v - apart * c.normal;
            const Vec3 last = s.friction;
            s.friction -= s.across * sliding;
            const double most = contact.friction * s.normal_impulse, size = s.friction.norm();
            if (size > most) s.friction *= size > 0 ? most / size : 0;
            const Vec3 impulse = (s.normal_impulse - before) * c.normal + s.friction - last;
            if (impulse.isZero(0)) continue;
            const double own = impulse.norm() / s.along;
            changes[k] = own > settled;
            change = std::max(change, own);
            push(free[c.free], c.arm, impulse);
            if (c.body >= 0) response.apply_impulse(k, c.point, -impulse);
        }
        if (change > settled)
            all = false;
        else if (all)
            break;
        else
            all = true;
    }
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k].impulse = solving[k].normal_impulse * points[k].normal + solving[k].friction;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void find_contacts(const Tree&, const NearPairs<T>&, std::span<const NearPair>, TreeWay<T>,               \
                                const Contact&, const FreeBody&, std::size_t, const FreeMotion&,                       \
                                std::vector<ContactPoint>&, ContactTests&);                                            \
    template void find_contacts(const Plan<T>&, const Tree&, const Subtrees&, TreeWay<T>, const Contact&,              \
                                const FreeBody&, std::size_t, const FreeMotion&, bool, std::vector<ContactPoint>&,     \
                                ContactTests&);                                                                        \
    template void solve_contacts(const Plan<T>&, TreePoses<T>&, const TreeResponse<T>&, const TreeResponse<T>&,        \
                                 const Contact&, std::vector<FreeBody>&, std::vector<ContactPoint>&);
#include "../base/instantiate.inc"

} // namespace bough
