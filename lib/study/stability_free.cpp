#include "stability_free.h"
#include "../free/world_step.h"
#include "energy.h"
#include "solvers.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double excess_tolerance = 0.01;

template <class T> struct Conserved {
    double kinetic = 0, total = 0; // [J]
    Conserved(const Plan<T>& plan, const State<T>& state, const World<T>& world) {
        const Energy e = energy(plan, state);
        kinetic = e.bodies;
        total = e.bodies + e.elastic + e.potential;
        for (const FreeBody& free : world.free) {
            const Mat3 R = free.motion.q.toRotationMatrix();
            const Vec3 w = R.transpose() * free.motion.omega;
            const double own = free.mass * free.motion.v.squaredNorm() / 2 + w.dot(free.inertia * w) / 2;
            kinetic += own;
            total += own - free.mass * plan.scene.gravity.dot(free.motion.x);
        }
    }
};

// What walkers do to the trees in a step: their force times the way of the point it acts on.
template <class T> struct WalkersWork {
    struct Push {
        WalkerLoad load;
        Vec3 before; // [m]
    };
    std::vector<Push> pushes;
    static Vec3 pushed_point(const State<T>& state, const WalkerLoad& load) {
        return (state.x_w[load.body] + state.R_wb[load.body] * load.point_b.template cast<T>()).template cast<double>();
    }
    WalkersWork(const Plan<T>& plan, const State<T>& state, const World<T>& world) {
        for (const Walk& walk : world.walkers)
            if (const auto load = walker_load(walk, time_of(plan, state), plan.dt))
                pushes.push_back({*load, pushed_point(state, *load)});
    }
    double done(const State<T>& after) const { // [J]
        double work = 0;
        for (const Push& p : pushes) work += p.load.force.dot(pushed_point(after, p.load) - p.before);
        return work;
    }
};

template <class T>
void run(const StabilitySetup& setup, Solver solver, std::int64_t frames, const std::function<void()>& tick,
         StabilityCell& cell) {
    Plan<T> plan = make_plan<T>(setup.tree, setup.ranges, for_solver(setup.scene, solver), {}, setup.dt, solver,
                                Scheme::p12, setup.simd);
    State<T> state = make_state(plan);
    World<T> world = make_world(plan, setup.tree, setup.ranges);
    const Conserved<T> start(plan, state, world);
    double largest = start.kinetic, excess = 0, fastest = 0, work = 0;
    cell.finite = true;
    for (std::int64_t k = 0; k < frames && cell.finite; ++k) {
        tick();
        const WalkersWork<T> walkers(plan, state, world);
        advance(plan, state, world);
        present(plan, state);
        work += walkers.done(state);
        cell.frames = k + 1;
        cell.finite = !first_non_finite(state) && !first_non_finite(world);
        if (!cell.finite) break;
        for (const Vector3<T>& theta : state.theta) cell.max_angle = std::fmax(cell.max_angle, double(theta.norm()));
        for (const FreeBody& free : world.free) fastest = std::max(fastest, free.motion.v.norm());
        const Conserved<T> now(plan, state, world);
        largest = std::max(largest, now.kinetic);
        const double rounding = 256 * double(std::numeric_limits<T>::epsilon()) * std::abs(start.total);
        if (largest > 0)
            excess = std::max(excess, (now.total - start.total - work - std::max(0.0, world.counts.lifted) - rounding) /
                                          largest);
    }
    std::uint64_t broke = 0;
    for (const std::uint64_t n : world.counts.broke) broke += n;
    cell.guards =
        state.flags.bounded_lambda + state.flags.half_turns + state.flags.energy_guard + state.flags.fast_turns;
    cell.outside = cell.max_angle > 1;
    if (!cell.finite) {
        cell.note = "non-finite after " + std::to_string(cell.frames) + " steps";
        return;
    }
    const double fall = setup.scene.gravity.norm() * setup.dt * double(frames);
    double fair = fall;
    for (const Ball& ball : setup.scene.balls) fair = std::max(fair, ball.velocity.norm() + fall);
    if (solver == Solver::coupled) {
        cell.energy_drift = excess;
        cell.bounded = excess <= excess_tolerance;
        if (!cell.bounded) cell.note = "energy grows; ";
    } else {
        cell.bounded = fastest <= 10 * fair;
        if (!cell.bounded) cell.note = "something free is faster than it fell; ";
    }
    cell.note += std::to_string(broke) + " broke, " + std::to_string(world.counts.hits) + " hits";
}

} // namespace

void run_free_cell(const StabilitySetup& setup, Solver solver, bool single, std::int64_t frames,
                   const std::function<void()>& tick, StabilityCell& cell) {
    if (single)
        run<float>(setup, solver, frames, tick, cell);
    else
        run<double>(setup, solver, frames, tick, cell);
}

} // namespace bough
