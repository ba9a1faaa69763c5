#include "body_poses.h"
#include "../plan/ground.h"
#include "energy.h"

namespace bough {

template <class T> BodyPoses body_poses(const Plan<T>& plan, const State<T>& state, const Tree& tree) {
    BodyPoses poses;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        Vec3 x = state.x_w[i].template cast<double>();
        Mat3 R = state.R_wb[i].template cast<double>();
        if (const Ground* ground = plan.root_motion ? ground_of(plan, state, i) : nullptr) {
            x = ground->R.transpose() * (x - ground->x);
            R = ground->R.transpose() * R;
        }
        poses.x.push_back(x);
        poses.R.push_back(R);
        poses.theta.push_back(state.theta[i].template cast<double>());
    }
    if (plan.root_motion) return poses;
    const std::vector<BodyMotion> motion = body_motions(plan, state);
    for (std::size_t i = 0; i < plan.bodies; ++i)
        poses.v.push_back(motion[i].v + motion[i].omega.cross(motion[i].R.col(2) * tree.size[i][0]));
    return poses;
}

template BodyPoses body_poses(const Plan<float>&, const State<float>&, const Tree&);
template BodyPoses body_poses(const Plan<double>&, const State<double>&, const Tree&);

} // namespace bough
