#include "skin.h"
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
struct Chains {
    std::vector<std::int32_t> next;
    std::vector<std::int32_t> starts;
};

Chains find_chains(const Tree& tree) {
    Chains chains;
    chains.next.assign(tree.size_bodies(), -1);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        if (continues_parent(tree, i) && chains.next[std::size_t(tree.parent[i])] < 0)
            chains.next[std::size_t(tree.parent[i])] = std::int32_t(i);
        else
            chains.starts.push_back(std::int32_t(i));
    }
    return chains;
}

// Corners so that the distance between a ring and its circle, r (1 - cos(pi / n)), is about the same on every branch.
int sides_for(double radius, double thickest, int most) {
    if (!(thickest > 0)) return 3;
    return std::max(3, int(std::lround(most * std::sqrt(std::min(1.0, radius / thickest)))));
}

void add_bark(Skin& skin, const Tree& tree, const DrawnPose& pose, int most_sides) {
    const Chains chains = find_chains(tree);
    auto thickness = [&](std::int32_t start) {
        const Vec3& size = tree.size[std::size_t(start)];
        return std::max(size.y(), size.z());
    };
    double thickest = 0;
    for (const std::int32_t start : chains.starts) thickest = std::max(thickest, thickness(start));

    std::vector<std::int32_t> sides(tree.size_bodies(), 0); // of the tube a branch piece belongs to
    BranchTube tube;
    for (const std::int32_t start : chains.starts) {
        tube.sides = sides_for(thickness(start), thickest, most_sides);
        tube.piece.clear();
        for (std::int32_t i = start; i >= 0; i = chains.next[std::size_t(i)]) {
            tube.piece.push_back(i);
            sides[std::size_t(i)] = tube.sides;
        }
        const std::int32_t parent = tree.parent[std::size_t(start)];
        tube.parent_sides = parent >= 0 ? sides[std::size_t(parent)] : 0;
        const std::int32_t below = parent >= 0 ? tree.parent[std::size_t(parent)] : -1;
        tube.parent_base = parent >= 0 && (below < 0 || tree.kind[std::size_t(below)] != Kind::branch);
        tube.parent_tip = parent >= 0 && chains.next[std::size_t(parent)] < 0;
        add_tube(skin, tree, pose, tube);
    }
}

void close_part(Skin& skin, const char* name) {
    const std::size_t first = skin.part.empty() ? 0 : skin.part.back().first_index + skin.part.back().index_count;
    if (skin.triangle.size() > first) skin.part.push_back({name, first, skin.triangle.size() - first});
}

} // namespace

Skin build_skin(const Tree& tree, const SkinOptions& options) {
    assert(options.sides >= 3);
    DrawnPose pose;
    drawn_pose(tree, pose.R_wb, pose.x_w);
    Skin skin;
    add_bark(skin, tree, pose, options.sides);
    close_part(skin, "bark");
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::leaf) add_leaf(skin, tree, pose, i);
    close_part(skin, "leaf");
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::fruit) add_fruit(skin, tree, pose, i);
    close_part(skin, "fruit");
    return skin;
}

} // namespace bough
