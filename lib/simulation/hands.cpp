#include "hands.h"
#include "../coupled/attachment.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../coupled/coupled_stepper.h"
#include "scene_error.h"
#include <string>

namespace bough {

template <class T> bool has_broken_off(const Run<T>& run, std::size_t body) {
    const std::vector<std::uint8_t>& gone = run.world.remaining.gone;
    return body < gone.size() && gone[body];
}

template <class T>
std::uint64_t attach_hand(Run<T>& run, const Assembly& assembly, std::size_t body, const Vec3& point, double stiffness,
                          double damping) {
    present(run.plan, run.state);
    std::size_t on = body;
    Vec3 there = point;
    if (assembly.whole) {
        const Reduced& places = assembly.whole->places;
        if (places.body[body] < 0)
            throw SceneError("attach: body " + std::to_string(body) + " stands still (/simulate, /rigid)");
        on = std::size_t(places.body[body]);
        there = places.offset[body] + places.rotation[body] * point;
    }
    if (has_broken_off(run, on)) throw SceneError("attach: body " + std::to_string(body) + " has broken off");
    if (!run.plan.pose) throw SceneError("attach: this run keeps no poses");
    const Vec3 target = run.state.x_w[on].template cast<double>() + run.state.R_wb[on].template cast<double>() * there;
    const std::uint64_t number = attach(run.plan, coupled_state(run.state), on, there, stiffness, damping, target);
    run.plan.stepper->change(run.plan, run.state, {.attachments = true});
    return number;
}

template <class T> std::vector<Attached> hands_of(const Run<T>& run) {
    std::vector<Attached> hands;
    if (fast::coupled_plan(run.plan))
        for (const Attached& held : coupled_state(run.state).attachments.all)
            if (held.planned < 0) hands.push_back(held);
    return hands;
}

template <class T> void adopt_hand(Run<T>& run, const Attached& hand, std::size_t body) {
    adopt(run.plan, coupled_state(run.state), hand, body);
    run.plan.stepper->change(run.plan, run.state, {.attachments = true});
}

template <class T> void release_hand(Run<T>& run, std::uint64_t number) {
    release(run.plan, coupled_state(run.state), number);
    run.plan.stepper->change(run.plan, run.state, {.attachments = true});
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template bool has_broken_off(const Run<T>&, std::size_t);                                                          \
    template std::uint64_t attach_hand(Run<T>&, const Assembly&, std::size_t, const Vec3&, double, double);            \
    template std::vector<Attached> hands_of(const Run<T>&);                                                            \
    template void adopt_hand(Run<T>&, const Attached&, std::size_t);                                                   \
    template void release_hand(Run<T>&, std::uint64_t);
#include "../base/instantiate.inc"

} // namespace bough
