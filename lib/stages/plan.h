// plan.h: what one scene needs, decided once (§ "leave out"): which stages run, which arrays exist, and the constants
// they read, in the precision of the run. A stage or array that nothing needs is not run and not allocated; why, is
// said in `stages` and `arrays`, which `treesim --explain` prints and the tests hold against what really happened.
#pragma once
#include "../coupled/scheme.h"
#include "../fast/lanes.h"
#include "../fast/targets.h"
#include "../model/leaf_terms.h"
#include "../model/root_motion.h"
#include "../model/scene.h"
#include "../model/tree.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bough {

enum class Stage : std::uint8_t {
    wind_field,
    external_forces,
    composite,
    drag,
    root_motion,
    fictitious,
    spring,
    articulated,
    midpoint,
    body_loads,
    resolvent,
    lanes,
    state_update,
    free_flight,
    contacts,
    fracture,
    walkers
};
constexpr std::size_t stage_count = 17;
const char* stage_name(Stage);

// How a step is made (lib/reference/advance.h). The articulated ones exist in double alone.
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

// What the caller will read of a state: arrays for it exist only then.
struct Wishes {
    bool velocity = false; // velocity and angular velocity of each body
    bool torque = false;   // spring torque of each joint
    // Poses and angles as they go. Without (and without the two above) a fast path keeps neither them nor their constants in document
    // order: a run then has its hash, and the angles that present() brings for a saved state.
    bool pose = true;
    bool loads = false; // the caller will put forces on bodies into State::loads before steps
    // [m] What the wind's tables reach at least, whatever the tree at hand does: a part of a larger scene looks its wind up in the same.
    double top = 0, reach = 0;
    std::vector<double> clocks{}; // [s] the wind's of the whole, in its order (wind_clocks)
};

struct PlannedStage {
    Stage stage;
    bool on;
    std::string reason; // the part of the scene that asks for it, or that lacks it
};

struct PlannedArray {
    std::string name;
    bool on;
    std::size_t bytes; // as allocated, or as it would be
    std::string reason;
};

// A pull with its target looked up.
template <class T> struct PlannedPull {
    std::size_t body;
    Vector3<T> point_b; // [m] body frame
    std::size_t source; // index into Scene::pulls
};

template <class T> struct Plan {
    std::size_t bodies = 0;
    double dt = 0; // [s] one step
    Solver solver = Solver::analytic;
    Scheme scheme = Scheme::p12; // of the coupled solver
    double tolerance = 1e-8;     // [rad] error allowed in a step of articulated_reference (extrapolation.h)
    Scene scene;                 // as given, for times and forces
    bool gravity = false, wind = false, forces = false, velocity = false, torque = false;
    bool root_motion = false, joint_limit = false;
    bool fictitious = false; // of the analytic solver: lagged terms of the joints' own motion (fictitious.h)
    bool contact = false;    // free bodies may push the trees
    bool loads = false;      // State::loads may hold some: of contacts, of walkers
    bool pushes() const { return loads || !pulls.empty(); } // on single points
    bool pose = true; // false: with lanes and not wished for; of the arrays over bodies below only theta_start is there
    std::vector<PlannedStage> stages;
    std::vector<PlannedArray> arrays;

    // Constants of every scene, arrays over bodies.
    std::vector<std::int32_t> parent;
    std::vector<Vector3<T>> joint_position; // [m] parent's body frame (world for roots)
    std::vector<Matrix3<T>> R_pj;           // parent's body frame from joint frame, rest pose
    std::vector<T> mass;                    // [kg]
    std::vector<T> c_mass;                  // [kg] (1): constant until something breaks
    std::vector<Vector3<T>> com;            // [m] body frame
    std::vector<Matrix3<T>> inertia_joint;  // [kg m^2] about own joint, body axes
    std::vector<Vector3<T>> K;              // [N m/rad]
    std::vector<T> beta;                    // [s]
    std::vector<Vector3<T>> inertia_factor; // [1] square roots of F's diagonal (spring.h)
    std::vector<Vector3<T>> theta_start;    // [rad]

    std::vector<Vector3<T>> theta_limit; // [rad] joint_limit.h; infinite: none

    // Gravity's gradient (spring.h).
    std::vector<T> gravity_row; // [N m] bound on what the path's other joints change of gravity's moment
    T row_gravity = 0; // [m/s^2] what the rows hold for: |g|, or 1 where the root's motion stands in (root_term.h)

    std::vector<Vector3<T>> carried_moment; // [kg m] P of body_load.h, body axes
    std::vector<Vector3<T>> carried_drag;   // [kg] likewise of kappa rho A; with wind alone

    // Root motion (root_term.h): a curve an entry of Scene::root_motion, and which trees it moves, rising.
    std::vector<RootSpline> splines;
    std::vector<MovedTree> moved;

    // Wind (drag.h, external_forces.h).
    std::vector<T> drag_area; // [kg/m] kappa rho A of (21), (22), (23)
    std::vector<Kind> kind;
    bool foliage = false; // some body is a leaf, a petal or a clump: it folds, and the air takes its turning (air.h)
    LeafTerms<T> leaf;    // on with /wind and /leaves (leaf_air.h)
    std::vector<T> sway;  // [1] W_b: what the weights move the body's centre of mass by
    std::vector<T> joint_distance, com_distance; // [m] |joint_position|, |com|
    std::vector<T> inverse_weight;               // [m/rad] 1 / u_j
    double top = 0;                              // [m] highest point, for the wind's table
    bool field = false;                          // it varies over the ground (wind_field.h), or there is shelter
    double reach = 0;              // [m] the point farthest from the swirl's axis, over the ground; with a swirl alone
    std::vector<T> shelter;        // [1] wind at the body over the undisturbed one (shelter.h)
    std::vector<double> clocks{0}; // [s] by how much the wind's clocks are ahead (wind_field.h)
    std::vector<std::uint32_t> clock; // which of them each body's tree goes by; empty: all by the first

    std::vector<PlannedPull<T>> pulls;

    // The fast path (lib/fast/lanes.h), where the caller asked for it and it holds all that the scene has.
    fast::PlannedLanes<T> lanes;
    fast::Target target = fast::Target::baseline; // what its code is compiled for
};

// What loads the bodies: the parts of the scene that do, or that none does.
template <class T> std::string forces_text(const Plan<T>&);

// Of what goes by itself (lib/free): what the scene names of it, as a JSON pointer, or null; whether there is any; whether free bodies may
// push trees.
const char* free_part(const Scene&);
inline bool has_free_bodies(const Scene& scene) {
    return free_part(scene) != nullptr;
}
bool may_push(const Scene&);
// [m] highest point that a body of the tree could ever reach by standing straight up, and the farthest over the ground from (x, z): what the
// wind's tables cover. O(n).
struct WindReach {
    double top, reach;
};
WindReach wind_reach(const Tree&, const std::vector<TreeRange>&, const Scene&);

// tree: joined and checked; ranges: of each of the scene's trees in it (one range for a tree on its own). Scales K and
// beta by the scene's factors, finds the rest pose (pose.h), composite masses and weights (branch_mode.h). O(n).
// Throws std::out_of_range for a selector that names no body, std::domain_error for a pose that gravity does not allow,
// for one that starts beyond a joint limit (its body and angle), for joint limits, fracture or balls with an articulated solver, for a swirl finer
// than a table can hold (wind_field.h) and for columns of shelter that a body fills (shelter.h); for /fictitious with another solver than
// the analytic; for a scene that still has /wood, /load or /simulate, which must be in the tree before (wood_overrides.h, static_load.h, hold.h), and
// for rigid bodies not yet joined (reduce.h).
// simd: the fast path in that target's code, where it holds all that the scene has (Plan::lanes says why not); none: the plain path.
// sleep: [rad/s] the rate below which what has settled is left out of the fast path's steps (fast/sleep.h); 0: never.
// Memory: a tree that is handed over (Tree&&) gives each array back as soon as the plan has what it needs of it, so that the two never
// stand side by side whole; branch numbers, name, material, source and colours stay.
template <class T>
Plan<T> make_plan(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene&, const Wishes&, double dt,
                  Solver solver = Solver::analytic, Scheme scheme = Scheme::p12,
                  std::optional<fast::Target> simd = std::nullopt, double sleep = 0);
template <class T>
Plan<T> make_plan(Tree&& tree, const std::vector<TreeRange>& ranges, const Scene&, const Wishes&, double dt,
                  Solver solver = Solver::analytic, Scheme scheme = Scheme::p12,
                  std::optional<fast::Target> simd = std::nullopt, double sleep = 0);

} // namespace bough
