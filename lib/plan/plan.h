// plan.h: what one scene needs, decided once (§ "leave out"): which stages run, which arrays exist, and the constants they read, in the precision of
// the run. A stage or array that nothing needs is not run and not allocated; explain.h says why. The plan holds what any solver reads. The stepper
// holds what only one solver reads.
#pragma once
#include "../laws/leaf_terms.h"
#include "../model/root_motion.h"
#include "../model/scene.h"
#include "../model/tree.h"
#include "stepper.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace bough {

// What the caller will read of a state. Arrays for the rest do not exist.
struct Wishes {
    bool velocity = false; // velocity and angular velocity of each body
    bool torque = false;   // spring torque of each joint
    // Poses and angles in each step. Without this (and without velocities, torques and stresses) a step in lanes keeps neither them nor their
    // constants in document order. A run then has its hash, and the angles that present() brings for a saved state.
    bool pose = true;
    bool stress = false; // bending_stresses() will be called
    bool loads = false;  // the caller will put forces on bodies into State::loads before steps
    // [m] What the wind's tables reach at least, whatever the tree at hand needs: a part of a larger scene then uses the same tables.
    double top = 0, reach = 0;
    std::vector<double> clocks{}; // [s] the wind's of the whole, in its order (wind_clocks)
    // Some tree of the whole has foliage, and some clump of it a face (air.h): by these the run chooses its laws for all.
    bool foliage = false, faces = false;
};

// A pull with its target looked up.
template <class T> struct PlannedPull {
    std::size_t body;
    Vector3<T> point_b; // [m] body frame
    std::size_t source; // index into Scene::pulls
};

// An attachment with its target looked up.
struct PlannedAttachment {
    std::size_t body;
    Vec3 point_b;                        // [m] body frame
    std::size_t source;                  // index into Scene::attachments
    std::optional<Selected> far;         // of one with another body
    std::optional<QuinticSpline> course; // [m] of a target that moves
};

template <class T> struct Plan {
    std::size_t bodies = 0;
    double dt = 0; // [s] one step
    Scene scene;   // as given, for times and forces
    bool gravity = false, wind = false, forces = false, torque = false;
    bool velocity = false, velocity_wished = false; // of each body: kept, and asked for by the caller
    bool root_motion = false, joint_limit = false;
    bool contact = false; // free bodies may push the trees
    bool loads = false;   // State::loads may hold some: of contacts, of walkers, the caller's
    bool pushes() const { return loads || !pulls.empty(); } // on single points
    bool pose = true; // false: with lanes and not wished for; of the arrays over bodies below only theta_start is there
    Copied<Stepper<T>> stepper; // how steps are made

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
    std::vector<Vector3<T>> theta_start;    // [rad]

    std::vector<Vector3<T>> theta_limit; // [rad] joint_limit.h; infinite: none
    std::vector<T> stress_of_moment;     // [1/m^3] of wood 1 / section_modulus(), of all else 0; with Wishes::stress

    // Root motion: one curve for each entry of Scene::root_motion, and the trees that it moves, rising.
    std::vector<RootSpline> splines;
    std::vector<MovedTree> moved;

    // Wind.
    std::vector<T> drag_area; // [kg/m] kappa rho A of (21), (22), (23)
    std::vector<T> facing;    // [1] of clumps (Tree::leaf_facing), else 0; empty: 0 of all
    std::vector<Kind> kind;
    bool foliage = false;   // some body is a leaf, a petal or a clump: it folds, and the air takes its turning (air.h)
    LeafTerms<T> leaf;      // on with /wind and /leaves (leaf_air.h)
    double top = 0;         // [m] highest point, for the wind's table
    bool field = false;     // it varies over the ground (wind_field.h), or there is shelter
    double reach = 0;       // [m] the point farthest from the swirl's axis, over the ground; with a swirl alone
    std::vector<T> shelter; // [1] wind at the body over the undisturbed one (shelter.h)
    std::vector<double> clocks{0};    // [s] by how much the wind's clocks are ahead (wind_field.h)
    std::vector<std::uint32_t> clock; // which of them each body's tree goes by; empty: all by the first

    std::vector<PlannedPull<T>> pulls, followers; // in the world's axes; in the body's (Pull::in_body)
    std::vector<PlannedAttachment> attachments;
    bool pairs = false; // some of them with another body
};

// For what is free (lib/free): the part of the scene that names some, as a JSON pointer, or null; whether there is any; whether free bodies may push
// trees.
const char* free_part(const Scene&);
inline bool has_free_bodies(const Scene& scene) {
    return free_part(scene) != nullptr;
}
bool may_push(const Scene&);

} // namespace bough
