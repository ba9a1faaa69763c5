// stepper.h: how steps are made, chosen once a run. A stepper is a solver behind one interface. It has its own constants (in the stepper, which a
// plan holds) and its own working data from step to step (StepperState, which a state holds). Plan and state know no more of solvers than this. A
// solver's own functions take its own types, so those of another solver cannot reach them.
//
// A step makes a few calls, none of them in a loop over bodies.
#pragma once
#include "../base/copied.h"
#include "../base/math.h"
#include "../model/motion.h"
#include "../model/scene.h"
#include "../model/tree.h"
#include "stage.h"
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bough {

template <class T> struct Plan;
template <class T> struct State;
struct PlanAccount;

// A solver's part of a state.
class StepperState {
public:
    virtual ~StepperState() = default;
    virtual std::unique_ptr<StepperState> clone() const = 0;
    virtual std::size_t bytes() const = 0; // as State::bytes() counts them
};

// An array that a solver carries from step to step, beside the angles and their rates. name: as in SavedState.
template <class T> struct CarriedArray {
    const char* name;
    std::vector<Vector3<T>>* array;
};

// Where the angles and rates of single bodies stand, wherever the solver keeps them. A body's numbers follow each other by `stride`.
template <class T> struct MotionView {
    const T *theta = nullptr, *theta_dot = nullptr; // of what `first` counts from
    std::size_t stride = 1;
    const std::uint32_t* slot = nullptr; // of each body; null: arrays in document order
    std::size_t lanes = 1;               // slots a row
    std::vector<std::size_t> first;      // of each row

    std::size_t at(std::size_t body) const {
        return slot ? first[slot[body] / lanes] * lanes + slot[body] % lanes : 3 * body;
    }
    Vec3 theta_of(std::size_t body) const { return three(theta + at(body)); }
    Vec3 theta_dot_of(std::size_t body) const { return three(theta_dot + at(body)); }

private:
    Vec3 three(const T* x) const { return {double(x[0]), double(x[stride]), double(x[2 * stride])}; }
};

// What first became non-finite: stage and array, and the body.
struct NonFinite {
    std::string what; // "spring (theta)"
    std::size_t body;
};

// What a stepper is from the start.
struct StepperKind {
    const char* name;               // as in --solver
    std::string plainly;            // why the run is not in lanes; empty where it is
    Stage stage = Stage::resolvent; // which writes the angles
    const char* scheme = "";        // as in --scheme
    bool reads_velocities = false;  // of all bodies, in each step
    // Each step in lanes places the points that are pulled or held. It does so by constants of bodies in document order, which are kept where poses
    // are.
    bool places_points = false;
};

// What the caller has changed between two steps.
template <class T> struct StepperChange {
    T stiffness = 1, damping = 1; // factors on all joints', which the plan's own have by now
    T step = 1;               // the plan's dt over the one before; the changes carried from the last step go with it
    bool attachments = false; // one came or went
    bool wake = false;        // what sleeps has to move
};

// What a body that stays carries, once something has broken off.
struct CarriedMoment {
    std::size_t body;
    Vec3 moment; // [kg m] body axes
};

template <class T> class Stepper {
public:
    explicit Stepper(StepperKind kind) : kind_(std::move(kind)) {}
    virtual ~Stepper() = default;
    virtual std::unique_ptr<Stepper> clone() const = 0;
    const StepperKind& kind() const { return kind_; }
    bool in_lanes() const { return kind_.plainly.empty(); }
    bool carries_moments() const { return carries_moments_; } // drop() is told of them

    // These are called while a plan is made, in this order.
    virtual void refuse(const Scene&) const {} // throws std::domain_error for what it cannot hold
    virtual void take_constants(const Plan<T>&,
                                const Tree&) = 0; // the tree is whole yet; the plan has the scene and c_mass
    virtual void lay_out(const Plan<T>&, const std::vector<TreeRange>&) {} // the plan has all of its bodies

    // Says which of its stages run and which of its own arrays states hold, and why (explain.h).
    virtual void explain(const Plan<T>&, PlanAccount&) const = 0;

    // Makes the solver's part of a state whose other arrays are there.
    virtual void allocate(const Plan<T>&, State<T>&) const = 0;
    // Brings kinematics, and what is kept outside the state's arrays, to theta [rad], the state's other arrays and its number of steps.
    virtual void begin(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const = 0;
    virtual void advance(const Plan<T>&, State<T>&, StageClock*) const = 0;
    // Brings the arrays in document order up to date.
    virtual void present(const Plan<T>&, State<T>&) const {}
    // Returns where the last step became non-finite. Presents the state unless the step itself has found all finite.
    virtual std::optional<NonFinite> non_finite(const Plan<T>&, State<T>&) const;
    virtual std::vector<CarriedArray<T>> carried(State<T>&) const = 0;
    // Save and restore what is saved beside the carried arrays. restore() comes after begin(). It throws std::invalid_argument for what sleeps and
    // std::length_error for attachments.
    virtual void save(const State<T>&, SavedState&) const {}
    virtual void restore(State<T>&, const SavedState&) const {}
    virtual void change(const Plan<T>&, State<T>&, const StepperChange<T>&) {}

    // These are for what is free and meets the trees.
    virtual void view_motion(const State<T>&, MotionView<T>&) const = 0;
    // [1] Returns the square roots of each joint's factor of inertia where joints move one by one; empty where a tree answers as a whole.
    virtual const std::vector<Vector3<T>>& inertia_factor() const {
        static const std::vector<Vector3<T>> none;
        return none;
    }
    // Called when bodies have broken off: in plan and state they become bodies without mass that nothing moves. `carried`: what is left of the
    // moments of bodies that carried them; of several of one body the last counts. O(bodies that left), plain O(n).
    virtual void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies,
                      const std::vector<CarriedMoment>& carried) = 0;

protected:
    Stepper(const Stepper&) = default;
    Stepper& operator=(const Stepper&) = default;

    bool carries_moments_ = false; // since take_constants()

private:
    StepperKind kind_;
};

} // namespace bough
