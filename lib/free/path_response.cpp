#include "path_response.h"
#include "../base/parallel.h"
#include <algorithm>

namespace bough {

template <class T>
PathResponse::PathResponse(const Plan<T>& plan, TreePoses<T>& poses, const TreeResponse<T>& sprung,
                           const TreeResponse<T>& rigid, std::span<const std::int64_t> bodies)
    : coupled_(sprung.coupled()) {
    std::vector<std::size_t> joints;
    for (const std::int64_t body : bodies)
        for (std::int64_t i = body; i >= 0; i = plan.parent[std::size_t(i)]) joints.push_back(std::size_t(i));
    std::sort(joints.begin(), joints.end());
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    const auto link_of = [&](std::int64_t i) {
        return std::uint32_t(std::lower_bound(joints.begin(), joints.end(), std::size_t(i)) - joints.begin());
    };
    link_.resize(joints.size());
    rigid_.resize(joints.size());
    spring_.resize(joints.size());
    std::vector<const BodyPose*> pose;
    for (std::size_t l = 0; l < joints.size(); ++l) {
        pose.push_back(&poses.of(joints[l]));
        const std::int64_t parent = plan.parent[joints[l]];
        parent_.push_back(parent < 0 ? -1 : std::int32_t(link_of(parent)));
    }
    const double h = plan.dt;
    parallel_for(joints.size(), 500, [&](std::size_t l) {
        const std::size_t i = joints[l];
        const Mat3& R = pose[l]->R;
        const auto answer = [&](const typename TreeResponse<T>::Joint& joint) {
            const Mat3 ER = joint.E * R.transpose();
            Answer a{R * ER, Mat3::Zero(), Mat3::Zero()};
            if (coupled_) {
                a.EA = R * joint.E * joint.A * R.transpose();
                a.EB = R * joint.E * joint.B * R.transpose();
            }
            return a;
        };
        Link& link = link_[l];
        link.answer = answer(sprung.joint(i));
        rigid_[l] = answer(rigid.joint(i));
        link.x = pose[l]->x;
        link.e.setZero();
        const Vec3 slack = poses.theta(i) + (h + double(plan.beta[i])) * poses.theta_dot(i);
        spring_[l] = R * Vec3(-h * plan.K[i].template cast<double>().cwiseProduct(slack));
    });
    first_.assign(1, 0);
    for (const std::int64_t body : bodies) {
        if (body >= 0)
            for (std::int64_t l = link_of(body); l >= 0; l = parent_[std::size_t(l)]) path_.push_back(std::uint32_t(l));
        std::reverse(path_.begin() + std::ptrdiff_t(first_.back()), path_.end());
        first_.push_back(path_.size());
    }
}

void PathResponse::forget_impulses() {
    for (Link& link : link_) link.e.setZero();
}

void PathResponse::apply_impulse(std::size_t k, const Vec3& point, const Vec3& impulse) {
    const std::span<const std::uint32_t> path = this->path(k);
    Vec3 at = point, moment = Vec3::Zero(), force = impulse;
    for (std::size_t p = path.size(); p-- > 0;) {
        Link& link = link_[path[p]];
        moment += Vec3(at - link.x).cross(force);
        at = link.x;
        link.e += link.answer.E * moment;
        if (!coupled_) continue;
        const Vec3 u = moment;
        moment -= link.answer.EA.transpose() * u;
        force -= link.answer.EB.transpose() * u;
    }
}

void PathResponse::apply_springs() {
    struct Wrench {
        Vec3 moment = Vec3::Zero(), force = Vec3::Zero();
    };
    std::vector<Wrench> handed(link_.size()); // by what a joint carries, about itself
    for (std::size_t l = link_.size(); l-- > 0;) {
        Link& link = link_[l];
        Wrench w = handed[l];
        const Vec3 u = w.moment + spring_[l];
        link.e += link.answer.E * u;
        if (!coupled_ || parent_[l] < 0) continue; // each joint by itself
        w.moment -= link.answer.EA.transpose() *
                    u; // Z E t of a moment t; of the spring's, whose opposite the parent takes, -A E t
        w.force -= link.answer.EB.transpose() * u;
        Wrench& parent = handed[std::size_t(parent_[l])];
        parent.moment += w.moment + Vec3(link.x - link_[std::size_t(parent_[l])].x).cross(w.force);
        parent.force += w.force;
    }
}

Vec3 PathResponse::velocity(std::size_t k, const Vec3& point) const {
    Vec3 omega = Vec3::Zero(), v = Vec3::Zero(), x = Vec3::Zero();
    for (const std::uint32_t l : path(k)) {
        const Link& link = link_[l];
        v += omega.cross(Vec3(link.x - x)); // nothing turns before the first
        x = link.x;
        if (coupled_)
            omega += link.e - link.answer.EA * omega - link.answer.EB * v;
        else
            omega += link.e;
    }
    return v + omega.cross(Vec3(point - x));
}

// apply_impulse() and velocity() for three impulses at once, along the axes.
Mat3 PathResponse::mobility(std::size_t k, const Vec3& point, bool sprung) const {
    const std::span<const std::uint32_t> path = this->path(k);
    std::vector<Mat3> turned(path.size());
    Vec3 at = point;
    Mat3 moment = Mat3::Zero(), force = Mat3::Identity();
    for (std::size_t p = path.size(); p-- > 0;) {
        const Link& link = link_[path[p]];
        const Answer& a = sprung ? link.answer : rigid_[path[p]];
        moment += cross_matrix(Vec3(at - link.x)) * force;
        at = link.x;
        turned[p] = a.E * moment;
        if (!coupled_) continue;
        const Mat3 u = moment;
        moment -= a.EA.transpose() * u;
        force -= a.EB.transpose() * u;
    }
    Mat3 omega = Mat3::Zero(), v = Mat3::Zero();
    for (std::size_t p = 0; p < path.size(); ++p) {
        const Link& link = link_[path[p]];
        const Answer& a = sprung ? link.answer : rigid_[path[p]];
        v -= cross_matrix(Vec3(link.x - at)) * omega;
        at = link.x;
        const Mat3 e = turned[p] - a.EA * omega - a.EB * v;
        omega += e;
    }
    return v - cross_matrix(Vec3(point - at)) * omega;
}

template PathResponse::PathResponse(const Plan<float>&, TreePoses<float>&, const TreeResponse<float>&,
                                    const TreeResponse<float>&, std::span<const std::int64_t>);
template PathResponse::PathResponse(const Plan<double>&, TreePoses<double>&, const TreeResponse<double>&,
                                    const TreeResponse<double>&, std::span<const std::int64_t>);

} // namespace bough
