#include "hold.h"
#include "../laws/added_motion.h"
#include "../model/drawn_pose.h"
#include "reduced.h"
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

// Holds joints by a rule; those that are held already stay with the one that held them.
template <class Moves> void hold(Tree& tree, std::size_t& held, Moves&& moves) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (!tree.rigid[i] && !moves(i)) {
            tree.rigid[i] = 1;
            ++held;
        }
}

// The branch's body that i is, or grows on.
std::size_t wood_of(const Tree& tree, std::size_t i) {
    while (tree.kind[i] != Kind::branch && tree.parent[i] >= 0) i = std::size_t(tree.parent[i]);
    return i;
}

std::vector<std::uint8_t> in_subtrees(const Tree& tree, const std::vector<TreeRange>& ranges,
                                      const std::vector<Selector>& subtrees) {
    std::vector<std::uint8_t> in(tree.size_bodies(), 0);
    for (const Selector& subtree : subtrees)
        for (const Selected& root : select(tree, ranges, subtree)) in[root.body] = 1;
    for (std::size_t i = 0; i < in.size(); ++i)
        if (tree.parent[i] >= 0 && in[std::size_t(tree.parent[i])]) in[i] = 1;
    return in;
}

// Pixels a metre at a place.
double pixels_at(const Simulate::View& view, const Vec3& place) {
    const double height = 2 * std::tan(view.angle * std::numbers::pi / 360) * (place - view.from).norm();
    return view.pixels / height;
}

} // namespace

std::size_t hold_small(Tree& tree, const std::vector<double>& motion, double most) {
    if (tree.rigid.empty()) tree.rigid.assign(tree.size_bodies(), 0);
    std::vector<double> sum(tree.size_bodies(), 0); // of what is held from here to the worst of its ends
    std::size_t held = 0;
    for (std::size_t i = sum.size(); i-- > 0;) {
        if (!tree.rigid[i] && sum[i] + motion[i] <= most) {
            tree.rigid[i] = 1;
            sum[i] += motion[i];
            ++held;
        }
        if (tree.parent[i] < 0) continue;
        double& below = sum[std::size_t(tree.parent[i])];
        below = std::max(below, sum[i]);
    }
    return held;
}

HeldJoints hold_rigid(Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene) {
    HeldJoints held;
    held.joints = tree.size_bodies();
    held.document = std::size_t(std::count(tree.rigid.begin(), tree.rigid.end(), std::uint8_t(1)));
    const auto moving = [&] {
        const auto rigid = std::size_t(std::count(tree.rigid.begin(), tree.rigid.end(), std::uint8_t(1)));
        return tree.size_bodies() - rigid;
    };
    if (!scene.simulate) {
        held.moving = moving();
        return held;
    }
    const Simulate& by = *scene.simulate;
    tree.rigid.resize(tree.size_bodies(), 0);
    hold(tree, held.level, [&](std::size_t i) {
        return (!by.first_level || tree.level[i] >= *by.first_level) &&
               (!by.last_level || tree.level[i] <= *by.last_level);
    });
    if (by.radius > 0)
        hold(tree, held.radius, [&](std::size_t i) { return tree.size[wood_of(tree, i)][1] >= by.radius; });
    if (!by.subtrees.empty()) {
        const std::vector<std::uint8_t> in = in_subtrees(tree, ranges, by.subtrees);
        hold(tree, held.subtrees, [&](std::size_t i) { return in[i] != 0; });
    }
    if (by.box || by.error > 0) {
        const DrawnPose drawn = drawn_pose(tree);
        if (by.box)
            hold(tree, held.box, [&](std::size_t i) {
                return (drawn.x_w[i].array() >= by.box->least.array()).all() &&
                       (drawn.x_w[i].array() <= by.box->most.array()).all();
            });
        if (by.error > 0) {
            if (const std::string why = no_estimate(scene); !why.empty())
                throw std::domain_error("/simulate/error: " + why);
            std::vector<double> motion = added_motion(tree, ranges, scene);
            for (std::size_t i = 0; by.view && i < motion.size(); ++i) motion[i] *= pixels_at(*by.view, drawn.x_w[i]);
            held.error = hold_small(tree, motion, by.error);
        }
    }
    held.moving = moving();
    if (!has_rigid(tree)) tree.rigid.clear();
    return held;
}

std::string text_of(const HeldJoints& held) {
    std::string text = std::to_string(held.moving) + " of " + std::to_string(held.joints) + " joints move", reasons;
    for (const auto& [count, by] : {std::pair{held.document, "the tree's /rigid"},
                                    {held.level, "/simulate/first_level, last_level"},
                                    {held.radius, "/simulate/radius"},
                                    {held.subtrees, "/simulate/subtrees"},
                                    {held.box, "/simulate/box"},
                                    {held.error, "/simulate/error"}})
        if (count > 0) reasons += (reasons.empty() ? "; held: " : ", ") + std::to_string(count) + " by " + by;
    return text + reasons;
}

} // namespace bough
