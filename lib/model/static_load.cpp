#include "static_load.h"
#include "body_shape.h"
#include "drawn_pose.h"
#include <cmath>

namespace bough {
namespace {

double density_of(const StaticLoad& load, Kind kind) {
    switch (kind) {
    case Kind::leaf:
        return load.leaf;
    case Kind::petal:
    case Kind::clump:
    case Kind::tuft:
        return load.petal;
    case Kind::fruit:
        return load.fruit;
    case Kind::branch:
        break;
    }
    return load.branch;
}

} // namespace

double area_from_above(const Tree& tree, std::size_t i, const Mat3& R_wb) {
    const Vec3& size = tree.size[i];
    switch (tree.kind[i]) {
    case Kind::leaf:
    case Kind::petal:
    case Kind::clump:
    case Kind::tuft:
        if (is_clump(tree, i))
            return foliage_area(tree, i) * (1 + (tree.leaf_facing.empty() ? 0 : tree.leaf_facing[i])) / 2;
        return foliage_area(tree, i) * std::abs(R_wb(1, 1));
    case Kind::fruit:
        return sphere_section(size[1]);
    case Kind::branch:
        break;
    }
    return frustum_section(size[0], size[1], size[2]) * std::hypot(R_wb(0, 2), R_wb(2, 2));
}

LoadLaid lay_load(Tree& tree, const StaticLoad& load) {
    const std::size_t n = tree.size_bodies();
    const std::vector<Mat3> R_wb = drawn_pose(tree).R_wb;
    tree.load.resize(n, 0.0);
    LoadLaid laid;
    for (std::size_t i = 0; i < n; ++i) {
        const double added = density_of(load, tree.kind[i]) * area_from_above(tree, i, R_wb[i]);
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
