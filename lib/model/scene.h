// scene.h: what acts on the trees and how the run is made: the document that people write. What a scene does not name is absent (std::optional, empty
// vector). What is absent is not run, not allocated and not written (plan.h).
#pragma once
#include "../base/math.h"
#include "tree.h"
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bough {

// Names a body so that the name survives another segmentation, in exactly one of four ways.
struct Selector {
    enum class By : std::uint8_t { body, branch, nearest, level };
    By by = By::body;
    std::int32_t tree = 0;       // which of the scene's trees (for body and branch); index into Scene::trees
    std::int64_t body = 0;       // by body: its index in that tree's document ...
    std::optional<Vec3> point;   // ... and [m] a point in its frame; absent: its centre of mass
    std::int32_t branch = 0;     // by branch: number in the splines ...
    double at = 1;               // ... and fraction of its arc length, 0..1
    Vec3 nearest = Vec3::Zero(); // by nearest: [m] world point, drawn pose; the body whose axis is nearest to it
    std::int32_t level = 0;      // by level: every branch body of this level
};

// Where a selector points: a body and a point on it (body frame).
struct Selected {
    std::size_t body;
    Vec3 point_b; // [m] body frame: on the axis at `at` (branch), nearest point on the axis (nearest), centre of mass
};

// Returns the bodies that a selector names in the joined tree. TreeRange: the first body and the first branch of each of the scene's trees. Throws
// std::out_of_range with what was asked for and what there is. O(bodies).
struct TreeRange {
    std::size_t first_body, bodies;
    std::int32_t first_branch;
};
std::vector<Selected> select(const Tree& joined, const std::vector<TreeRange>&, const Selector&);

struct Placement {
    std::string file;             // tree document, relative to the scene file
    Vec3 position = Vec3::Zero(); // [m]
    double yaw = 0;               // [deg] about +Y
    double start = 0; // [s] how far ahead in the wind this tree is: it sees at t what others see at t + start
    std::shared_ptr<const Tree> tree = nullptr; // in memory, in place of the file; several places may share one
};

// A square grid over the ground, seen from above, with the wind's velocity in each of its cells. Outside, the nearest cell's velocity holds. A list
// holds one value for all cells or one for each, row by row: columns are counted along x, rows along z.
struct WindGrid {
    double x = 0, z = 0; // [m] least corner
    double cell = 0;     // [m] side of a cell
    std::int32_t columns = 0, rows = 0;
    std::vector<Vec3> velocity; // [m/s] mean at the reference height; empty: the wind's own in each
    std::vector<std::int32_t> octaves{0};
    std::vector<double> persistence{0.5}; // [1] amplitude of an octave over that of the one below
    // [rad] of the first octave at time 0; all of a cell's octaves are as far ahead in time
    std::vector<double> phase{0};
    double frequency = 0.2; // [Hz] of the first octave

    bool operator==(const WindGrid&) const = default;
};

// A wind that turns to and fro about the vertical, on cylinders about one axis.
struct WindSwirl {
    double x = 0, z = 0;              // [m] where the axis stands
    std::vector<double> radius;       // [m] of the keys, rising; empty: one angle everywhere
    std::vector<double> angle;        // [deg] largest turn at each key
    double period = 4;                // [s]
    std::optional<double> wavelength; // [m] along the radius, outward; absent: all cylinders turn at once

    bool operator==(const WindSwirl&) const = default;
};

// Trees behind trees, and behind their own crown, have less wind (shelter.h).
struct WindShelter {
    double cell = 0; // [m] side of the columns of air

    bool operator==(const WindShelter&) const = default;
};

// Wind (one definition for all). The velocity at height y above the ground and time t is
//   u(y, t) = (y / reference_height)^profile * [ V (1 + (gust_factor - 1) g(t / gust_period)) + |V| turbulence q(t) ]
// g has mean 0, peak 1, period 1. q has unit variance along V, and 0.75 and 0.5 times that across and up. With a grid the cell's own velocity takes
// the place of the first V; a swirl turns what is in brackets (wind_field.h).
struct Wind {
    Vec3 velocity = Vec3::Zero(); // [m/s] mean at the reference height, blowing toward
    double reference_height = 10; // [m]
    double profile = 0.15;        // [1] exponent over height, 0: uniform
    double turbulence = 0;        // [1] intensity: standard deviation along the wind over the mean
    double gust_factor = 1;       // [1] peak over mean, 1: no gusts
    double gust_period = 6;       // [s]
    std::uint64_t seed = 1;       // of the turbulence, and of the grid's higher octaves
    std::optional<WindGrid> grid;
    std::optional<WindSwirl> swirl;
    std::optional<WindShelter> shelter;
    // [s] after which all of it repeats: each frequency is the nearest multiple of 1 / period, at least one
    std::optional<double> period;
    // [s] How far turbulence and gusts are ahead of time, for a wind that was changed in a run (go_on of laws/wind_weather.h). No document holds
    // these.
    double turbulence_ahead = 0, gust_ahead = 0;

    bool operator==(const Wind&) const = default;
};
// The presets are calm 1, breeze 4, gusty 8 and storm 20 m/s along +x. Returns nullopt for another name.
std::optional<Wind> wind_preset(const std::string& name);

// A force on a point of a body over time: linear between keys, zero before the first and after the last key.
struct Pull {
    Selector on;
    std::vector<double> time; // [s] rising
    std::vector<Vec3> force;  // [N] one per time: world, or
    bool in_body = false; // in the body's axes, with which it turns; for the coupled solver (coupled/pulled_points.h)
};

// A spring and a damper between a point of a body and a point in space, which may move: a hand, a rope, a prop, a wire. The force on the body is
//   f = -stiffness (x - target) - damping (x' - target')
// while from <= t < to, which each step decides by its middle (coupled/attachment.h, analytic/held_points.h).
// It may also tie points of two bodies, of one tree or of two, with the opposite force on the other body: a hammock, a cable, tied branches. x and x'
// are then relative to the other point, in the world's axes.
struct Attachment {
    Selector on;                  // by level: one for each of its bodies
    std::optional<Selector> with; // the other body; not by level
    std::optional<Vec3> target;   // [m] world, at rest; absent, and without keys: where the point is at the run's start
    // [s] rising: keys of a target that moves through them as RootMotion does; none, or at least two
    std::vector<double> time;
    std::vector<Vec3> position; // [m] world, one per time
    double stiffness = 0;       // [N/m] 0 or more
    double damping = 0;         // [N s/m] 0 or more
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity(); // [s]
};

// Moves a tree with the ground under it by a smooth curve through keys (root_motion.h). There are at least two keys. Either position or rotation may
// be empty, not both.
struct RootMotion {
    std::int32_t tree = 0;      // which of the scene's trees
    std::vector<double> time;   // [s] rising
    std::vector<Vec3> position; // [m] displacement from where the tree stands, one per time
    std::vector<Quat> rotation; // about the tree's own place (its Placement's position), one per time; unit length
};

// A walker on the trees: a weight on a branch that runs from place to place, and leaps where the next place is on another tree (walker.h).
struct Walker {
    double mass = 0.4;    // [kg]
    double radius = 0.06; // [m] of the ball that it is shown as
    double push = 0.1;    // [s] how long a leap's push takes, and its landing
    struct Stop {
        Selector on;       // one body; not by level
        double time = 0;   // [s] rising
        bool leap = false; // to here through the air, also where wood leads here
    };
    std::vector<Stop> stops; // at least two
};

// What a scene changes of its trees' wood (wood_overrides.h): factors by kind, then curves, then forks.
struct WoodFactors {
    double stiffness = 1, damping = 1, density = 1; // [1]
};
struct WoodCurve {
    std::optional<Selector> on; // these bodies and all they carry; absent: all trees
    std::vector<double> radius; // [m] keys, rising: of the body that the joint carries, at its base
    std::vector<double> stiffness,
        damping;           // [N m/rad] of both bends, [s]; one for each key; either may be empty: stays
    bool relative = false; // they multiply what the joints have
};
struct WoodFork {
    double factor = 1; // [1] stiffness at a fork over what it would be
    double length = 0; // [m] way from the fork over which that falls to 1
};
struct Wood {
    WoodFactors branch, leaf, petal, fruit;
    std::vector<WoodCurve> curves; // branches only; later ones come before earlier ones
    std::optional<WoodFork> fork;
};

// A load that lies on the trees, as snow and rain do: mass over their area seen from above (static_load.h).
struct StaticLoad {
    double branch = 0, leaf = 0, petal = 0, fruit = 0; // [kg/m^2]
};

// Multipliers of those terms of (20) that come from the joints' own motion, one step late. They are for the analytic solver (fictitious.h).
struct Fictitious {
    double acceleration = 0; // [1] of -m p x a_j
    double turning = 0;      // [1] of -I (alpha_p + omega_p x omega_c)
    double gyroscopic = 0;   // [1] of -omega x (I omega)
};

// Which joints move; all others are rigid (hold.h, reduce.h). A joint moves if all of the given rules let it.
struct Simulate {
    std::optional<std::int32_t> first_level, last_level; // of branches; what grows on one goes with it
    double radius = 0;                                   // [m] least, of a branch's body at its base
    std::vector<Selector> subtrees;                      // these bodies and all they carry; empty: all
    struct Box {
        Vec3 least = Vec3::Zero(), most = Vec3::Zero(); // [m] world, drawn pose: holds the joint
    };
    std::optional<Box> box;
    double error = 0; // [m], or pixels with a view: what rigid joints may move any end by, by an estimate (hold.h)
    struct View {
        Vec3 from = Vec3::Zero(); // [m]
        double angle = 40;        // [deg] of view, upright
        double pixels = 1080;     // height of the picture
    };
    std::optional<View> view;
};

enum class Pose : std::uint8_t {
    drawn,   // the drawn tree is the equilibrium under gravity
    settled, // the drawn tree is unloaded; the run starts at its sag
    rest     // the drawn tree is unloaded; the run starts from it
};

// A joint breaks when the torque of its spring and damper, |T^T K (theta + beta theta_dot)|, exceeds its threshold; what it carried then falls
// (free/fracture.h). An infinite threshold means never.
struct Fracture {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double branch = never, leaf = never, petal = never,
           fruit = never; // [N m] by the kind of the body that the joint carries
    // [Pa] bending stress that wood stands: a branch's joint of radius r breaks at strength pi r^3 / 4 too
    double strength = never;
    double spread = 0; // [1] each joint's threshold is times e^(spread z), z of a standard normal distribution by seed
    std::uint64_t seed = 1;
    struct Joint { // thresholds of single bodies, which come before the others
        Selector on;
        double torque = never; // [N m]
    };
    std::vector<Joint> joints;
};

// A free ball.
struct Ball {
    Vec3 position = Vec3::Zero();         // [m] of its centre
    Vec3 velocity = Vec3::Zero();         // [m/s]
    Vec3 angular_velocity = Vec3::Zero(); // [rad/s]
    double radius = 0.1;                  // [m]
    double mass = 1;                      // [kg]
};

// How free bodies meet trees and ground (free/contact.h).
enum class ContactModel : std::uint8_t {
    impulse, // one impulse a contact, equal and opposite
    penalty  // the paper's pair: a penalty force on the tree, an impulse of an infinite mass on the free body
};
struct Contact {
    ContactModel model = ContactModel::impulse;
    double restitution = 0.2; // [1] 0..1
    double friction = 0.5;    // [1] Coulomb's
    double rolling = 0.03;    // [1] rolling resistance on the ground: lever of its push over the body's radius
    double penalty = 50;      // [N s/m] zeta of the paper's pair
    bool trees = true;        // what is free meets branches and fruit
    bool leaves = false;      // ... leaves and petals too, and what falls of these meets trees
    bool ground = true;       // there is one
    double ground_height = 0; // [m]
};

// Which inertia a joint's oscillator has (spring.h).
enum class JointInertia : std::uint8_t {
    branch, // scaled so that the branch's first mode keeps its frequency under any segmentation
    paper   // the composite's own, as in the paper
};

// The largest angles of the joints from their springs' rest, about each axis of the joint frame, for branches, for leaves and petals, and for fruit
// (joint_limit.h). Each is above 0; 180 means no limit.
struct JointLimit {
    Vec3 branch{180, 180, 180}, leaf{180, 180, 180}, fruit{180, 180, 180}; // [deg]
};

// The air on leaves and petals by (23) and (24) of the paper in full, both on those that hang (leaf_air.h) and on those that fly (leaf_flight.h).
// Without it those that hang have only the first term of (23), with kappa 0.6.
struct LeafAir {
    double kappa = 0.6;        // [1] scales what the air's pressure does: half of a plate's drag coefficient
    double air_resistance = 4; // [1/s] nu: of motion along the normal, and of turning
    double drag_ratio = 5;     // [1] xi: how much less of motion along the surface; above 0
    double offset = 0;         // [deg] phi: turns the torque's axis about the normal: a leaf that flies spirals
};

struct Scene {
    std::vector<Placement> trees; // may be empty where the caller has the tree already
    Vec3 gravity{0, -9.81, 0};    // [m/s^2]; zero: absent
    std::optional<Wind> wind;
    double air_density = 1.2; // [kg/m^3]
    std::vector<Pull> pulls;
    std::vector<Attachment> attachments;
    std::vector<RootMotion> root_motion; // at most one for a tree
    Pose pose = Pose::drawn;
    JointInertia joint_inertia = JointInertia::branch;
    double stiffness_scale = 1; // [1] multiplies every K
    double damping_scale = 1;   // [1] multiplies every beta
    std::optional<JointLimit> joint_limit;
    std::optional<Fracture> fracture;
    std::vector<Ball> balls;
    std::optional<Contact> contact; // absent: its defaults, where something is free
    std::optional<LeafAir> leaves;
    std::optional<Wood> wood;
    std::optional<StaticLoad> load;
    std::optional<Fictitious> fictitious;
    std::optional<Simulate> simulate;
    std::vector<Walker> walkers;

    // Adds a tree that is in memory, at a place on the ground [m], turned by yaw [deg] about +Y. Returns its number in `trees`.
    std::size_t add(Tree, const Vec3& position = Vec3::Zero(), double yaw = 0);
    std::size_t add(std::shared_ptr<const Tree>, const Vec3& position = Vec3::Zero(), double yaw = 0);
};

// True if nothing acts on the trees except the weight that they stand under.
inline bool stands_still(const Scene& s) {
    return !s.wind && s.pulls.empty() && s.attachments.empty() && s.root_motion.empty() && !s.fracture &&
           s.balls.empty() && s.walkers.empty() && (s.pose != Pose::rest || s.gravity.isZero());
}

// Returns the first broken rule, or none. O(keys).
std::optional<Defect> check(const Scene&);

} // namespace bough
