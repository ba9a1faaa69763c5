#include "meeting.h"
#include "../base/parallel.h"
#include "flight.h"
#include "landing.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double together = 0.05;                      // of a step: what is met so soon after the first is met with it
constexpr double slop = 1e-3;                          // [m] overlap that is left
constexpr double push_out = 0.2;                       // of the rest, a step
constexpr double quiet_speed = 0.02, quiet_time = 0.5; // [m/s], [s]

std::int64_t name_of(const FreeBody& free, std::size_t k, const Tree& tree) {
    return free.ball() ? std::int64_t(tree.size_bodies() + k) : free.parts.front().body;
}

// One search for each free body in turn, in their order; pairs: of those that are looked for, where many fly.
template <class T>
void find_next(const Plan<T>& plan, World<T>& world, std::span<const NearPair>& pairs, TreeWay<T> tree_way,
               std::size_t k, const FreeMotion& end, std::vector<ContactPoint>& found) {
    if (!world.many)
        return find_contacts(plan, *world.tree, world.subtrees, tree_way, world.contact, world.free[k], k, end,
                             world.brute_force, found, world.counts.tests);
    std::size_t own = 0; // they are in the free bodies' order
    while (own < pairs.size() && pairs[own].free == k) ++own;
    find_contacts(*world.tree, world.near, pairs.first(own), tree_way, world.contact, world.free[k], k, end, found,
                  world.counts.tests);
    pairs = pairs.subspan(own);
}

template <class T>
std::span<const NearPair> pairs_of(const Plan<T>& plan, State<T>& state, World<T>& world,
                                   const std::vector<std::optional<FreeMotion>>& ends) {
    if (!world.many) return {};
    return world.near.find(plan, state, *world.tree, world.contact, world.free, ends);
}

// All that each meets, and how fast it may still come nearer to what it meets after the first.
template <class T>
std::vector<ContactPoint> meet_all(const Plan<T>& plan, State<T>& state, World<T>& world, std::vector<Way>& ways) {
    std::vector<ContactPoint> points;
    std::vector<std::optional<FreeMotion>> ends;
    for (const Way& way : ways) ends.push_back(way.next);
    std::span<const NearPair> pairs = pairs_of(plan, state, world, ends);
    const TreeWay<T> tree_way{world.before, world.poses};
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        FreeBody& free = world.free[k];
        Way& way = ways[k];
        way.from = way.to = points.size();
        if (free.at_rest || (free.leaf() && !world.contact.leaves)) continue;
        find_next(plan, world, pairs, tree_way, k, way.next, points);
        for (std::size_t c = way.from; c < points.size(); ++c) way.first = std::min(way.first, points[c].way);
        const double left = plan.dt * (1 - way.first);
        for (std::size_t c = way.from; c < points.size(); ++c) {
            ContactPoint& p = points[c];
            if (p.way <= way.first + together || !(p.way < 1)) continue;
            p.free_speed = (p.way - way.first) * p.closing / (1 - p.way) / left;
        }
        way.to = points.size();
    }
    return points;
}

// Where the rest of each way leads to that met something, at the velocity after it: up to what is met next, trees where they are after the step, and
// was not met already. All are looked for at once, as a fallen tree has thousands of parts. Moves the bodies to where they first met something.
template <class T>
std::vector<Vec3> go_on(const Plan<T>& plan, State<T>& state, World<T>& world, const std::vector<ContactPoint>& points,
                        const std::vector<Way>& ways) {
    std::vector<Vec3> to(ways.size(), Vec3::Zero()), rest = to;
    std::vector<std::optional<FreeMotion>> ends(ways.size());
    if (points.empty()) return to;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        const Way& way = ways[k];
        if (way.from == way.to) continue;
        FreeMotion& motion = world.free[k].motion;
        const Vec3 d = way.next.x - way.start.x;
        rest[k] = (1 - way.first) * d + plan.dt * (1 - way.first) * (motion.v - way.next.v);
        motion.x = way.start.x + way.first * d;
        ends[k] = motion;
        ends[k]->x += rest[k];
    }
    std::span<const NearPair> pairs = pairs_of(plan, state, world, ends);
    std::vector<ContactPoint> next;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        const Way& way = ways[k];
        if (!ends[k]) continue;
        next.clear();
        find_next(plan, world, pairs, TreeWay<T>{world.poses, world.poses}, k, *ends[k], next);
        double part = 1;
        for (const ContactPoint& c : next) {
            const bool known =
                std::any_of(points.begin() + std::ptrdiff_t(way.from), points.begin() + std::ptrdiff_t(way.to),
                            [&](const ContactPoint& p) { return p.body == c.body; });
            if (!known && c.normal.dot(rest[k]) < 0) part = std::min(part, c.way);
        }
        to[k] = world.free[k].motion.x + part * rest[k];
    }
    return to;
}

// Its motion at the step's end, now that its velocity is known. end: where it goes on to, if it met something.
template <class T>
void finish_way(const Plan<T>& plan, World<T>& world, std::size_t k, const Way& way, Vec3 end,
                const std::vector<ContactPoint>& points) {
    FreeBody& free = world.free[k];
    const Vec3 v = free.motion.v, omega = free.motion.omega;
    free.motion = way.next;
    if (way.from == way.to) return;
    bool lies = true; // on the ground alone, and not in it
    for (std::size_t c = way.from; c < way.to; ++c) {
        const ContactPoint& p = points[c];
        lies = lies && p.body < 0 && p.gap > -2 * slop;
        // Not behind the point that was met, and of an overlap a part less.
        const double least = p.gap < -slop ? p.gap + push_out * (-p.gap - slop) : std::min(0.0, p.gap);
        const double beyond = least - p.gap - p.normal.dot(Vec3(end + p.arm - p.point));
        if (!(beyond > 0)) continue;
        world.counts.pushed_out += p.gap < -slop;
        world.counts.lifted -= beyond * free.mass * plan.scene.gravity.dot(p.normal);
        end += beyond * p.normal;
    }
    free.motion.x = end;
    free.motion.v = v;
    free.motion.omega = omega;
    const bool quiet = v.norm() < quiet_speed && omega.norm() * free.bound < quiet_speed;
    free.quiet = quiet && lies ? free.quiet + plan.dt : 0;
    if (free.quiet < quiet_time) return;
    free.at_rest = true;
    free.motion.v = free.motion.omega = Vec3::Zero();
}

template <class T>
void load_trees(const Plan<T>& plan, State<T>& state, const std::vector<ContactPoint>& points,
                const std::vector<Vec3>& on_tree) {
    for (std::size_t c = 0; c < points.size(); ++c) {
        if (points[c].body < 0 || on_tree[c].isZero(0)) continue;
        const auto body = std::size_t(points[c].body);
        state.loads.push_back(
            {body, points[c].point_b.template cast<T>(), Vec3(on_tree[c] / plan.dt).template cast<T>()});
    }
}

template <class T> void note_hits(const Plan<T>& plan, World<T>& world, const std::vector<ContactPoint>& points) {
    const double slow = 2 * plan.scene.gravity.norm() * plan.dt;
    for (const ContactPoint& c : points) {
        world.counts.impulse += c.impulse.norm();
        if (!(c.approach > slow) || c.impulse.isZero(0)) continue;
        ++world.counts.hits;
        world.events.add("hit", name_of(world.free[c.free], c.free, *world.tree), c.body, c.impulse.norm());
    }
}

// The paper's pair, first half: zeta (v_rel . n) n on the tree, while they approach; the ground is met by an impulse as always.
template <class T>
std::vector<Vec3> penalties(const Plan<T>& plan, World<T>& world, std::vector<ContactPoint>& points) {
    std::vector<Vec3> on_tree(points.size(), Vec3::Zero());
    for (std::size_t k = 0; k < points.size(); ++k) {
        ContactPoint& c = points[k];
        if (c.body < 0) continue;
        const Vec3 v = world.free[c.free].velocity_at(c.arm) - world.poses.of(std::size_t(c.body)).velocity_at(c.point);
        c.approach = -v.dot(c.normal);
        on_tree[k] = -plan.dt * world.contact.penalty * std::max(0.0, c.approach) * c.normal;
    }
    return on_tree;
}

// Second half: what makes the free body's velocity the tree's, where that pushes it away.
template <class T>
void match_velocities(World<T>& world, std::vector<ContactPoint>& points, const std::vector<Vec3>& on_tree) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        ContactPoint& c = points[k];
        if (c.body < 0) continue;
        FreeBody& free = world.free[c.free];
        const Vec3 tree = world.poses.of(std::size_t(c.body)).velocity_at(c.point);
        const double apart = c.normal.dot(Vec3(free.velocity_at(c.arm) - tree));
        c.impulse = std::max(0.0, -apart / c.normal.dot(mobility_of(free, c.arm) * c.normal)) * c.normal;
        push(free, c.arm, c.impulse);
        world.counts.imbalance += (c.impulse + on_tree[k]).norm();
    }
}

// Rolling resistance: the ground pushes a lever of rolling x bound off the point below the centre, against the turning and no more than stops it.
template <class T> void resist_rolling(World<T>& world, const std::vector<ContactPoint>& points) {
    for (const ContactPoint& c : points) {
        FreeBody& free = world.free[c.free];
        const double spin = free.motion.omega.norm(), push = c.impulse.dot(c.normal);
        if (c.body >= 0 || !(push > 0) || !(spin > 0)) continue;
        const Vec3 axis = free.motion.omega / spin;
        const double slower = world.contact.rolling * free.bound * push * axis.dot(free.inverse_inertia_w() * axis);
        free.motion.omega -= std::min(slower, spin) * axis;
    }
}

} // namespace

template <class T> void fly_all(const Plan<T>& plan, World<T>& world, std::vector<Way>& ways) {
    const WindTable<double>* wind = plan.wind ? &world.wind : nullptr;
    parallel_for(world.free.size(), 300, [&](std::size_t k) {
        const FreeBody& free = world.free[k];
        Way& way = ways[k];
        way.start = way.next = free.motion;
        const bool lying = free.leaf() && free.quiet > 0; // lie_down turns it
        if (!free.at_rest && !lying) way.next = fly(free, plan.scene, wind, plan.dt);
    });
}

template <class T>
std::vector<ContactPoint> meet_and_go(const Plan<T>& plan, State<T>& state, World<T>& world, std::vector<Way>& ways) {
    std::vector<ContactPoint> points = meet_all(plan, state, world, ways);
    for (std::size_t k = 0; k < ways.size(); ++k) { // turned, and as fast, as they would be: omega is of that q
        world.free[k].motion = ways[k].next;
        world.free[k].motion.x = ways[k].start.x;
    }
    std::vector<Vec3> on_tree;
    if (world.contact.model == ContactModel::penalty) {
        on_tree = penalties(plan, world, points);
        std::vector<ContactPoint> ground;
        for (const ContactPoint& c : points)
            if (c.body < 0) ground.push_back(c);
        solve_contacts(plan, world.poses, world.response, world.rigid, world.contact, world.free, ground);
        std::size_t next = 0;
        for (ContactPoint& c : points)
            if (c.body < 0) c = ground[next++];
        match_velocities(world, points, on_tree);
    } else {
        solve_contacts(plan, world.poses, world.response, world.rigid, world.contact, world.free, points);
        for (const ContactPoint& c : points) on_tree.push_back(-c.impulse);
    }
    if (world.contact.rolling > 0) resist_rolling(world, points);
    load_trees(plan, state, points, on_tree);
    note_hits(plan, world, points);
    const std::vector<Vec3> ends = go_on(plan, state, world, points, ways);
    for (std::size_t k = 0; k < ways.size(); ++k) finish_way(plan, world, k, ways[k], ends[k], points);
    return points;
}

template <class T> void come_to_ground(const Plan<T>& plan, World<T>& world) {
    if (!world.contact.ground) return;
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        FreeBody& free = world.free[k];
        if (!free.leaf() || free.at_rest) continue;
        const double speed = free.motion.v.norm();
        if (!lie_down(free, world.contact.ground_height, plan.dt)) continue;
        ++world.counts.landed;
        world.events.add("landed", name_of(free, k, *world.tree), -1, speed);
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void fly_all(const Plan<T>&, World<T>&, std::vector<Way>&);                                               \
    template std::vector<ContactPoint> meet_and_go(const Plan<T>&, State<T>&, World<T>&, std::vector<Way>&);           \
    template void come_to_ground(const Plan<T>&, World<T>&);
#include "../base/instantiate.inc"

} // namespace bough
