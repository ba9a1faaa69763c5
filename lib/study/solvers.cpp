#include "solvers.h"
#include "../analytic/analytic_lanes_stepper.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../simulation/run.h"
#include "../simulation/run_choice.h"
#include "articulated_stepper.h"
#include <stdexcept>

namespace bough {

const char* solver_name(Solver solver) {
    static constexpr const char* names[] = {"coupled", "analytic", "articulated-explicit", "articulated-implicit",
                                            "articulated-reference"};
    return names[std::size_t(solver)];
}

template <class T> std::unique_ptr<Stepper<T>> make_stepper(const SolverChoice& choice, const Scene& scene) {
    if (choice.solver == Solver::coupled)
        return fast::coupled_stepper<T>(scene, choice.scheme, choice.simd, choice.sleep);
    if (choice.solver == Solver::analytic) return fast::analytic_stepper<T>(scene, choice.simd, choice.sleep);
    const char* const name = solver_name(choice.solver);
    if constexpr (std::is_same_v<T, double>) {
        const ArticulatedMethod method =
            choice.solver == Solver::articulated_explicit   ? ArticulatedMethod::explicit_euler
            : choice.solver == Solver::articulated_implicit ? ArticulatedMethod::implicit_euler
                                                            : ArticulatedMethod::extrapolation;
        auto stepper = std::make_unique<ArticulatedStepper>(
            method, name, choice.simd ? std::string("solver ") + name : std::string("not asked for"));
        stepper->own.tolerance = choice.tolerance;
        return stepper;
    } else {
        throw std::logic_error(std::string("make_stepper: ") + name + " exists in double alone");
    }
}

void refuse(Solver solver, const Scene& scene) {
    make_stepper<double>({.solver = solver}, scene)->refuse(scene);
}

StepperMaker stepper_maker(const SolverChoice& choice) {
    const auto of = [choice](const Assembly& assembly) {
        SolverChoice kept = choice;
        keep_to_the_whole(assembly.part, choice.solver == Solver::analytic, kept);
        return kept;
    };
    return {[of](const Assembly& assembly) { return make_stepper<float>(of(assembly), assembly.scene); },
            [of](const Assembly& assembly) { return make_stepper<double>(of(assembly), assembly.scene); }};
}

#define BOUGH_INSTANTIATE(T) template std::unique_ptr<Stepper<T>> make_stepper(const SolverChoice&, const Scene&);
#include "../base/instantiate.inc"

} // namespace bough
