// simulation.h: the door. One run of a scene, from its trees to their motion:
//
//   bough::Scene scene;
//   scene.add(bough::convert(bough::grow("apple", {.bodies = 10000, .seed = 7})));     // bough/files.h; or read_scene("park.json")
//   scene.wind = bough::wind_preset("gusty");
//   bough::Simulation simulation(scene, {.step = 1 / 30., .precision = bough::Precision::single});
//   for (int frame = 0; frame < 90; ++frame) {
//       if (bough::StepReport report = simulation.step(); !report.finite()) return 3;  // report.non_finite names stage and body
//       use(simulation.positions(), simulation.rotations());
//   }
//
// Errors. What cannot be run throws SceneError, once, from the constructor, with the place as treesim prints it. A call with a number that is
// none, or for a body that is not there, throws it too and changes nothing. After a step that became non-finite, steps do nothing and return the
// same report; what is read is the state that it left, where numbers may be none. A simulation keeps all that it needs: the scene and its trees may go.
// Threads. One simulation is used by one thread at a time; several may run side by side, and share helpers. Results do not hang on the number of
// threads. A step takes as many as its work pays for: one below about 2 000 bodies, then one more for each thousand or so, to the limit. A helper whose
// core is busy is not waited for, so more threads than are free cost next to nothing; nothing has to be set for that, and a program's own OpenMP,
// signals and forked children are let alone (lib/base/parallel.h).
// Frames of reference. World axes, y up, metres, seconds, kilograms; bodies in document order (tree.h), the trees' one after another, then balls,
// then walkers.
#pragma once
#include "../model/motion.h"
#include "../model/scene.h"
#include "method.h"
#include "scene_error.h"
#include <cstdint>
#include <memory>
#include <span>

namespace bough {

class AnyRun; // what stands behind the door is no user's business
struct Assembly;
struct RunChoice;

struct SimulationOptions {
    double step = 1.0 / 30; // [s] above 0: of one step; set_step() changes it
    Precision precision = Precision::double_;
    Method method = Method::coupled;
    double sleep =
        0; // [rad/s] slower than this for a while, trees are left out of steps until something moves them; 0: never
    int threads =
        0; // of a step at most, the caller's among them; 0: as many as the process has cores. Small work takes fewer ("Threads")
    bool velocities = false; // velocities() and angular_velocities() are wanted: else empty
    bool torques = false;    // likewise torques()
    bool stresses = false;   // likewise stresses()
    bool pulls = false;      // pull() will be called: without, the step has no place for it
    bool grounds =
        false; // set_ground() will be called: nothing sleeps then, and the analytic method takes the plain path
    bool portable =
        false; // the plain path, one number at a time, whose rounding does not hang on the machine's SIMD; several times slower
};

// How a tree's ground has moved from where the tree was drawn: what was drawn at X is at pivot + position + rotation (X - pivot), the pivot the tree's
// own place (Placement::position).
struct GroundMotion {
    Vec3 position = Vec3::Zero(); // [m]
    Quat rotation = Quat::Identity();
    Vec3 velocity = Vec3::Zero(), angular_velocity = Vec3::Zero(); // [m/s] of the pivot, [rad/s], world
};

struct StepReport {
    std::string non_finite; // "": finite. Else stage and body: "stage resolvent (theta), body 17 (branch 3)"
    // Bodies of which the steps could not follow the motion, in this call (lib/study/README.md, "What is not promised"): none of it is an error.
    std::uint64_t fast_turns = 0;                // turned by more than a radian
    std::uint64_t guarded = 0;                   // were kept from gaining energy
    std::uint64_t limited = 0;                   // ended at a joint's limit, which the scene asks for
    std::size_t broke = 0, hits = 0, landed = 0; // events() has them

    bool finite() const { return non_finite.empty(); }
};

class Simulation {
public:
    // Compiles the scene; its start is the state at time 0. O(bodies). Throws SceneError.
    explicit Simulation(Scene, const SimulationOptions& = {});
    // The same, and each tree that has as many bodies as the tree of the same number had before, connected alike, goes on with its motion. For what
    // cannot change in a run: wood, trees, kinds of wind. Throws SceneError.
    Simulation(Scene, const SimulationOptions&, const Simulation& before);
    Simulation(Simulation&&) noexcept; // what was moved from may only be assigned to or destroyed
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();
    // A run of its own from here on, which ends as this one. The trees are shared. O(bodies).
    Simulation copy() const;

    // Before the first step: the wind has blown already. Steps of so many seconds (rounded to whole steps), up to time 0, with the wind, the ground
    // and the scene's pulls of the times before it: what shows then is the wind's own sway, not how a tree in still air takes the first blow. Balls, walkers and
    // what may break wait for time 0: what the wind would have broken by then breaks in the first step. Nothing is done by itself: a simulation that is
    // not told to starts at rest. The report's counts are 0. `seconds`: 0 to most_settled, far beyond any that settling_time() gives. Throws SceneError for
    // others, and after a step, a restored state or a motion that goes on.
    static constexpr double most_settled = 600;
    StepReport settle(double seconds);
    // [s] How long that takes until the start is forgotten (plan/settling.h): 0 for a scene in which no wind blows. O(bodies).
    double settling_time() const;
    // From now to now + step, so many times, up to a step that becomes non-finite; the report and events() are of all of them. O(bodies) a step; allocates
    // nothing once it has run a few times, but where something breaks, where a body first turns so fast that energy
    // is watched (coupled/energy_guard.h), and where more points are pulled than ever before.
    StepReport step(int times = 1);

    std::size_t bodies() const; // that are shown: of trees, balls and walkers
    std::int64_t steps() const; // taken
    double time() const;        // [s]
    const SimulationOptions& options() const;
    bool has_events() const;  // the scene may have some: something may break, fall, fly or leap
    const Tree& tree() const; // the trees joined, as drawn: names, branches, sizes of bodies. Without balls and walkers
    std::span<const TreeRange> trees() const; // which of its bodies are whose

    // Present state, a number for each body, valid until the next step. What is not asked for costs nothing; the first call after a step O(bodies).
    std::span<const Vec3> positions() const;          // [m] of own joints (of balls: centres)
    std::span<const Quat> rotations() const;          // world from body
    std::span<const Vec3> velocities() const;         // [m/s] of centres of mass (Options::velocities)
    std::span<const Vec3> angular_velocities() const; // [rad/s] (Options::velocities)
    std::span<const Vec3> angles() const;  // [rad] rotation vectors of joints in their joint frames; of trees alone
    std::span<const Vec3> rates() const;   // [rad/s] how those change
    std::span<const Vec3> torques() const; // [N m] of springs and dampers on bodies, joint frames (Options::torques)
    std::span<const double>
    stresses() const; // [Pa] that bend the wood at each joint (model/bending_stress.h; Options::stresses)
    const MotionEvents& events() const; // of the last call of step(): what broke, hit, landed
    // The trees drawn as they stand, to be run again from there or written: with pose drawn they stay so by themselves. Stiffness and damping are the
    // trees' own, without set_wood() and the scene's scales. Throws SceneError where joints are held, or broke.
    Tree posed_tree() const;

    // What may change between two steps. None of it plans anew, nor allocates once it was done before; each is taken from the next step on, and wakes what sleeps.
    // The wind of a scene that has one (of no velocity at all: still air); turbulence and gusts go on from where they are, at any time, by as little
    // as the change is (laws/wind.h, go_on). Velocity, turbulence, gusts and seed may change, the rest of it stays; where trees may sleep it stays
    // without gusts and turbulence. Throws SceneError.
    void set_wind(const Wind&);
    // Of a scene that has some, with the coupled method. The drawn pose keeps the springs' rest that it had. Throws SceneError.
    void set_gravity(const Vec3&); // [m/s^2]
    // [s] Above 0: of the steps from here on, time() going on from what it is. What the last step changed, from which the next one extrapolates, is
    // taken in proportion, so that the motion stays of second order; hands and grounds that are on their way keep to their steps and their
    // time. Before the first step as if it had begun so. The coupled method. Throws SceneError.
    void set_step(double seconds);
    // [1] All joints' stiffness and damping over what they had when the run began; above 0, 0 or more. The coupled method, nothing that is thrown at
    // trees. Springs keep their rest: softer wood sags further. Each change rounds. Throws SceneError.
    void set_wood(double stiffness, double damping);
    // A force [N], world, on a point [m, body frame] of a body of the trees, in the next step alone. Any number of them. Throws SceneError
    // without Options::pulls (with which nothing sleeps), where joints are held, for bodies that are not there or have broken off.
    void pull(std::size_t body, const Vec3& point, const Vec3& force);
    // A hand, a rope, a prop: a spring [N/m] and a damper [N s/m] between a point [m, body frame] of any body of the trees and a target in the world,
    // which is where the point is now. Any stiffness holds. Returns the attachment's number, above 0 and never given twice; any number of them, from the
    // next step on, until release() or till the body breaks off. Nothing has to be asked for beforehand: O(bodies) a call, which
    // allocates; a step with it some microseconds more, and nothing allocated. Part of no saved state. The coupled method. Throws SceneError; also for bodies that
    // are not there, stand still or have broken off.
    std::uint64_t attach(std::size_t body, const Vec3& point, double stiffness, double damping);
    // The target goes evenly from where it is to `target` [m, world] in the next `steps` steps, and stays there; 0: it is there at once.
    // Allocates nothing. Throws SceneError for an attachment that is not there.
    void move_attachment(std::uint64_t attachment, const Vec3& target, int steps = 1);
    void release(std::uint64_t attachment);
    Vec3
    attachment_force(std::uint64_t attachment) const; // [N] on the body, at the last step's end; zero before the first

    // The ground under a tree, its roots with it: in `steps` steps from now it is there with that velocity, on a smooth way from where it is and how it
    // moves; then it goes on as it moves by then. 0: it is there at once, and the tree as it stands on it, unmoved. A ground that is told of each step
    // moves as one of the same keys in the scene (/root_motion), to O(step^4). The wind is taken from heights as the trees were drawn: above their top
    // it is as there. Throws SceneError without Options::grounds, for a tree that is not there or has keys of its own.
    void set_ground(std::size_t tree, const GroundMotion&, int steps = 1);

    std::uint64_t
    hash() const; // of angles and rates, broken joints and free bodies: what `treesim --report hash` prints
    // A run that goes on from what save() gave ends as this one, bit by bit; wind, gravity, wood and grounds are those that this run has by now. restore() throws
    // SceneError where it was another run's, and then changes nothing.
    SavedState save() const;
    void restore(const SavedState&);

    std::string explain() const; // which stages and arrays the scene needs, and why
    std::size_t bytes() const;   // [B] of the state

private:
    explicit Simulation(std::unique_ptr<AnyRun>);
    friend Simulation make_simulation(std::shared_ptr<Assembly>, const RunChoice&);
    friend AnyRun& run_of(Simulation&);
    friend const AnyRun& run_of(const Simulation&);

    std::unique_ptr<AnyRun> run_;
};

} // namespace bough
