// run_choice.h: simulations made otherwise than their constructor makes them, for tools and studies: of trees that were assembled one by one, by any
// stepper, without what is not read. It is not installed.
#pragma once
#include "assembly.h"
#include "run_types.h"
#include <functional>

namespace bough {

class Simulation;
template <class T> class Stepper;

// Makes the steppers of a run, in place of those that the options' method names. A maker that lacks a precision is never asked for it.
struct StepperMaker {
    std::function<std::unique_ptr<Stepper<float>>(const Assembly&)> single;
    std::function<std::unique_ptr<Stepper<double>>(const Assembly&)> double_;
};

// How a run is made, beyond the options that every user has.
struct RunChoice {
    SimulationOptions options;
    StepperMaker steppers{}; // empty: by options.method, portable and sleep
    bool poses = true;       // Wishes::pose
    bool saves = true;       // save() and restore() are called
    // Else, where nothing is free, the assembly's tree keeps only what make_plan says, which saves memory
    bool keeps_trees = true;
};

// The assembly stays the caller's and the run's. Throws SceneError.
Simulation make_simulation(std::shared_ptr<Assembly>, const RunChoice&);

} // namespace bough
