// attachment_state.h: attachments as the coupled solver keeps them in a state (attachment.h).
#pragma once
#include "../plan/attached.h"
#include <Eigen/LU>
#include <complex>
#include <vector>

namespace bough {

// What attachments add to one body's part of a step's solve, in world axes, about its joint. Each is multiplied by 1/s^2, 1/s, or the slope of
// attachment.h.
struct AttachmentSums {
    Mat3 A_stiffness, A_damping; // [N m/rad], [N m s/rad]; the first with H
    Vec3 B_stiffness, B_damping; // [N], [N s] the vector of a cross product
    double stiffness, damping;   // [N/m], [N s/m]
    Vec3 N, N_slope, N_rate;     // [N m]; N_rate [N m/s], as F_rate
    Vec3 F, F_slope, F_rate;     // [N]
    // What the masses at points would make of the moving ground's own acceleration, whose way the targets already have: times 1/s^2, 1/s, and both
    // times its slope.
    Vec3 N_ground[4], F_ground[4];
};

// The motion of a joint at a step's start, with the changes over the last step.
struct JointNow {
    Vec3 theta, eta, theta_change, eta_change;
};

// A body that is attached, or that carries one.
struct AttachedBody : PathJoint {                // one of Attachments::bodies
    std::uint32_t slot = 0, block = 0, base = 0; // in lanes: where it stands, the chain's place in Layout::base

    JointNow now;
    // At y*, world, as in CoupledBody. own: by the joints' rates at y0 alone. v: its velocity at the joint. x_start, R_start: at y0.
    Mat3 R_start, R, GJ;
    Vec3 x_start, x, turn, own, v;
    Vec3 r; // from the joint that carries it, or the ground's place
    AttachmentSums sums;
    // For pulls on it and on what it carries: their force; the rad/(N m) by which the joints to the ground give; the sum of pulled_points.h.
    Vec3 pulled;
    double give, share;
    Vec3 turned, moved; // [rad], [m] over the step, in the linear model
    Vec3 spun, sped;    // [rad/s], [m/s] likewise: rates
};

using ComplexVec3 = Eigen::Vector3cd;
using ComplexMat3 = Eigen::Matrix3cd;

// A pull of the scene's (pulled_points.h).
struct PulledPoint : AttachedEnd {
    std::size_t source = 0; // index into Scene::pulls; or of_caller: State::loads of this step
    bool turns = false;     // Pull::in_body
    // Of the step:
    bool on = false;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); // [N], [N m] about the joint, at y*
    double work = 0;                                  // [J] done on the tree
};

constexpr std::size_t of_caller = ~std::size_t(0);

// What the sweeps cannot eliminate (attachment_ties.h): an attachment between two bodies, or a pulled point.
struct Tie {
    bool follows = false;
    std::size_t of = 0; // in Attachments::all, in pulled
    // For a pair, at the near point: F, F_slope, F_rate and F_ground as in AttachmentSums.
    Vec3 F = Vec3::Zero(), slope = Vec3::Zero(), rate = Vec3::Zero();
    Eigen::Matrix<double, 3, 4> ground = Eigen::Matrix<double, 3, 4>::Zero();
};

// A body of `bodies` in the solve at one pole, as in resolvent.h: E, E A, E B, E u.
struct SolvedBody {
    ComplexMat3 E, EA, EB;
    ComplexVec3 Eu;
    ComplexVec3 alpha, a;     // accelerations
    ComplexVec3 N, F;         // what is pushed on it and what it carries
    ComplexVec3 moment, gain; // what ties add to N_0, to E u
};

struct Attachments {
    std::vector<Attached> all;
    std::vector<AttachedBody> bodies; // rising
    std::uint64_t numbers = 0;        // given so far
    std::vector<PulledPoint> pulled;  // the plan's, then the caller's
    std::vector<std::size_t> touched; // find_bodies' own

    // With ties alone.
    std::vector<Tie> ties;
    std::vector<SolvedBody> solved; // of `bodies`
    Eigen::MatrixXcd answers;       // what a unit of each tie's unknowns makes of each tie's
    Eigen::VectorXcd asked, unknowns;
    Eigen::PartialPivLU<Eigen::MatrixXcd> factors;

    bool any() const { return !bodies.empty(); }
    // Counts what is in use: arrays may have room for more, and the factors hold a few further numbers.
    std::size_t bytes() const {
        const auto of = [](const auto& array) { return array.size() * sizeof(array[0]); };
        const auto of_equations = answers.size() + asked.size() + unknowns.size() + factors.rows() * factors.cols();
        return of(all) + of(bodies) + of(pulled) + of(touched) + of(ties) + of(solved) +
               std::size_t(of_equations) * sizeof(std::complex<double>);
    }
};

} // namespace bough
