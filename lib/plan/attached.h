// attached.h: attachments (Attachment, scene.h) as any solver keeps them in a state, and the joints between them and the ground.
#pragma once
#include "plan.h"
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace bough {

// An attachment's end on a body.
struct AttachedEnd {
    std::size_t body = 0;
    std::size_t at = 0;          // in the joints of all paths
    Vec3 point_b = Vec3::Zero(); // [m] body frame
    // Of the step: from the joint at y*; x_0; V_0
    Vec3 rho = Vec3::Zero(), start = Vec3::Zero(), velocity = Vec3::Zero();
};

struct Attached : AttachedEnd {
    std::uint64_t number = 0;       // 0: planned; else of those made while the run goes on
    std::int64_t planned = -1;      // in Plan::attachments; -1: made so
    std::optional<AttachedEnd> far; // of a pair; targets are then as seen from it
    double stiffness = 0, damping = 0;
    double from = 0, to = 0;    // [s]
    Vec3 target = Vec3::Zero(); // [m] of one at rest, or led: at the next step's start
    Vec3 goal = Vec3::Zero();   // [m] where it is led, in so many steps
    int steps = 0;

    Vec3 force = Vec3::Zero(),
         spring = Vec3::Zero(); // [N] on the body at the last step's end, and the spring's own part, smoothed; carried

    // Of the step.
    bool on = false;
    double k = 0, c = 0;                                         // as they are taken
    Vec3 from_target = Vec3::Zero(), to_target = Vec3::Zero();   // [m] at its start and end, as seen from the ground
    Vec3 target_velocity = Vec3::Zero(), quicker = Vec3::Zero(); // [m/s] mean, and what it gains
    double work = 0, far_work = 0; // [J] done on the tree, by the mean of both ends' forces; on the far end's
};

// A joint between what is attached and the ground.
struct PathJoint {
    std::size_t body;
    std::int64_t parent; // in the joints of all paths, -1: the ground
    Vec3 joint_position; // of the plan
    Mat3 R_pj;
};

template <class Visit> void each_end(std::vector<Attached>& all, Visit&& visit) {
    for (Attached& held : all) {
        visit(held);
        if (held.far) visit(*held.far);
    }
}

// Finds the joints of all paths, rising, and each end's place in them. ends(visit) calls visit for each end. What a joint has
// beside PathJoint is zero afterwards. touched: room for it. O(paths). Allocates where `touched` or `joints` has too little room, so always where
// `touched` is new.
template <class T, class Ends, class Joint>
void find_path_joints(const Plan<T>& plan, const Ends& ends, std::vector<std::size_t>& touched,
                      std::vector<Joint>& joints) {
    touched.clear();
    ends([&](const AttachedEnd& end) {
        for (auto i = std::int64_t(end.body); i >= 0; i = plan.parent[std::size_t(i)])
            touched.push_back(std::size_t(i));
    });
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    const auto at = [&](std::size_t body) {
        return std::lower_bound(touched.begin(), touched.end(), body) - touched.begin();
    };
    joints.clear();
    joints.resize(touched.size());
    for (std::size_t k = 0; k < touched.size(); ++k) {
        PathJoint& j = joints[k];
        j.body = touched[k];
        const std::int32_t parent = plan.parent[j.body];
        j.parent = parent < 0 ? -1 : at(std::size_t(parent));
        j.joint_position = plan.joint_position[j.body].template cast<double>();
        j.R_pj = plan.R_pj[j.body].template cast<double>();
    }
    ends([&](AttachedEnd& end) { end.at = std::size_t(at(end.body)); });
}

} // namespace bough
