// solvers.h: every solver by its name, those among them that others are held against.
#pragma once
#include "../coupled/scheme.h"
#include "../lanes/target.h"
#include "../plan/make_plan.h"
#include "../plan/state.h"
#include <optional>

namespace bough {

// coupled                coupled_step.h: the full dynamics, one linear solve a step
// analytic               analytic_step.h: the paper's, one joint at a time
// articulated_explicit   articulated_step.h, Euler forward
// articulated_implicit   articulated_step.h, linearly implicit
// articulated_reference  extrapolation.h, to a tolerance
// The articulated ones exist in double alone.
enum class Solver : std::uint8_t {
    coupled,
    analytic,
    articulated_explicit,
    articulated_implicit,
    articulated_reference
};
constexpr std::array<Solver, 5> all_solvers{Solver::coupled, Solver::analytic, Solver::articulated_explicit,
                                            Solver::articulated_implicit, Solver::articulated_reference};
const char* solver_name(Solver); // as in --solver: coupled, analytic, articulated-explicit ...
constexpr bool is_articulated(Solver solver) {
    return solver != Solver::analytic && solver != Solver::coupled;
}

// A scene for any solver: those that have these terms by nature get it without, where make_plan would refuse it.
inline Scene for_solver(Scene scene, Solver solver) {
    if (solver != Solver::analytic) scene.fictitious.reset();
    return scene;
}

struct SolverChoice {
    Solver solver = Solver::analytic;
    Scheme scheme = Scheme::p12; // of coupled
    // Lanes, where they hold all that the scene has; none: the plain path
    std::optional<fast::Target> simd = std::nullopt;
    double sleep = 0;        // [rad/s] coupled/sleep.h; 0: never
    double tolerance = 1e-8; // [rad] allowed in a step of articulated_reference (extrapolation.h)
};

// Throws std::logic_error for an articulated solver in float.
template <class T> std::unique_ptr<Stepper<T>> make_stepper(const SolverChoice&, const Scene&);

// The same for a simulation, of a part of a scene as of the whole.
struct StepperMaker; // simulation/run_choice.h
StepperMaker stepper_maker(const SolverChoice&);

// Throws std::domain_error for what of a scene a solver cannot hold.
void refuse(Solver, const Scene&);

// make_plan with any solver. tree: const Tree& or Tree&&, as make_plan takes it.
template <class T, class TreeType>
Plan<T> make_plan(TreeType&& tree, const std::vector<TreeRange>& ranges, const Scene& scene, const Wishes& wishes,
                  double dt, Solver solver, Scheme scheme = Scheme::p12,
                  std::optional<fast::Target> simd = std::nullopt, double sleep = 0, double tolerance = 1e-8) {
    return make_plan<T>(std::forward<TreeType>(tree), ranges, scene, wishes, dt,
                        make_stepper<T>({solver, scheme, simd, sleep, tolerance}, scene));
}

} // namespace bough
