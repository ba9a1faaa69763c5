// coupled_body.h: what the coupled step works in, one record a body (coupled_step.h names the sweeps that fill it).
#pragma once
#include "../base/math.h"
#include <cstdint>

namespace bough {

// All are in world axes, about the body's own joint. y*: the evaluation point, half a step on. y0: the start.
template <class T> struct CoupledBody {
    // midpoint.h
    Matrix3<T> R;            // world from body, at y*
    Matrix3<T> rates;        // T G^T: theta_dot from the joint's angular velocity
    Vector3<T> r;            // [m] own joint from the parent's
    Vector3<T> x;            // [m] own joint
    Vector3<T> c;            // [m] centre of mass from the joint
    Vector3<T> omega, v;     // [rad/s], [m/s] at y*
    Vector3<T> omega_0, v_0; // of y0's rates in y*'s pose
    Vector3<T> turn;         // [rad] psi: from y0 to y*, by the joints alone
    Vector3<T> alpha_0, a_0; // [rad/s^2], [m/s^2] where no joint accelerates: biases

    // body_load.h
    Matrix3<T> J;                // [kg m^2] inertia
    Matrix3<T> H;                // [N m/rad] gravity's stiffness and the air's in turning
    Matrix3<T> D;                // [N s/m] the air's damping at the centre of mass; with wind alone
    Vector3<T> air;              // [N] the air's force at y*; with wind alone
    T spin;                      // [1/s] what the air takes of its own turning, times I; with wind alone
    Vector3<T> N, F;             // [N m], [N] that the motion at y* with those biases asks for, less the forces
    Vector3<T> slope_N, slope_F; // [N m], [N] what they change by over the step with time; with wind or pulls
    Vector3<T> torque;           // [N m] of the joint's own spring and damper at y0
    Vector3<T> torque_rate;      // [N m/s] how y0's rates change the spring's
};

// What the solve works in (resolvent.h). S: std::complex<T>, or T for a scheme with a real pole.
template <class S> struct ResolventBody {
    Eigen::Matrix<S, 3, 3> A, B, M;  // [kg m^2], [kg m], [kg] articulated
    Eigen::Matrix<S, 3, 3> E;        // (A + Z)^-1
    Eigen::Matrix<S, 3, 1> N, F;     // [N m], [N]
    Eigen::Matrix<S, 3, 1> u;        // [N m] the joint's torque less N
    Eigen::Matrix<S, 3, 1> alpha, a; // [rad/s^2], [m/s^2] beyond the biases
};

// A body as the energy guard weighs it (energy_guard.h). Velocities are at its joint, world, split into what slow joints and what fast ones cause.
template <class T> struct GuardBody {
    Vector3<T> com, joint;         // [m] at the step's start
    Vector3<T> v, omega;           // [m/s], [rad/s]
    Vector3<T> v_fast, omega_fast; // [m/s], [rad/s]
    // For ends of branches: the centre of mass from the joint at the start, in the axes of what carries it [m]; the velocity that it would have had,
    // borne as if fixed, and had [m/s]; its carrier's turning [rad/s]; pulls on it [N].
    Vector3<T> arm, carried, host_omega, push;
    double own = 0;         // [J] kinetic and elastic at the start, as seen from what carries it
    T keep = 1;             // what its rate is scaled by
    std::uint32_t tree = 0; // account
    bool fast = false;
};

// The energies [J] of one root's tree in one step.
struct EnergyAccount {
    bool watched = false; // some body of the tree turns fast
    bool wood = false;    // and one of wood
    double kinetic = 0,
           gained = 0; // at the start; potential energy gained in the step less the work done by the air and pulls
    double slow = 0, mixed = 0, fast = 0; // kinetic at the end, (slow + 2 x mixed + x^2 fast) at x = 1
    double keep_fast = 1, keep_slow = 1;  // what the rates are scaled by
};

// The ground over one step, world (ground_course.h): its pose and velocities half a step on, its velocities at the start, its mean accelerations and
// their change.
template <class T> struct GroundStep {
    Matrix3<T> R;
    Vector3<T> x, v, omega, v_0, omega_0;
    Vector3<T> a, alpha, slope_a, slope_alpha;
    bool jumps; // within the step
};

} // namespace bough
