#include "plan_reach.h"
#include <algorithm>

namespace bough {

double highest_reach(const Tree& tree, const std::vector<RootSpline>& splines, const std::vector<MovedTree>& moved) {
    const auto height = [&](std::size_t root) {
        const std::int64_t spline = spline_under(moved, root);
        const Vec3& drawn = tree.joint_position[root];
        return spline < 0 ? drawn.y() : highest(splines[std::size_t(spline)], drawn);
    };
    std::vector<double> reach(tree.size_bodies());
    double top = 0;
    for (std::size_t i = 0; i < reach.size(); ++i) {
        reach[i] = tree.parent[i] < 0 ? std::max(0.0, height(i))
                                      : reach[std::size_t(tree.parent[i])] + tree.joint_position[i].norm();
        top = std::max(top, reach[i] + tree.size[i][0]);
    }
    return top;
}

double farthest_reach(const Tree& tree, const std::vector<RootSpline>& splines, const std::vector<MovedTree>& moved,
                      double x, double z) {
    const auto away = [&](std::size_t root) {
        const std::int64_t spline = spline_under(moved, root);
        const Vec3& drawn = tree.joint_position[root];
        return spline < 0 ? std::hypot(drawn.x() - x, drawn.z() - z)
                          : farthest(splines[std::size_t(spline)], drawn, x, z);
    };
    std::vector<double> reach(tree.size_bodies());
    double farthest_point = 0;
    for (std::size_t i = 0; i < reach.size(); ++i) {
        reach[i] = tree.parent[i] < 0 ? away(i) : reach[std::size_t(tree.parent[i])] + tree.joint_position[i].norm();
        farthest_point = std::max(farthest_point, reach[i] + tree.size[i][0]);
    }
    return farthest_point;
}

} // namespace bough
