// run.h: one run, step after step: plan, state, and what is free beside the trees. any_run.h builds on it what simulation.h needs.
#pragma once
#include "../free/world.h"
#include "../lanes/target.h"
#include "../plan/make_plan.h"
#include "assembly.h"
#include "method.h"
#include <optional>

namespace bough {

// How the steps are made.
struct StepChoice {
    Method method = Method::coupled;
    std::optional<fast::Target> simd; // SIMD lanes for it, where they hold all that the scene has; none: the plain path
    double sleep = 0; // [rad/s] the rate below which what has settled is left out of steps (coupled/sleep.h)
};

// Takes away what a part of a scene must not do because the whole would not: its trees share blocks with others, and the ground of some may move.
// Choice: has simd and sleep, as StepChoice has.
template <class Choice> void keep_to_the_whole(const Part& part, bool analytic, Choice& choice) {
    if (part.parts > 1 || part.moved) choice.sleep = 0;
    if (part.moved && analytic) choice.simd.reset(); // as for the whole
}

// Makes the stepper of the coupled or the analytic method.
template <class T> std::unique_ptr<Stepper<T>> stepper_of(const Assembly&, StepChoice);

// Makes a plan for steps of dt [s]. Throws SceneError. An assembly that is handed over keeps of its tree only what make_plan says, which saves
// memory.
template <class T> Plan<T> plan_run(const Assembly&, const Wishes&, double dt, std::unique_ptr<Stepper<T>>);
template <class T> Plan<T> plan_run(Assembly&&, const Wishes&, double dt, std::unique_ptr<Stepper<T>>);

template <class T> struct Run {
    Plan<T> plan;
    State<T> state;
    World<T> world;
};

// Makes a run at its start. Keeps a reference to the assembly's tree where the scene has something free. Throws SceneError.
template <class T> Run<T> start_run(Plan<T> plan, const Assembly&);

// Called after a step. Returns "", or where the run became non-finite: "stage spring (theta), body 17 (branch 3)". Brings arrays up to date as
// needed.
template <class T> std::string non_finite(Run<T>&, const Tree&);

// Fills in the arrays that `fields` asks for, in the precision of frames, from a state that is up to date (present()). Returns the first body whose
// numbers are non-finite, if there is one. Allocates nothing once the frame has grown.
template <class T>
std::optional<std::size_t> fill_frame(const Plan<T>&, const State<T>&, const MotionFields& fields, MotionFrame&);

// Extends a frame of the run to all bodies: those that are held, what fell, balls and walkers.
template <class T> void show_all(const Assembly&, const Run<T>&, MotionFrame&);

} // namespace bough
