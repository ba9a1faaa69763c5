#include "static_load.h"
#include "body_shape.h"
#include "drawn_pose.h"
#include "of_kind.h"
#include <cmath>

namespace bough {

double area_from_above(const Tree& tree, std::size_t i, const Mat3& R_wb) {
    const Vec3& size = tree.size[i];
    if (is_foliage(tree.kind[i])) {
        if (!is_clump(tree, i)) return foliage_area(tree, i) * std::abs(R_wb(1, 1));
        return foliage_area(tree, i) * (1 + (tree.leaf_facing.empty() ? 0 : tree.leaf_facing[i])) / 2;
    }
    if (tree.kind[i] == Kind::fruit) return sphere_section(size[1]);
    return frustum_section(size[0], size[1], size[2]) * std::hypot(R_wb(0, 2), R_wb(2, 2));
}

LoadLaid lay_load(Tree& tree, const StaticLoad& load) {
    const std::size_t n = tree.size_bodies();
    const std::vector<Mat3> R_wb = drawn_pose(tree).R_wb;
    tree.load.resize(n, 0.0);
    LoadLaid laid;
    for (std::size_t i = 0; i < n; ++i) {
        const double added = of_kind(load, tree.kind[i]) * area_from_above(tree, i, R_wb[i]);
        if (!(added > 0)) continue;
        tree.inertia[i] *= 1 + added / tree.mass[i];
        tree.mass[i] += added;
        tree.load[i] += added;
        laid.mass += added;
        ++laid.bodies;
    }
    return laid;
}

} // namespace bough
