// What a run says of itself: its events and what broke, its bodies and what is thrown at them, its trees as they stand, its plan.
#include "handle.h"
#include <algorithm>

using namespace bough;
using namespace bough::c;

namespace {

std::int32_t number_of(const std::string& event) {
    return event == "broke" ? BOUGH_BROKE : event == "hit" ? BOUGH_HIT : event == "landed" ? BOUGH_LANDED : BOUGH_LEAPT;
}

} // namespace

bough_result bough_read_events(bough_simulation* simulation, bough_events* events) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(events, "events");
        const MotionEvents& own = use->simulation.events();
        use->events.clear();
        for (const std::string& what : own.what) use->events.push_back(number_of(what));
        *events = {own.what.size(), use->events.data(), own.body.data(), own.on.data(), own.value.data()};
    });
}

bough_result bough_read_broken(bough_simulation* simulation, const uint32_t** bodies, size_t* count) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(bodies, "bodies");
        required(count, "count");
        const std::span<const std::uint32_t> own = use->simulation.broken();
        *bodies = own.data();
        *count = own.size();
    });
}

bough_result bough_simulation_balls(bough_simulation* simulation, bough_balls* balls) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(balls, "balls");
        if (use->radius.empty())
            for (const Ball& ball : use->simulation.balls()) {
                use->radius.push_back(ball.radius);
                use->mass.push_back(ball.mass);
            }
        *balls = {use->radius.size(), use->simulation.tree().size_bodies(), use->radius.data(), use->mass.data()};
    });
}

bough_result bough_simulation_bodies(const bough_simulation* simulation, bough_bodies* bodies) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(bodies, "bodies") = bodies_of(use->simulation.tree(), use->first_body);
    });
}

bough_result bough_posed_tree(const bough_simulation* simulation, bough_tree** tree) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        required(tree, "tree");
        const std::span<const Vec3> angles = use->simulation.angles();
        if (!std::all_of(angles.begin(), angles.end(), [](const Vec3& v) { return v.allFinite(); }))
            throw NonFinite("the simulation is not finite, and no tree is made of it");
        *tree = static_cast<bough_tree*>(give(object_of(use->simulation.posed_tree())));
    });
}

const char* bough_explain(const bough_simulation* simulation) {
    const char* text = nullptr;
    call([&] {
        const Use<SimulationObject> use(simulation);
        use->explained = use->simulation.explain(); // in which the step stands
        text = use->explained.c_str();
    });
    return text;
}
