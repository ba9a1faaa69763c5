#include "posed_tree.h"
#include "ground.h"

namespace bough {

template <class T> Tree posed_tree(const Plan<T>& plan, const State<T>& state, Tree tree) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Quat rest(Mat3(plan.R_pj[i].template cast<double>()));
        tree.joint_rotation[i] = rest * quaternion_from_vector<double>(state.theta[i].template cast<double>());
        const Ground* ground = plan.root_motion && plan.parent[i] < 0 ? ground_of(plan, state, i) : nullptr;
        if (ground) {
            tree.joint_rotation[i] = Quat(ground->R) * tree.joint_rotation[i];
            tree.joint_position[i] = ground->x + ground->R * tree.joint_position[i];
        }
        tree.joint_rotation[i].normalize();
    }
    tree.load.clear();
    return tree;
}

template Tree posed_tree(const Plan<float>&, const State<float>&, Tree);
template Tree posed_tree(const Plan<double>&, const State<double>&, Tree);

} // namespace bough
