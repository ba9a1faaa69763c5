// any_run.h: what stands behind the door (simulation.h): a run in either precision, by any solver. Studies use it too.
#pragma once
#include "../plan/attached.h"
#include "run.h"
#include "run_choice.h"

namespace bough {

// How a joint stands and turns, independent of its spring's rest pose, in the axes of the body that carries it.
struct JointMotion {
    Mat3 R = Mat3::Identity();
    Vec3 omega = Vec3::Zero(); // [rad/s]
};

// simulation.h describes the calls that Simulation has too.
class AnyRun {
public:
    virtual ~AnyRun() = default;
    virtual std::unique_ptr<AnyRun> copy() const = 0; // the assembly is shared

    virtual StepReport step(int times) = 0;
    // The two parts of step(): advance() takes the step alone; non_finite() tells whether the run became non-finite, and where.
    virtual void advance(StageClock*) = 0;
    virtual std::string non_finite() = 0;
    virtual void begin_again() = 0; // as at the start, with nothing changed. Where nothing is free: the plan stays
    virtual bool fresh() const = 0; // at its start: no step taken, nothing restored
    // Sets a run at its start to so many steps before time 0. In these steps only trees, wind and ground move, and nothing is counted.
    virtual void set_back(std::int64_t steps) = 0;

    virtual std::size_t bodies() const = 0;
    virtual std::int64_t steps() const = 0;
    virtual double time() const = 0;
    virtual const MotionFrame& frame() = 0;
    virtual std::optional<std::size_t> fill(const MotionFields&, MotionFrame&) = 0; // returns the first non-finite body
    virtual const MotionEvents& events() const = 0;
    virtual const std::vector<std::uint32_t>& broken() const = 0; // joints, in the order in which they broke
    virtual std::vector<Ball> balls() const = 0;                  // shown_balls
    virtual Tree posed() = 0;
    // [m] Far ends of bodies (along z). Where joints are held, ends() takes bodies of the tree that moves, shown_ends() of all that are shown.
    virtual void ends(const std::vector<std::size_t>& bodies, std::vector<Vec3>&) = 0;
    virtual void shown_ends(const std::vector<std::size_t>& bodies, std::vector<Vec3>&) = 0;

    virtual Scene& scene() = 0;                                    // the plan's
    virtual bool coupled() const = 0;                              // by its method
    virtual void scale_wood(double stiffness, double damping) = 0; // factors on what they are now
    virtual void set_step(double seconds) = 0;                     // of the coupled method
    virtual bool pushed() const = 0;                               // free bodies may push the trees
    virtual bool sleeps() const = 0;                               // trees may
    virtual void wake() = 0;
    virtual bool gone(std::size_t body) const = 0; // has broken off
    virtual void pull(std::size_t body, const Vec3& point, const Vec3& force) = 0;
    virtual std::uint64_t attach(std::size_t body, const Vec3& point, double stiffness, double damping) = 0;
    virtual Attached* attachment(std::uint64_t number) = 0;    // null: there is none
    virtual void release(std::uint64_t number) = 0;            // of one that is there
    virtual std::vector<Attached> hands() const = 0;           // what attach() made and is still there
    virtual void adopt(const Attached&, std::size_t body) = 0; // of another run's
    virtual bool drives(std::size_t tree) const = 0;           // set_ground() may be called for it
    virtual void set_ground(std::size_t tree, const GroundMotion&, int steps) = 0;
    virtual GroundMotion ground(std::size_t tree) const = 0; // of one that it drives
    virtual std::vector<JointMotion> joints() = 0;
    virtual void go_on(const std::vector<JointMotion>&, const std::vector<std::uint8_t>& known, double time) = 0;

    virtual std::uint64_t hash() = 0;
    virtual void save(SavedState&) = 0;
    virtual void restore(const SavedState&) = 0;
    virtual std::string explain() const = 0;
    virtual RunAccount account() const = 0;

    // For code that is written for either precision (study/); null where the run is in the other one.
    virtual Run<float>* single() { return nullptr; }
    virtual Run<double>* double_() { return nullptr; }

    const SimulationOptions& options() const { return choice_.options; }
    const Assembly& assembly() const { return *assembly_; }
    const Tree& whole_tree() const { return assembly_->whole ? assembly_->whole->tree : assembly_->tree; }
    const std::vector<TreeRange>& whole_ranges() const {
        return assembly_->whole ? assembly_->whole->places.whole : assembly_->ranges;
    }

    double stiffness = 1, damping = 1; // set_wood

protected:
    AnyRun(std::shared_ptr<Assembly>, RunChoice);
    AnyRun(const AnyRun&) = default;

    RunChoice choice_;
    std::shared_ptr<Assembly> assembly_; // the run refers to its tree
};

// choice: with options that simulation.cpp has checked. Throws SceneError.
std::unique_ptr<AnyRun> make_run(std::shared_ptr<Assembly>, const RunChoice&);
AnyRun& run_of(Simulation&);

// Calls f with the Run<T> that the run is.
template <class F> auto visit_run(AnyRun& run, F&& f) {
    if (Run<float>* const single = run.single()) return f(*single);
    return f(*run.double_());
}

} // namespace bough
