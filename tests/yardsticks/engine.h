// engine.h: other programs' articulated dynamics behind one interface, as a yardstick for lib/study.
//
// An engine is built from a Tree's masses, inertias and joints alone. It is told where the joints are, and the torques and
// forces, and answers with joint accelerations. Springs, dampers, wind and pulls are torques and forces like any other here,
// computed by hand (loads.h): no engine has the spring law of design section 4.
//
// One description of a joint for all: R_wb = R_wp R_pj R(turn), and rate, the angular velocity of the body relative to its
// parent in the body's own axes. The acceleration asked for is d rate / dt, component by component.
//   MuJoCo   a ball joint's qpos (w, x, y, z) and qvel are just these; qacc is the acceleration.
//   Simbody  Ball with F = joint frame, M = body frame: q (w, x, y, z) is turn, u is the rate in F's axes, u = R(turn) rate.
//            du/dt = R(turn) (d rate/dt + rate x rate), so the acceleration is R(turn)^T du/dt. A torque on the mobility is in F's axes.
//   dense    no engine: the mass matrix written out and solved by elimination with 113 bits. Slow and plain, with digits to spare:
//            it says which of the others is wrong where they differ.
#pragma once
#include "lib/model/tree.h"
#include <memory>
#include <vector>

namespace yardstick {

using bough::Mat3;
using bough::Quat;
using bough::Tree;
using bough::Vec3;

struct Motion {
    std::vector<Quat> turn; // joint frame from body
    std::vector<Vec3> rate; // [rad/s] body axes
};

// Where the engine finds the bodies: its own kinematics.
struct Bodies {
    explicit Bodies(std::size_t n) : R_wb(n), joint(n), com(n), com_velocity(n), omega(n) {}
    std::vector<Mat3> R_wb;                            // world from body
    std::vector<Vec3> joint, com, com_velocity, omega; // [m], [m], [m/s], [rad/s] world
};

struct Loads {
    explicit Loads(std::size_t n) : torque(n), force(n), moment(n) {}
    std::vector<Vec3> torque; // [N m] on the body at its joint, body axes; its opposite acts on the parent
    std::vector<Vec3> force;  // [N] at the centre of mass, world
    std::vector<Vec3> moment; // [N m] on the body, world
};

class Engine {
public:
    virtual ~Engine() = default;
    virtual const char* name() const = 0;
    virtual void move(const Motion&, Bodies&) = 0;
    // At the motion given last. Writes [rad/s^2], body axes.
    virtual void accelerate(const Loads&, std::vector<Vec3>& acceleration) = 0;
};

// gravity [m/s^2]. Throw std::runtime_error where the engine refuses the tree.
std::unique_ptr<Engine> make_mujoco(const Tree&, const Vec3& gravity);
std::unique_ptr<Engine> make_simbody(const Tree&, const Vec3& gravity);
std::unique_ptr<Engine> make_dense(const Tree&, const Vec3& gravity);

} // namespace yardstick
