#include "root_stiffness.h"
#include "branch_mode.h"

namespace bough {

std::size_t stand_on_springs(Tree& tree, double stiffness) {
    const std::vector<double> before = branch_modes(tree).omega_bend;
    std::size_t made = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.parent[i] >= 0 || tree.kind[i] != Kind::branch) continue;
        for (int axis = 0; axis < 2; ++axis) {
            double& K = tree.stiffness[i][axis];
            K = K / (1 + K / stiffness);
        }
        ++made;
    }
    const std::vector<double> after = branch_modes(tree).omega_bend;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && after[i] > 0) tree.damping[i] *= before[i] / after[i];
    return made;
}

} // namespace bough
