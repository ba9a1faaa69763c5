#include "response.h"
#include "../model/own_inertia.h"
#include <Eigen/LU>

namespace bough {

template <class T> typename TreeResponse<T>::Joint TreeResponse<T>::own(const Plan<T>& plan, std::size_t i) const {
    Joint joint;
    const double m = double(plan.mass[i]);
    joint.A = own_inertia(Mat3(plan.inertia_joint[i].template cast<double>()));
    joint.B = m * cross_matrix(Vec3(plan.com[i].template cast<double>()));
    joint.M = m * Mat3::Identity();
    return joint;
}

template <class T> Vec3 TreeResponse<T>::spring(const Plan<T>& plan, std::size_t i) const {
    if (!sprung_) return Vec3::Zero();
    const double h = plan.dt; // at rest body axes are the joint's
    return (h * double(plan.beta[i]) + h * h) * plan.K[i].template cast<double>();
}

template <class T> void TreeResponse<T>::close(const Plan<T>& plan, std::size_t i, Joint& joint) const {
    Mat3 D = joint.A;
    if (!coupled_) { // as its oscillator has it (joint.h)
        const Vec3 f = plan.stepper->inertia_factor()[i].template cast<double>();
        D = f.asDiagonal() * D * f.asDiagonal();
    }
    D.diagonal() += spring(plan, i);
    joint.E = D.inverse();
    joint.E = (0.5 * (joint.E + joint.E.transpose())).eval();
}

// To the parent's joint, in its axes.
template <class T> void TreeResponse<T>::add_child(const Plan<T>& plan, std::size_t child, Joint& parent) const {
    const Joint& c = joint_[child];
    Mat3 A = c.A, B = c.B, M = c.M;
    if (coupled_) {
        const Mat3 EB = c.E * c.B;
        A = c.A - c.A * c.E * c.A;
        B = c.B - c.A * EB;
        M = c.M - c.B.transpose() * EB;
    }
    const Mat3 R = plan.R_pj[child].template cast<double>();
    A = R * A * R.transpose();
    B = R * B * R.transpose();
    M = R * M * R.transpose();
    const Mat3 r = cross_matrix(Vec3(plan.joint_position[child].template cast<double>()));
    const Mat3 moved = B + r * M; // moments about the parent's joint of what velocities of the child's ask for
    parent.A += A - B * r + r * B.transpose() - r * M * r;
    parent.B += moved;
    parent.M += M;
}

template <class T> void TreeResponse<T>::make(const Plan<T>& plan, const Tree& tree, const Subtrees&, bool sprung) {
    sprung_ = sprung;
    coupled_ = plan.stepper->inertia_factor().empty();
    joint_.resize(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) joint_[i] = own(plan, i);
    for (std::size_t i = plan.bodies; i-- > 0;) {
        close(plan, i, joint_[i]);
        if (tree.parent[i] >= 0 && plan.mass[i] > 0) add_child(plan, i, joint_[std::size_t(tree.parent[i])]);
    }
}

template <class T>
void TreeResponse<T>::remake(const Plan<T>& plan, const Subtrees& trees, const std::vector<std::size_t>& bodies) {
    for (const std::size_t i : bodies) {
        Joint joint = own(plan, i);
        for (std::uint32_t k = trees.first_child[i + 1]; k-- > trees.first_child[i];)
            if (plan.mass[trees.child[k]] > 0) add_child(plan, trees.child[k], joint); // in make()'s order
        close(plan, i, joint);
        joint_[i] = joint;
    }
}

#define BOUGH_INSTANTIATE(T) template class TreeResponse<T>;
#include "../base/instantiate.inc"

} // namespace bough
