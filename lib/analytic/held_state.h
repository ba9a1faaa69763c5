// held_state.h: attachments as the analytic solver keeps them in a state (held_points.h).
#pragma once
#include "../plan/attached.h"
#include "spring_load.h"
#include <Eigen/Cholesky>

namespace bough {

// A joint between a point that is held and the ground.
template <class T> struct HeldJoint : PathJoint { // one of HeldPoints::joints
    int depth;                                    // joints from the ground to it, itself too

    // Of the step.
    SpringJoint<T> load;
    Matrix3<T> L; // S = L L^T, body axes
    Mat3 R;       // world from body
    Vec3 x;       // [m]
    Mat3 give;    // [rad/(N m)] E_j, then S_j^-1 [1/(kg m^2)], world
    double row;   // [N m/rad] gamma_j
    Vec3 turn;    // [rad] over the step
    Vec3 moment;  // [N m], then [N m s]
};

// The part of an attachment that Attached, which both solvers share, has no place for.
struct HeldForce {
    double kappa, g; // [N/m], [kg]
    double most;     // [N] F
    Vec3 before;     // [N] the last step's force
};

template <class T> struct HeldPoints {
    std::vector<Attached> all;
    std::vector<HeldForce> forces;    // of each of them
    std::vector<HeldJoint<T>> joints; // rising

    Eigen::MatrixXd answers; // what a unit of each force makes of each point's way
    Eigen::VectorXd asked, solved;
    std::optional<Eigen::LDLT<Eigen::MatrixXd>> factors;

    bool any() const { return !joints.empty(); }
    // Counts what is allocated, except a few numbers a force beside the factors.
    std::size_t bytes() const {
        const auto numbers =
            answers.size() + asked.size() + solved.size() + (factors ? factors->matrixLDLT().size() : 0);
        return all.capacity() * sizeof(Attached) + forces.capacity() * sizeof(HeldForce) +
               joints.capacity() * sizeof(HeldJoint<T>) + std::size_t(numbers) * sizeof(double);
    }
};

} // namespace bough
