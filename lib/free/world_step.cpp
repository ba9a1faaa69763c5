#include "world_step.h"
#include "../plan/pushes.h"
#include "breaking.h"
#include "meeting.h"
#include <algorithm>

namespace bough {
namespace {

// The walkers' loads of the step to come, and what they do in it.
template <class T> void tread(const Plan<T>& plan, State<T>& state, World<T>& world) {
    const double t = time_of(plan, state), end = time_of(plan, state, 1);
    const bool first = state.step == 0; // the start is in no step before it
    const auto within = [&](double time) { return (time > t || (first && time == t)) && time <= end; };
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

// Whether looking at every body once takes less than looking along the trees for each that flies.
template <class T> bool many_fly(const Plan<T>& plan, const World<T>& world) {
    constexpr std::size_t along = 250; // a search along the tree takes about the time of looking at so many bodies once
    if (world.brute_force) return false;
    std::size_t fly = 0;
    for (const FreeBody& free : world.free)
        if (!free.at_rest && (world.contact.leaves || !free.leaf())) fly += free.parts.size();
    return fly * along > plan.bodies;
}

} // namespace

template <class T> void advance(Plan<T>& plan, State<T>& state, World<T>& world, StageClock* clock) {
    if (!world.on()) return advance(plan, state, clock);
    const double middle = time_of(plan, state, 0.5);
    const bool moves = std::any_of(world.free.begin(), world.free.end(), [](const FreeBody& f) { return !f.at_rest; });
    world.many = plan.contact && many_fly(plan, world);
    if (moves && plan.contact)
        run_stage(Stage::contacts, state, clock, [&] {
            world.before.begin_copy(plan, state);
            if (world.many) world.near.begin(plan, state, *world.tree, world.subtrees);
        });
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

#define BOUGH_INSTANTIATE(T) template void advance(Plan<T>&, State<T>&, World<T>&, StageClock*);
#include "../base/instantiate.inc"

} // namespace bough
