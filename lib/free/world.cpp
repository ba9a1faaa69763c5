#include "world.h"
#include "../model/drawn_pose.h"
#include "../stages/external_forces.h"
#include "flight.h"
#include "landing.h"
#include <algorithm>
#include <bit>
#include <stdexcept>

namespace bough {
namespace {

// A free body on its way through the step.
struct Way {
    FreeMotion start, next;       // next: if nothing is met
    double first = 1;             // part of the step at which it meets something
    std::size_t from = 0, to = 0; // its contacts
};

constexpr double together = 0.05;                      // of a step: what is met so soon after the first is met with it
constexpr double slop = 1e-3;                          // [m] overlap that is left
constexpr double push_out = 0.2;                       // of the rest, a step
constexpr double quiet_speed = 0.02, quiet_time = 0.5; // [m/s], [s]

std::int64_t name_of(const FreeBody& free, std::size_t k, const Tree& tree) {
    return free.ball() ? std::int64_t(tree.size_bodies() + k) : free.parts.front().body;
}

template <class T> void fly_all(const Plan<T>& plan, World<T>& world, std::vector<Way>& ways) {
    const WindTable<double>* wind = plan.wind ? &world.wind : nullptr;
    const auto n = std::int64_t(world.free.size());
#pragma omp parallel for schedule(static) if (n > 500)
    for (std::int64_t k = 0; k < n; ++k) {
        const FreeBody& free = world.free[std::size_t(k)];
        Way& way = ways[std::size_t(k)];
        way.start = way.next = free.motion;
        const bool lying = free.leaf() && free.quiet > 0; // lie_down turns it
        if (!free.at_rest && !lying) way.next = fly(free, plan.scene, wind, plan.dt);
    }
}

// All that each meets, and how fast it may still come nearer to what it meets after the first.
template <class T> std::vector<ContactPoint> meet_all(const Plan<T>& plan, World<T>& world, std::vector<Way>& ways) {
    std::vector<ContactPoint> points;
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        FreeBody& free = world.free[k];
        Way& way = ways[k];
        way.from = way.to = points.size();
        if (free.at_rest || (free.leaf() && !world.contact.leaves)) continue;
        find_contacts(plan, *world.tree, world.subtrees, TreeWay<T>{world.before, world.poses}, world.contact, free, k,
                      way.next, world.brute_force, points, world.counts.tests);
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

// Where the rest of the way from `x` leads to: up to what is met next, trees where they are after the step, and was not met already.
template <class T>
Vec3 go_on(const Plan<T>& plan, World<T>& world, std::size_t k, const Vec3& x, const Vec3& d,
           const std::vector<ContactPoint>& points, const Way& way) {
    std::vector<ContactPoint> next;
    FreeBody& free = world.free[k];
    const Vec3 start = free.motion.x;
    free.motion.x = x;
    FreeMotion end = free.motion;
    end.x = x + d;
    find_contacts(plan, *world.tree, world.subtrees, TreeWay<T>{world.poses, world.poses}, world.contact, free, k, end,
                  world.brute_force, next, world.counts.tests);
    free.motion.x = start;
    double part = 1;
    for (const ContactPoint& c : next) {
        const bool known =
            std::any_of(points.begin() + std::ptrdiff_t(way.from), points.begin() + std::ptrdiff_t(way.to),
                        [&](const ContactPoint& p) { return p.body == c.body; });
        if (!known && c.normal.dot(d) < 0) part = std::min(part, c.way);
    }
    return x + part * d;
}

// Its motion at the step's end, now that its velocity is known.
template <class T>
void finish_way(const Plan<T>& plan, World<T>& world, std::size_t k, const Way& way,
                const std::vector<ContactPoint>& points) {
    FreeBody& free = world.free[k];
    const Vec3 v = free.motion.v, omega = free.motion.omega;
    free.motion = way.next;
    if (way.from == way.to) return;
    const double h = plan.dt, left = h * (1 - way.first);
    const Vec3 d = way.next.x - way.start.x, x = way.start.x + way.first * d;
    Vec3 end = go_on(plan, world, k, x, Vec3((1 - way.first) * d + left * (v - way.next.v)), points, way);
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
    free.quiet = quiet && lies ? free.quiet + h : 0;
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

// Contacts, impulses, and where all are after the step.
template <class T>
std::vector<ContactPoint> meet_and_go(const Plan<T>& plan, State<T>& state, World<T>& world, std::vector<Way>& ways) {
    std::vector<ContactPoint> points = meet_all(plan, world, ways);
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
    for (std::size_t k = 0; k < ways.size(); ++k) finish_way(plan, world, k, ways[k], points);
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

// A body that leaves in the step in which it was met was no part of its tree any more: the impulse, which was the tree's to answer, is taken
// back, and the two free bodies meet as such. first: of the new pieces.
template <class T>
void meet_pieces(State<T>& state, World<T>& world, const std::vector<ContactPoint>& points, std::size_t first) {
    std::erase_if(state.loads, [&](const Load<T>& load) { return world.remaining.gone[load.body] != 0; });
    const auto holds = [](const FreeBody& piece, std::int64_t body) {
        return std::any_of(piece.parts.begin(), piece.parts.end(),
                           [body](const FreePart& part) { return part.body == body; });
    };
    for (const ContactPoint& c : points) {
        if (c.body < 0 || !world.remaining.gone[std::size_t(c.body)]) continue;
        FreeBody& free = world.free[c.free];
        const auto piece = std::find_if(world.free.begin() + std::ptrdiff_t(first), world.free.end(),
                                        [&](const FreeBody& p) { return holds(p, c.body); });
        push(free, c.arm, Vec3(-c.impulse));
        const Vec3 arm = c.point - piece->motion.x;
        const double approach = -c.normal.dot(Vec3(free.velocity_at(c.arm) - piece->velocity_at(arm)));
        if (!(approach > 0)) continue;
        const Mat3 W = mobility_of(free, c.arm) + mobility_of(*piece, arm);
        const Vec3 impulse = (1 + world.contact.restitution) * approach / c.normal.dot(W * c.normal) * c.normal;
        push(free, c.arm, impulse);
        push(*piece, arm, Vec3(-impulse));
    }
}

template <class T>
void break_joints(Plan<T>& plan, State<T>& state, World<T>& world, const std::vector<ContactPoint>& points) {
    std::vector<std::uint32_t> joints;
    std::erase_if(world.breakable, [&](const Breakable& joint) {
        const std::size_t i = joint.body;
        if (world.remaining.gone[i]) return true;
        // T^T makes a torque longer by up to half of pi.
        const Vec3 theta = world.poses.theta(i), rate = world.poses.theta_dot(i);
        const Vec3 K = plan.K[i].template cast<double>();
        const double beta = double(plan.beta[i]);
        if (!(1.6 * K.cwiseProduct(Vec3(theta + beta * rate)).norm() > joint.torque)) return false;
        const double torque = spring_torque(theta, rate, K, beta);
        if (!(torque > joint.torque)) return false;
        joints.push_back(joint.body);
        ++world.counts.broke[std::size_t(world.tree->kind[i])];
        world.events.add("broke", std::int64_t(i), -1, torque);
        return true;
    });
    if (joints.empty()) return;
    for (FreeBody& piece : pieces_of(plan, *world.tree, world.subtrees, world.poses, joints))
        world.free.push_back(std::move(piece));
    detach(plan, state, world.subtrees, joints, world.remaining);
    meet_pieces(state, world, points, world.free.size() - joints.size());
    world.broken.insert(world.broken.end(), joints.begin(), joints.end());
    if (!plan.contact) return;
    std::vector<std::size_t> path; // all that carried something that left, each once
    for (const std::uint32_t joint : joints)
        for (std::int64_t i = plan.parent[joint]; i >= 0 && !world.remaining.gone[std::size_t(i)];
             i = plan.parent[std::size_t(i)])
            path.push_back(std::size_t(i));
    std::sort(path.rbegin(), path.rend());
    path.erase(std::unique(path.begin(), path.end()), path.end());
    world.response.remake(plan, world.subtrees, path);
    world.rigid.remake(plan, world.subtrees, path);
}

// The walkers' loads of the step to come, and what they do in it.
template <class T> void tread(const Plan<T>& plan, State<T>& state, World<T>& world) {
    const double t = double(state.step) * plan.dt, end = double(state.step + 1) * plan.dt;
    const auto within = [&](double time) { return time > t && time <= end; };
    for (std::size_t k = 0; k < world.walkers.size(); ++k) {
        const Walk& walk = world.walkers[k];
        const auto name = std::int64_t(world.tree->size_bodies() + world.balls + k);
        for (const WalkLeg& leg : walk.legs) {
            if (!leg.leap) continue;
            if (within(leg.start + walk.push))
                world.events.add("leapt", name, std::int64_t(leg.pieces.front().body), leg.leave.norm());
            if (within(leg.end - walk.push))
                world.events.add("landed", name, std::int64_t(leg.pieces.back().body), leg.land.norm());
        }
        if (const std::optional<WalkerLoad> load = walker_load(walk, t, plan.dt))
            state.loads.push_back({load->body, load->point_b.template cast<T>(), load->force.template cast<T>()});
    }
}

} // namespace

template <class T> World<T> make_world(const Plan<T>& plan, const Tree& tree, const std::vector<TreeRange>& ranges) {
    World<T> world;
    const Scene& scene = plan.scene;
    if (!has_free_bodies(scene)) return world;
    world.tree = &tree;
    world.contact = scene.contact.value_or(Contact());
    world.balls = scene.balls.size();
    for (const Ball& ball : scene.balls) world.free.push_back(free_ball(ball, scene.air_density));
    if (scene.fracture) {
        world.breakable = breakable_joints(tree, ranges, *scene.fracture);
        world.remaining = whole_tree(plan, tree);
    }
    if (scene.fracture && !scene.walkers.empty())
        throw std::domain_error("walkers: not with /fracture, which may break off what they walk on");
    for (std::size_t k = 0; k < scene.walkers.size(); ++k)
        world.walkers.push_back(
            make_walk(tree, ranges, scene.walkers[k], scene.gravity, "/walkers/" + std::to_string(k)));
    if (scene.fracture || plan.contact) world.subtrees = make_subtrees(tree, plan.contact);
    if (plan.contact) {
        world.response.make(plan, tree, world.subtrees);
        world.rigid.make(plan, tree, world.subtrees, false);
    }
    if (plan.wind) world.wind = make_wind_table<double>(*scene.wind, plan.top, plan.reach);
    return world;
}

template <class T> void advance(Plan<T>& plan, State<T>& state, World<T>& world, StageClock* clock) {
    if (!world.on()) return advance(plan, state, clock);
    const double middle = (double(state.step) + 0.5) * plan.dt;
    const bool moves = std::any_of(world.free.begin(), world.free.end(), [](const FreeBody& f) { return !f.at_rest; });
    if (moves && plan.contact) run_stage(Stage::contacts, state, clock, [&] { world.before.begin_copy(plan, state); });
    if (!world.walkers.empty()) run_stage(Stage::walkers, state, clock, [&] { tread(plan, state, world); });
    advance(plan, state, clock);
    state.loads.clear();
    std::vector<ContactPoint> points;
    if (moves) {
        std::vector<Way> ways(world.free.size());
        run_stage(Stage::free_flight, state, clock, [&] {
            if (plan.wind) evaluate_wind(*plan.scene.wind, middle, world.wind);
            fly_all(plan, world, ways);
        });
        run_stage(Stage::contacts, state, clock, [&] {
            world.poses.begin(plan, state);
            points = meet_and_go(plan, state, world, ways);
            come_to_ground(plan, world);
        });
    }
    if (!plan.scene.fracture) return;
    run_stage(Stage::fracture, state, clock, [&] {
        world.poses.begin(plan, state);
        break_joints(plan, state, world, points);
    });
}

template <class T> std::size_t World<T>::bytes() const {
    std::size_t parts = 0;
    for (const FreeBody& body : free) parts += body.parts.capacity() * sizeof(FreePart);
    return free.capacity() * sizeof(FreeBody) + parts + breakable.capacity() * sizeof(Breakable) +
           remaining.gone.capacity() + remaining.c_mass.capacity() * sizeof(double) +
           remaining.moment.capacity() * sizeof(Vec3) + response.bytes() + rigid.bytes() +
           sizeof(std::uint32_t) * (subtrees.first_child.capacity() + subtrees.child.capacity()) +
           sizeof(float) * subtrees.reach.capacity();
}

template <class T> std::optional<std::size_t> first_non_finite(const World<T>& world) {
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        const FreeMotion& m = world.free[k].motion;
        if (!(m.x.allFinite() && m.v.allFinite() && m.omega.allFinite() && m.q.coeffs().allFinite())) return k;
    }
    return std::nullopt;
}

template <class T> void place_free_bodies(const World<T>& world, MotionFrame& frame) {
    if (!world.on()) return;
    const std::size_t bodies = world.tree->size_bodies();
    for (auto* array :
         {&frame.position, &frame.velocity, &frame.angular_velocity, &frame.torque, &frame.theta, &frame.theta_dot})
        if (!array->empty()) array->resize(bodies + world.balls + world.walkers.size(), Vec3::Zero());
    if (!frame.rotation.empty()) frame.rotation.resize(bodies + world.balls + world.walkers.size(), Quat::Identity());
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        const FreeBody& free = world.free[k];
        const FreeMotion& m = free.motion;
        for (const FreePart& part : free.parts) {
            const std::size_t i = free.ball() ? bodies + k : std::size_t(part.body);
            if (!frame.position.empty()) frame.position[i] = m.x + m.q * part.joint;
            if (!frame.rotation.empty()) {
                frame.rotation[i] = (m.q * part.q).normalized();
                if (frame.rotation[i].w() < 0) frame.rotation[i].coeffs() *= -1;
            }
            if (!frame.velocity.empty()) frame.velocity[i] = free.velocity_at(Vec3(m.q * part.com));
            if (!frame.angular_velocity.empty()) frame.angular_velocity[i] = m.omega;
        }
    }
    for (std::size_t k = 0; k < world.walkers.size(); ++k) {
        const std::size_t i = bodies + world.balls + k;
        const WalkerPlace place = walker_place(world.walkers[k], frame.time);
        const auto at = [&](std::size_t body, const Vec3& point_b) {
            return Vec3(frame.position[body] + frame.rotation[body] * point_b);
        };
        if (!frame.position.empty())
            frame.position[i] = (1 - place.part) * at(place.body, place.point_b) +
                                place.part * at(place.next, place.next_b) + place.bow;
        if (!frame.velocity.empty()) frame.velocity[i] = walker_velocity(world.walkers[k], frame.time);
    }
    frame.events = world.events;
}

std::vector<Ball> shown_balls(const Tree& tree, const Scene& scene, const std::vector<Walk>& walkers) {
    std::vector<Ball> balls = scene.balls;
    if (walkers.empty()) return balls;
    const auto [R_wb, x_w] = drawn_pose(tree);
    for (const Walk& walk : walkers) {
        const WalkerPlace place = walker_place(walk, 0);
        balls.push_back({Vec3(x_w[place.body] + R_wb[place.body] * place.point_b), Vec3::Zero(), Vec3::Zero(),
                         walk.radius, walk.mass});
    }
    return balls;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template struct World<T>;                                                                                          \
    template World<T> make_world(const Plan<T>&, const Tree&, const std::vector<TreeRange>&);                          \
    template void advance(Plan<T>&, State<T>&, World<T>&, StageClock*);                                                \
    template std::optional<std::size_t> first_non_finite(const World<T>&);                                             \
    template void place_free_bodies(const World<T>&, MotionFrame&);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough
