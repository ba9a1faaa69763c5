#include "skin.h"
#include "clump.h"
#include "skin_mesh.h"
#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>

namespace bough {

std::int32_t add_vertex(Skin& skin, const Vec3& position, const Vec3& normal, double u, double v,
                        const Binding& binding) {
    const std::size_t index = skin.position.size();
    if (index >= std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw std::length_error("the skin mesh has more than 2^31 - 1 vertices; take fewer sides or bodies");
    skin.position.push_back(position);
    skin.normal.push_back(normal);
    skin.texture.push_back({float(u), float(v)});
    const std::int32_t second = binding.second_weight > 0 ? binding.second : binding.first;
    skin.joint.push_back({binding.first, second, binding.first, binding.first});
    skin.weight.push_back({1 - binding.second_weight, binding.second_weight, 0, 0});
    return std::int32_t(index);
}

namespace {

// next[i]: the piece that goes on body i's branch, -1 at its tip. starts: the bodies that begin a tube, rising.
struct Tubes {
    std::vector<std::int32_t> next;
    std::vector<std::int32_t> starts;
};

Tubes find_tubes(const Tree& tree) {
    Tubes tubes;
    tubes.next.assign(tree.size_bodies(), -1);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        if (continues_parent(tree, i) && tubes.next[std::size_t(tree.parent[i])] < 0)
            tubes.next[std::size_t(tree.parent[i])] = std::int32_t(i);
        else
            tubes.starts.push_back(std::int32_t(i));
    }
    return tubes;
}

// Corners so that the distance between a ring and its circle, r (1 - cos(pi / n)), is about the same on every branch.
int sides_for(double radius, double thickest, int most) {
    if (!(thickest > 0)) return 3;
    return std::max(3, int(std::lround(most * std::sqrt(std::min(1.0, radius / thickest)))));
}

// Corners of the tube that each branch piece belongs to, 0 for other bodies.
std::vector<int> find_sides(const Tree& tree, const Tubes& tubes, int most) {
    auto thickness = [&](std::int32_t start) {
        const Vec3& size = tree.size[std::size_t(start)];
        return std::max(size.y(), size.z());
    };
    double thickest = 0;
    for (const std::int32_t start : tubes.starts) thickest = std::max(thickest, thickness(start));
    std::vector<int> sides(tree.size_bodies(), 0);
    for (const std::int32_t start : tubes.starts) {
        const int corners = sides_for(thickness(start), thickest, most);
        for (std::int32_t i = start; i >= 0; i = tubes.next[std::size_t(i)]) sides[std::size_t(i)] = corners;
    }
    return sides;
}

// Room for the whole mesh (at most a few rings too much), so that it is never copied while it grows.
void reserve(Skin& skin, const Tree& tree, const Tubes& tubes, const std::vector<int>& sides,
             const std::vector<std::int32_t>& blades) {
    std::size_t vertices = 0, triangles = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::size_t n = std::size_t(sides[i]), rings = n > 3 ? 2 : 1;
        if (tree.kind[i] == Kind::branch) vertices += rings * (n + 1), triangles += rings * 2 * n;
        const auto flat = std::size_t(is_flat(tree.kind[i]) ? blades.empty() ? 1 : blades[i] : 0);
        vertices += flat * leaf_vertices, triangles += flat * leaf_triangles;
        if (tree.kind[i] == Kind::fruit) vertices += fruit_vertices, triangles += fruit_triangles;
    }
    for (const std::int32_t start : tubes.starts) {
        const std::size_t n = std::size_t(sides[std::size_t(start)]);
        vertices += 3 * (n + 1) + 2 * n;
        triangles += 3 * 2 * n;
    }
    skin.position.reserve(vertices);
    skin.normal.reserve(vertices);
    skin.texture.reserve(vertices);
    skin.joint.reserve(vertices);
    skin.weight.reserve(vertices);
    skin.triangle.reserve(triangles);
}

void add_bark(Skin& skin, const Tree& tree, const DrawnPose& pose, const Tubes& tubes, const std::vector<int>& sides) {
    BranchTube tube;
    for (const std::int32_t start : tubes.starts) {
        tube.sides = sides[std::size_t(start)];
        tube.piece.clear();
        for (std::int32_t i = start; i >= 0; i = tubes.next[std::size_t(i)]) tube.piece.push_back(i);
        const std::int32_t parent = tree.parent[std::size_t(start)];
        const std::int32_t below = parent >= 0 ? tree.parent[std::size_t(parent)] : -1;
        tube.parent_sides = parent >= 0 ? sides[std::size_t(parent)] : 0;
        tube.parent_base = parent >= 0 && (below < 0 || tree.kind[std::size_t(below)] != Kind::branch);
        tube.parent_tip = parent >= 0 && tubes.next[std::size_t(parent)] < 0;
        add_tube(skin, tree, pose, tube);
    }
}

void close_part(Skin& skin, const char* name, const Vec3& color) {
    const std::size_t first = skin.part.empty() ? 0 : skin.part.back().first_index + skin.part.back().index_count;
    if (skin.triangle.size() > first) skin.part.push_back({name, color, first, skin.triangle.size() - first});
}

} // namespace

Skin build_skin(const Tree& tree, const SkinOptions& options) {
    assert(options.sides >= 3);
    const DrawnPose pose = drawn_pose(tree);
    const Tubes tubes = find_tubes(tree);
    const std::vector<int> sides = find_sides(tree, tubes, options.sides);
    const std::vector<std::int32_t> blades = clump_leaves_drawn(tree, options.clump_leaves);
    Skin skin;
    reserve(skin, tree, tubes, sides, blades);
    add_bark(skin, tree, pose, tubes, sides);
    const std::vector<Vec3>& color = tree.color.empty() ? default_colors() : tree.color;
    close_part(skin, "bark", color[0]);
    for (const Kind kind : {Kind::leaf, Kind::petal}) {
        for (std::size_t i = 0; i < tree.size_bodies() && options.leaves; ++i)
            if (tree.kind[i] == kind)
                is_clump(tree, i) ? add_clump(skin, tree, pose, i, blades[i]) : add_leaf(skin, tree, pose, i);
        kind == Kind::leaf ? close_part(skin, "leaf", color[1]) : close_part(skin, "petal", color[2]);
    }
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::fruit) add_fruit(skin, tree, pose, i);
    close_part(skin, "fruit", color[3]);
    return skin;
}

} // namespace bough
