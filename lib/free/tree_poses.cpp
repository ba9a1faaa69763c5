#include "tree_poses.h"
#include "../base/parallel.h"
#include "../base/rotation_maps.h"

namespace bough {

template <class T> void TreePoses<T>::begin(const Plan<T>& plan, const State<T>& state) {
    plan_ = &plan;
    time_ = time_of(plan, state);
    if (place_.size() != plan.bodies) place_.assign(plan.bodies, 0);
    for (const std::size_t body : body_) place_[body] = 0;
    body_.clear();
    pose_.clear();
    pose_.emplace_back(); // place 0 is nobody's
    plan.stepper->view_motion(state, motion_);
}

template <class T> void TreePoses<T>::begin_copy(const Plan<T>& plan, const State<T>& state) {
    copy_.clear();
    begin(plan, state);
    std::vector<Vector3<T>> all(plan.bodies);
    parallel_for(plan.bodies, 10, [&](std::size_t i) { all[i] = theta(i).template cast<T>(); });
    copy_ = std::move(all);
}

template <class T> Vec3 TreePoses<T>::theta(std::size_t body) const {
    return copy_.empty() ? motion_.theta_of(body) : Vec3(copy_[body].template cast<double>());
}

template <class T> Vec3 TreePoses<T>::theta_dot(std::size_t body) const {
    return motion_.theta_dot_of(body);
}

template <class T> void TreePoses<T>::add(std::size_t i) {
    const RotationMaps<double> maps = rotation_maps(theta(i));
    const Mat3 R_pj = plan_->R_pj[i].template cast<double>();
    const Vec3 d = plan_->joint_position[i].template cast<double>();
    BodyPose pose;
    if (plan_->parent[i] >= 0) {
        const BodyPose& p = pose_[place_[std::size_t(plan_->parent[i])]];
        pose.R_joint = p.R * R_pj;
        pose.x = p.at(d);
        pose.omega = p.omega;
        pose.v = p.velocity_at(pose.x);
    } else {
        const std::int64_t spline = plan_->root_motion ? spline_under(plan_->moved, i) : -1;
        const Ground ground = spline < 0 ? Ground() : ground_at(plan_->splines[std::size_t(spline)], time_);
        pose.R_joint = ground.R * R_pj;
        pose.x = ground.x + ground.R * d;
        pose.omega = ground.omega;
        pose.v = ground.v + ground.omega.cross(Vec3(ground.R * d));
    }
    pose.R = pose.R_joint * maps.R;
    if (copy_.empty()) pose.omega += pose.R_joint * (maps.J * theta_dot(i));
    place_[i] = std::uint32_t(pose_.size());
    pose_.push_back(pose);
    body_.push_back(i);
}

template <class T> const BodyPose& TreePoses<T>::of(std::size_t body) {
    path_.clear();
    for (std::size_t i = body; place_[i] == 0; i = std::size_t(plan_->parent[i])) {
        path_.push_back(i);
        if (plan_->parent[i] < 0) break;
    }
    while (!path_.empty()) {
        add(path_.back());
        path_.pop_back();
    }
    return pose_[place_[body]];
}

#define BOUGH_INSTANTIATE(T) template class TreePoses<T>;
#include "../base/instantiate.inc"

} // namespace bough
