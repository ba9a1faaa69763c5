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
// Errors. The constructor throws SceneError for what cannot be run, once, with the place as treesim prints it. A call with a number that is not
// finite, or for a body that is not there, throws it too and changes nothing. After a step that became non-finite, further steps do nothing and
// return the same report; what is read is then the state that this step left, in which numbers may be non-finite. A simulation keeps all that it
// needs: the scene and its trees may be destroyed.
// Threads. One thread at a time uses a simulation. Several simulations may run side by side; they share helper threads. Results do not depend on the
// number of threads. A step takes as many threads as its work pays for: one below a thousand bodies or two, then one more for each thousand or so, up
// to the limit. A step does not wait for a helper whose core is busy, so more threads than free cores cost next to nothing. This needs no settings,
// and a program's own OpenMP, signals and forked children are left alone (lib/base/parallel.h).
// Frames of reference. The axes are the world's, y up; the units are metres, seconds and kilograms. Bodies stand in document order (tree.h): the
// trees' one after another, then balls, then walkers.
#pragma once
#include "../model/motion.h"
#include "../model/scene.h"
#include "run_types.h"
#include "scene_error.h"
#include <memory>
#include <span>

namespace bough {

class AnyRun; // behind the door; no user needs it
struct Assembly;
struct RunChoice;

class Simulation {
public:
    // Compiles the scene. The run starts with its state at time 0. O(bodies). Throws SceneError. The system gives a large run's tables their memory
    // as steps first use it, so the first steps take longer than later ones.
    explicit Simulation(Scene, const SimulationOptions& = {});
    // The same, but a tree goes on with the motion of the tree of the same number in `before`, if both have the same number of bodies, connected
    // alike. This serves for what cannot change within a run: wood, trees, kinds of wind. Throws SceneError.
    Simulation(Scene, const SimulationOptions&, const Simulation& before);
    Simulation(Simulation&&) noexcept; // what was moved from may only be assigned to or destroyed
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();
    // Returns a run of its own, which ends as this one does. Both share the trees. O(bodies).
    Simulation copy() const;

    // Lets the wind blow for so many seconds (rounded to whole steps) before time 0. It is called before the first step, and takes its steps up to
    // time 0 with the wind, the ground and the scene's pulls of those times. What is seen then is the sway in the wind, not how a tree in still air
    // takes the first blow. Balls, walkers and what may break wait for time 0: what the wind would have broken by then breaks in the first step.
    // Without this call a simulation starts at rest. The report's counts are 0. `seconds` is 0 to most_settled, which is far beyond any that
    // settling_time() gives. Throws SceneError for others, and after a step, a restored state or a motion that goes on.
    static constexpr double most_settled = 600;
    StepReport settle(double seconds);
    // Sets the clock of a run at its start so many steps before time 0. The steps up to time 0 are then those of settle(), but the caller's: one that
    // shows how far they are, or may end them. The step's length stays until
    // then (set_step() is refused). Throws SceneError as settle() does, and for less than 0 steps or more than 1e9.
    void begin_before(std::int64_t steps);
    // [s] How long settle() must run until the start is forgotten (plan/settling.h); 0 for a scene in which no wind blows. O(bodies).
    double settling_time() const;
    // Takes `times` steps (0 or more, else it throws SceneError), and stops early at one that becomes non-finite. The report and events() cover all
    // of them. A step is O(bodies). After the first few calls it allocates only where something breaks, where a body first turns so fast that its
    // energy is watched (coupled/energy_guard.h), and where more points are pulled than ever before.
    StepReport step(int times = 1);

    std::size_t bodies() const; // that are shown: of trees, balls and walkers
    std::int64_t steps() const; // taken
    double time() const;        // [s]
    const SimulationOptions& options() const;
    bool has_events() const;  // the scene may have events: something may break, fall, fly or leap
    const Tree& tree() const; // the trees joined, as drawn: names, branches, sizes of bodies. Without balls and walkers
    std::span<const TreeRange> trees() const; // which of the tree's bodies belong to which tree

    // The present state: one value for each body, valid until the next step. What is not asked for costs nothing; the first call after a step is
    // O(bodies).
    std::span<const Vec3> positions() const;          // [m] of own joints (of balls: centres)
    std::span<const Quat> rotations() const;          // world from body
    std::span<const Vec3> velocities() const;         // [m/s] of centres of mass (option velocities)
    std::span<const Vec3> angular_velocities() const; // [rad/s] (option velocities)
    std::span<const Vec3> angles() const;  // [rad] rotation vectors of joints in their joint frames; of trees alone
    std::span<const Vec3> rates() const;   // [rad/s] how those change
    std::span<const Vec3> torques() const; // [N m] of springs and dampers on bodies, joint frames (option torques)
    // [Pa] that bend the wood at each joint (model/bending_stress.h; option stresses)
    std::span<const double> stresses() const;
    // Fills in what `fields` asks for, and the events. O(bodies). Arrays need their options, as above. The caller sets the frame's number and its
    // time, which is time(): walkers are placed by it. Returns "", or
    // "stage state_update, body N" for the first body that is non-finite. Throws SceneError for a field whose option is off.
    std::string fill(const MotionFields& fields, MotionFrame&) const;
    const MotionEvents& events() const;            // of the last call of step(): what broke, hit, landed, leapt
    std::span<const std::uint32_t> broken() const; // bodies whose joints broke since the start, in that order
    // The scene's balls, then its walkers as the balls that they are shown as, all as they were at the start. positions() has where they are, behind
    // the trees' bodies.
    std::vector<Ball> balls() const;
    // Returns the tree that a mesh of the run is made of, with what breaks in it known beforehand (broken() of a copy that ran ahead): what breaks
    // off is a root from the start, and balls() follow as fruit that are roots. Poses fit it, for bodies keep their numbers. O(bodies).
    // Throws SceneError for a body that is not there.
    Tree shown_tree(std::span<const std::uint32_t> broken) const;
    // Returns the trees drawn as they stand now, to be run again from there or to be written. With pose drawn they stay so by themselves. Stiffness
    // and damping are the trees' own, without set_wood() and the scene's scales. Throws SceneError where joints are held, or broke.
    Tree posed_tree() const;

    // What may change between two steps. No change makes a new plan, and none allocates when it was made before. Each acts from the next step on and
    // wakes what sleeps.
    //
    // Changes the wind of a scene that has one (one of zero velocity is still air). Turbulence and gusts go on from where they are: at any time the
    // velocity changes by as little as the change asks for (go_on of laws/wind_weather.h). Velocity, turbulence, gusts and seed may change; the rest
    // stays.
    // Where trees may sleep, the wind must have no gusts and no turbulence. Throws SceneError.
    void set_wind(const Wind&);
    // Changes the gravity of a scene that has some, with the coupled method. With pose drawn the springs keep their rest pose. Throws SceneError.
    void set_gravity(const Vec3&); // [m/s^2]
    // [s] Sets the length, above 0, of the steps from here on; time() goes on from its present value. The next step extrapolates from what the last
    // one changed: this is scaled in proportion, so the motion stays of second order. Hands and grounds that are on their way keep to their steps and
    // their time. Before the first step, the run behaves as if it had begun with this step. Coupled method only. Throws SceneError.
    void set_step(double seconds);
    // [1] Sets all joints' stiffness (above 0) and damping (0 or more) relative to their values at the start of the run. It needs the coupled method,
    // and nothing may be thrown at the trees. Springs keep their rest pose, so softer wood sags further. Each change rounds. Throws SceneError.
    void set_wood(double stiffness, double damping);
    // Applies a force [N, world] at a point [m, body frame] of a body of the trees, in the next step only. Any number of pulls may act. Throws
    // SceneError without SimulationOptions::pulls (with it nothing sleeps), where joints are held, and for bodies that are not there or have broken
    // off.
    void pull(std::size_t body, const Vec3& point, const Vec3& force);
    // Attaches a hand, a rope or a prop: a spring [N/m] and a damper [N s/m] between a point [m, body frame] of any body of the trees and a target in
    // the world. The target starts where the point is now. No stiffness makes the motion grow. Returns the attachment's number, which is
    // above 0 and which this simulation never gives twice. Any number of attachments act, from the next step on until release() or until the body
    // breaks off. Nothing has to be asked for beforehand. A call is O(bodies) and allocates; a step with an attachment takes some microseconds more
    // and allocates nothing for it. Saved states do not contain it. Coupled method only. Throws SceneError, also for bodies that are not there, stand
    // still or have broken off.
    std::uint64_t attach(std::size_t body, const Vec3& point, double stiffness, double damping);
    // Moves the target evenly from where it is to `target` [m, world] in the next `steps` steps; it then stays there. With 0 steps it is there at
    // once. Allocates nothing. Throws SceneError for an attachment that is not there.
    void move_attachment(std::uint64_t attachment, const Vec3& target, int steps = 1);
    void release(std::uint64_t attachment);
    // [N] on the body, at the last step's end; zero before the first
    Vec3 attachment_force(std::uint64_t attachment) const;

    // Moves the ground under a tree, with its roots. In `steps` steps from now the ground reaches this place and velocity, on a smooth way from its
    // present place and motion; then it goes on with the motion that it has. With 0 steps the ground is there at once, and the tree stands on it as
    // before, unmoved. A ground that is set in each step moves, to O(step^4), as one with the same keys in the scene (/root_motion). The wind's table
    // reaches to the top of the trees as drawn; above that the wind is as at the top. Throws SceneError without SimulationOptions::grounds, and for a
    // tree that is not there or has keys of its own.
    void set_ground(std::size_t tree, const GroundMotion&, int steps = 1);

    // Of angles and rates, broken joints and free bodies: what `treesim --report hash` prints
    std::uint64_t hash() const;
    // A run that goes on from what save() gave ends as this one, bit by bit. Wind, gravity, wood and grounds are those that the restoring run has by
    // then. restore() throws SceneError for the state of another run, and then changes nothing.
    SavedState save() const;
    void restore(const SavedState&);

    std::string explain() const; // which stages and arrays the scene needs, and why; of attach() only account() knows
    RunAccount account() const;  // how it was run, how often each stage ran, what acted in it. O(free bodies)
    std::size_t bytes() const;   // [B] of the state

private:
    explicit Simulation(std::unique_ptr<AnyRun>);
    friend Simulation make_simulation(std::shared_ptr<Assembly>, const RunChoice&);
    friend AnyRun& run_of(Simulation&);

    std::unique_ptr<AnyRun> run_;
};

} // namespace bough
