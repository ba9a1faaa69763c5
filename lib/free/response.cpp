#include "response.h"
#include "../coupled/own_inertia.h"
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
    place_.assign(plan.bodies, 0);
    for (std::size_t i = 0; i < plan.bodies; ++i) joint_[i] = own(plan, i);
    for (std::size_t i = plan.bodies; i-- > 0;) {
        close(plan, i, joint_[i]);
        if (tree.parent[i] >= 0 && plan.mass[i] > 0) add_child(plan, i, joint_[std::size_t(tree.parent[i])]);
    }
    begin();
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

template <class T> void TreeResponse<T>::begin() {
    for (const std::size_t i : touched_) place_[i] = 0;
    touched_.clear();
    u_.assign(1, Vec3::Zero());
}

template <class T> void TreeResponse<T>::put(std::size_t i, const Vec3& moment) {
    if (place_[i] == 0) {
        place_[i] = std::uint32_t(u_.size());
        u_.push_back(Vec3::Zero());
        touched_.push_back(i);
    }
    u_[place_[i]] += moment;
}

template <class T> void TreeResponse<T>::hand_on(const Plan<T>& plan, TreePoses<T>& poses, std::size_t from, Wrench w) {
    const BodyPose* pose = &poses.of(from);
    for (std::size_t i = from; plan.parent[i] >= 0;) {
        i = std::size_t(plan.parent[i]);
        const BodyPose* parent = &poses.of(i);
        w.moment += Vec3(pose->x - parent->x).cross(w.force);
        pose = parent;
        put(i, w.moment);
        if (!coupled_) continue;
        const Vec3 t = pose->R.transpose() * w.moment, Et = joint_[i].E * t;
        w.moment = pose->R * Vec3(spring(plan, i).cwiseProduct(Et));
        w.force -= pose->R * Vec3(joint_[i].B.transpose() * Et);
    }
}

template <class T>
void TreeResponse<T>::add(const Plan<T>& plan, TreePoses<T>& poses, std::size_t body, const Vec3& point,
                          const Vec3& impulse) {
    const BodyPose& pose = poses.of(body);
    Wrench w{Vec3(point - pose.x).cross(impulse), impulse};
    put(body, w.moment);
    if (coupled_) {
        const Vec3 t = pose.R.transpose() * w.moment, Et = joint_[body].E * t;
        w.moment = pose.R * Vec3(spring(plan, body).cwiseProduct(Et));
        w.force -= pose.R * Vec3(joint_[body].B.transpose() * Et);
    }
    hand_on(plan, poses, body, w);
}

// The moment t on the body and -t on its parent: beside what t alone hands on, Z E t, the parent takes -t: -A E t in all.
template <class T> void TreeResponse<T>::add_spring(const Plan<T>& plan, TreePoses<T>& poses, std::size_t joint) {
    const double h = plan.dt, beta = double(plan.beta[joint]);
    const Vec3 t = -h * plan.K[joint].template cast<double>().cwiseProduct(
                            Vec3(poses.theta(joint) + (h + beta) * poses.theta_dot(joint)));
    const BodyPose& pose = poses.of(joint);
    put(joint, pose.R * t);
    if (!coupled_) return; // each joint by itself
    const Vec3 Et = joint_[joint].E * t;
    hand_on(plan, poses, joint,
            {pose.R * Vec3(-(joint_[joint].A * Et)), pose.R * Vec3(-(joint_[joint].B.transpose() * Et))});
}

template <class T>
std::pair<Vec3, Vec3> TreeResponse<T>::motion(const Plan<T>& plan, TreePoses<T>& poses, std::size_t body) {
    path_.clear();
    for (std::int64_t i = std::int64_t(body); i >= 0; i = plan.parent[std::size_t(i)]) path_.push_back(std::size_t(i));
    Vec3 omega = Vec3::Zero(), v = Vec3::Zero(), x = Vec3::Zero();
    for (std::size_t k = path_.size(); k-- > 0;) {
        const std::size_t i = path_[k];
        const BodyPose& pose = poses.of(i);
        if (k + 1 < path_.size()) v += omega.cross(Vec3(pose.x - x));
        x = pose.x;
        Vec3 t = pose.R.transpose() * u_[place_[i]];
        if (coupled_) t -= joint_[i].A * Vec3(pose.R.transpose() * omega) + joint_[i].B * Vec3(pose.R.transpose() * v);
        omega += pose.R * Vec3(joint_[i].E * t);
    }
    return {omega, v};
}

template <class T>
Vec3 TreeResponse<T>::velocity(const Plan<T>& plan, TreePoses<T>& poses, std::size_t body, const Vec3& point) {
    const auto [omega, v] = motion(plan, poses, body);
    return v + omega.cross(Vec3(point - poses.of(body).x));
}

template <class T>
Mat3 TreeResponse<T>::mobility(const Plan<T>& plan, TreePoses<T>& poses, std::size_t body, const Vec3& point) {
    Mat3 W;
    const Vec3 before = velocity(plan, poses, body, point);
    for (int k = 0; k < 3; ++k) {
        add(plan, poses, body, point, Vec3::Unit(k));
        W.col(k) = velocity(plan, poses, body, point) - before;
        add(plan, poses, body, point, -Vec3::Unit(k));
    }
    return W;
}

template class TreeResponse<float>;
template class TreeResponse<double>;

} // namespace bough
