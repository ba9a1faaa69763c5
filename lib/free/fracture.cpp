#include "fracture.h"
#include "../base/rotation_maps.h"
#include "../growth/random.h"
#include "../laws/air.h"
#include "../laws/leaf_air.h"
#include "../model/bending_stress.h"
#include "../model/of_kind.h"
#include <algorithm>
#include <numbers>

namespace bough {
namespace {

enum class PieceDraw { radius, angle };

// Of a standard normal distribution (Box and Muller).
double normal_draw(RandomKey key) {
    const double u = 1 - random_unit(key, PieceDraw::radius),
                 angle = 2 * std::numbers::pi * random_unit(key, PieceDraw::angle);
    return std::sqrt(-2 * std::log(u)) * std::cos(angle);
}

double threshold(const Fracture& f, const Tree& tree, std::size_t i) {
    const double torque = of_kind(f, tree.kind[i]);
    if (tree.kind[i] != Kind::branch || !(f.strength < Fracture::never)) return torque;
    return std::min(torque, f.strength * section_modulus(tree.size[i][1]));
}

} // namespace

std::vector<Breakable> breakable_joints(const Tree& tree, const std::vector<TreeRange>& ranges, const Fracture& f) {
    std::vector<Breakable> joints;
    std::vector<std::pair<std::uint32_t, double>> single;
    for (std::size_t k = 0; k < f.joints.size(); ++k) try {
            for (const Selected& target : select(tree, ranges, f.joints[k].on))
                single.emplace_back(std::uint32_t(target.body), f.joints[k].torque);
        } catch (const std::out_of_range& error) {
            throw std::out_of_range("/fracture/joints/" + std::to_string(k) + "/on: " + error.what());
        }
    // The last that names a body holds.
    std::stable_sort(single.begin(), single.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t next = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        double torque = threshold(f, tree, i);
        const bool varies = f.spread > 0 && torque < Fracture::never;
        if (varies) torque *= std::exp(f.spread * normal_draw(random_key(f.seed, 0, i)));
        for (; next < single.size() && single[next].first == i; ++next) torque = single[next].second;
        if (torque < Fracture::never) joints.push_back({std::uint32_t(i), torque});
    }
    return joints;
}

double spring_torque(const Vec3& theta, const Vec3& theta_dot, const Vec3& K, double beta) {
    return (rotation_maps(theta).J_inverse.transpose() * K.cwiseProduct(Vec3(theta + beta * theta_dot))).norm();
}

namespace {

struct Moving {
    std::size_t body;
    BodyPose pose;
    Vec3 com, v; // of the centre of mass, world
};

FreeBody piece(const Tree& tree, const Scene& scene, const std::vector<Moving>& bodies) {
    FreeBody out;
    Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
    for (const Moving& b : bodies) {
        const double m = tree.mass[b.body];
        out.mass += m;
        moment += m * b.com;
        momentum += m * b.v;
    }
    FreeMotion& motion = out.motion;
    motion.x = moment / out.mass;
    motion.v = momentum / out.mass;
    motion.q = Quat(bodies.front().pose.R).normalized();
    const Mat3 R = motion.q.toRotationMatrix();
    Vec3 spin = Vec3::Zero();
    Mat3 inertia = Mat3::Zero(); // world
    for (const Moving& b : bodies) {
        const double m = tree.mass[b.body];
        const Vec3 arm = b.com - motion.x;
        const Mat3 I = b.pose.R * tree.inertia[b.body] * b.pose.R.transpose(), r = cross_matrix(arm);
        spin += I * b.pose.omega + m * arm.cross(Vec3(b.v - motion.v));
        inertia += I - m * r * r;
        FreePart part;
        part.body = std::int64_t(b.body);
        part.kind = tree.kind[b.body];
        part.size = tree.size[b.body];
        part.q = (motion.q.conjugate() * Quat(b.pose.R)).normalized();
        part.joint = R.transpose() * (b.pose.x - motion.x);
        part.com = R.transpose() * arm;
        part.drag_area = drag_area(tree, b.body, part.kind, scene.air_density, plate_kappa(scene));
        out.parts.push_back(part);
    }
    out.inertia = R.transpose() * inertia * R;
    out.inertia = (0.5 * (out.inertia + out.inertia.transpose())).eval();
    finish(out);
    motion.omega = out.inverse_inertia_w() * spin;
    return out;
}

} // namespace

template <class T>
std::vector<FreeBody> pieces_of(const Plan<T>& plan, const Tree& tree, const Subtrees& trees, TreePoses<T>& poses,
                                const std::vector<std::uint32_t>& joints) {
    std::vector<FreeBody> pieces;
    std::vector<std::uint32_t> stack;
    std::vector<Moving> bodies;
    for (const std::uint32_t joint : joints) {
        bodies.clear();
        visit_subtree(trees, joint, stack, [&](std::size_t i) {
            if (i != joint && (plan.mass[i] == 0 || std::binary_search(joints.begin(), joints.end(), std::uint32_t(i))))
                return false;
            const BodyPose pose = poses.of(i);
            const Vec3 com = pose.at(tree.com[i]);
            bodies.push_back({i, pose, com, pose.velocity_at(com)});
            return true;
        });
        pieces.push_back(piece(tree, plan.scene, bodies));
    }
    return pieces;
}

template <class T> Remaining whole_tree(const Plan<T>& plan, const Tree& tree) {
    Remaining all;
    const std::size_t n = tree.size_bodies();
    all.c_mass = tree.mass;
    all.gone.assign(n, 0);
    for (std::size_t i = n; i-- > 0;)
        if (tree.parent[i] >= 0) all.c_mass[std::size_t(tree.parent[i])] += all.c_mass[i];
    if (!plan.stepper->carries_moments()) return all;
    for (std::size_t i = 0; i < n; ++i) all.moment.push_back(tree.mass[i] * tree.com[i]);
    for (std::size_t i = 0; i < n; ++i)
        if (tree.parent[i] >= 0) all.moment[std::size_t(tree.parent[i])] += all.c_mass[i] * tree.joint_position[i];
    return all;
}

namespace {

// What carried it carries less.
template <class T>
void unload_path(Plan<T>& plan, std::size_t first, Remaining& rest, std::vector<CarriedMoment>& carried) {
    const double mass = rest.c_mass[first];
    for (std::size_t i = first; plan.parent[i] >= 0;) {
        const auto p = std::size_t(plan.parent[i]);
        rest.c_mass[p] -= mass;
        plan.c_mass[p] = T(rest.c_mass[p]);
        if (!rest.moment.empty()) {
            rest.moment[p] -= mass * plan.joint_position[i].template cast<double>();
            carried.push_back({p, rest.moment[p]});
        }
        i = p;
    }
}

} // namespace

template <class T>
void detach(Plan<T>& plan, State<T>& state, const Subtrees& trees, const std::vector<std::uint32_t>& joints,
            Remaining& rest) {
    std::vector<std::uint32_t> stack;
    std::vector<std::size_t> left;
    std::vector<CarriedMoment> carried;
    for (const std::uint32_t joint : joints) {
        if (rest.gone[joint]) continue; // with what carried it
        unload_path(plan, joint, rest, carried);
        visit_subtree(trees, joint, stack, [&](std::size_t i) {
            if (rest.gone[i]) return false;
            rest.gone[i] = 1;
            rest.c_mass[i] = 0;
            left.push_back(i);
            return true;
        });
    }
    plan.stepper->drop(plan, state, left, carried);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::vector<FreeBody> pieces_of(const Plan<T>&, const Tree&, const Subtrees&, TreePoses<T>&,              \
                                             const std::vector<std::uint32_t>&);                                       \
    template Remaining whole_tree(const Plan<T>&, const Tree&);                                                        \
    template void detach(Plan<T>&, State<T>&, const Subtrees&, const std::vector<std::uint32_t>&, Remaining&);
#include "../base/instantiate.inc"

} // namespace bough
