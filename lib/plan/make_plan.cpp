#include "make_plan.h"
#include "../base/angles.h"
#include "../base/shortest_text.h"
#include "../laws/leaf_air.h"
#include "../laws/wind_field.h"
#include "../model/bending_stress.h"
#include "carried.h"
#include "plan_reach.h"
#include "pose.h"
#include "reduced.h"
#include "shelter.h"
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace bough {

namespace {

// Gives an array back. own: the tree that was handed over; null: it is somebody else's, and stays.
template <class A> void give_back(A& array) {
    A().swap(array);
}
template <class... Arrays> void give_back(Tree* own, Arrays Tree::*... arrays) {
    if (own) (give_back(own->*arrays), ...);
}

// Where the springs start, and from where they turn.
template <class T> void plan_pose(Plan<T>& plan, const Tree& tree, Tree* own) {
    StartPose pose = start_pose(tree, plan.scene.gravity, plan.scene.pose);
    give_back(own, &Tree::joint_rotation, &Tree::load);
    plan.theta_start.reserve(plan.bodies);
    for (const Vec3& theta : pose.theta) plan.theta_start.push_back(theta.template cast<T>());
    give_back(pose.theta);
    plan.R_pj.reserve(plan.bodies);
    for (const Quat& q : pose.joint_rotation) plan.R_pj.push_back(q.toRotationMatrix().template cast<T>());
}

template <class T> void plan_composite_masses(Plan<T>& plan, const Tree& tree) {
    std::vector<double> c_mass(tree.mass);
    for (std::size_t i = plan.bodies; i-- > 0;)
        if (tree.parent[i] >= 0) c_mass[std::size_t(tree.parent[i])] += c_mass[i];
    plan.c_mass.reserve(plan.bodies);
    for (const double mass : c_mass) plan.c_mass.push_back(T(mass));
}

// All that is left to take over.
template <class T> void plan_bodies(Plan<T>& plan, const Tree& tree, Tree* own) {
    const auto take = [&](auto& to, const auto& from) {
        to.reserve(plan.bodies);
        for (const auto& value : from) {
            if constexpr (std::is_same_v<decltype(value), const double&>)
                to.push_back(T(value));
            else
                to.push_back(value.template cast<T>());
        }
    };
    plan.inertia_joint.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Mat3 com = cross_matrix(tree.com[i]);
        plan.inertia_joint.push_back(Mat3(tree.inertia[i] - tree.mass[i] * com * com).template cast<T>());
    }
    give_back(own, &Tree::inertia);
    take(plan.joint_position, tree.joint_position);
    give_back(own, &Tree::joint_position);
    take(plan.com, tree.com);
    give_back(own, &Tree::com);
    take(plan.K, tree.stiffness);
    give_back(own, &Tree::stiffness);
    take(plan.mass, tree.mass);
    take(plan.beta, tree.damping);
    give_back(own, &Tree::mass, &Tree::damping);
    plan.foliage = std::any_of(plan.kind.begin(), plan.kind.end(), is_foliage);
    plan.parent = tree.parent;
    give_back(own, &Tree::kind, &Tree::parent, &Tree::rigid, &Tree::leaf_count, &Tree::leaf_facing);
}

// With lanes that hold them all, and nobody who reads poses.
template <class T> void give_back_bodies(Plan<T>& plan) {
    const auto all = [](auto&... arrays) { (give_back(arrays), ...); };
    all(plan.parent, plan.joint_position, plan.R_pj, plan.mass, plan.c_mass, plan.com, plan.inertia_joint, plan.K,
        plan.beta, plan.drag_area, plan.facing, plan.kind, plan.shelter, plan.clock);
}

template <class T> void plan_joint_limit(Plan<T>& plan, const Tree& tree) {
    const JointLimit& limit = *plan.scene.joint_limit;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Kind kind = tree.kind[i];
        const Vec3& most = kind == Kind::branch ? limit.branch : kind == Kind::fruit ? limit.fruit : limit.leaf;
        Vector3<T> angle;
        for (int k = 0; k < 3; ++k) {
            angle[k] = most[k] < 180 ? T(most[k] * degree) : std::numeric_limits<T>::infinity();
            if (!(std::abs(plan.theta_start[i][k]) <= angle[k]))
                throw std::domain_error(
                    "joint_limit: body " + std::to_string(i) + " (branch " + std::to_string(tree.branch[i]) +
                    ") starts " + four_digits(double(plan.theta_start[i][k]) / degree) +
                    " degrees from its spring's rest about " + "xyz"[k] + ", its limit is " + four_digits(most[k]));
        }
        plan.theta_limit.push_back(angle);
    }
}

template <class T> void plan_stresses(Plan<T>& plan, const Tree& tree) {
    plan.stress_of_moment.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const double radius = tree.size[i][1];
        const bool wood = tree.kind[i] == Kind::branch && radius > 0;
        plan.stress_of_moment.push_back(wood ? T(1 / section_modulus(radius)) : T(0));
    }
}

template <class T> WindReach reach_of(const Plan<T>& plan, const Tree& tree) {
    WindReach reach{highest_reach(tree, plan.splines, plan.moved), 0};
    if (const std::optional<WindSwirl>& swirl = plan.scene.wind->swirl)
        reach.reach = farthest_reach(tree, plan.splines, plan.moved, swirl->x, swirl->z);
    return reach;
}

// Which of the wind's clocks each body goes by, where there are several.
template <class T>
void plan_clocks(Plan<T>& plan, const std::vector<TreeRange>& ranges, const std::vector<double>& whole) {
    plan.clocks = whole.empty() ? wind_clocks(plan.scene) : whole;
    if (plan.clocks.size() == 1) return;
    plan.clock.resize(plan.bodies);
    for (std::size_t k = 0; k < std::min(ranges.size(), plan.scene.trees.size()); ++k) {
        const auto which = std::find(plan.clocks.begin(), plan.clocks.end(), plan.scene.trees[k].start);
        std::fill_n(plan.clock.begin() + std::ptrdiff_t(ranges[k].first_body), ranges[k].bodies,
                    std::uint32_t(which - plan.clocks.begin()));
    }
}

template <class T> void plan_root_motion(Plan<T>& plan, const std::vector<TreeRange>& ranges) {
    const Scene& scene = plan.scene;
    plan.root_motion = !scene.root_motion.empty();
    for (std::size_t m = 0; m < scene.root_motion.size(); ++m) {
        const RootMotion& motion = scene.root_motion[m];
        if (motion.tree < 0 || std::size_t(motion.tree) >= ranges.size())
            throw std::out_of_range("/root_motion/" + std::to_string(m) + "/tree: " + std::to_string(motion.tree) +
                                    " is not there, the scene has " + std::to_string(ranges.size()));
        const auto k = std::size_t(motion.tree);
        if (ranges[k].bodies > 0) // else all of it stands still on its ground (reduce.h)
            plan.moved.push_back({ranges[k].first_body, ranges[k].bodies, plan.splines.size()});
        plan.splines.push_back(
            make_root_spline(motion, k < scene.trees.size() ? scene.trees[k].position : Vec3::Zero()));
    }
    std::sort(plan.moved.begin(), plan.moved.end(),
              [](const MovedTree& a, const MovedTree& b) { return a.first_body < b.first_body; });
}

void scale(Tree& tree, const Scene& scene) {
    for (Vec3& K : tree.stiffness) K *= scene.stiffness_scale;
    for (double& beta : tree.damping) beta *= scene.damping_scale;
}

// What is to be done before, and would else be ignored.
void require_reduced(const Tree& tree, const Scene& scene) {
    if (scene.simulate) throw std::domain_error("simulate: is still to be applied to the tree (hold_rigid)");
    for (std::size_t i = 0; i < tree.rigid.size(); ++i)
        if (tree.rigid[i] == 1)
            throw std::domain_error("rigid: body " + std::to_string(i) +
                                    " is still to be joined to what it hangs on (reduce)");
}

bool scales(const Scene& scene) {
    return scene.stiffness_scale != 1 || scene.damping_scale != 1;
}

void refuse_unapplied(const Scene& scene) {
    for (const auto& [field, there, function] :
         {std::tuple{"wood", scene.wood.has_value(), "override_wood"}, {"load", scene.load.has_value(), "lay_load"}})
        if (there)
            throw std::domain_error(std::string(field) + ": is still in the scene, expected in the tree (" + function +
                                    "), and no longer in the scene");
}

template <class T> void plan_pulls(Plan<T>& plan, const Tree& tree, const std::vector<TreeRange>& ranges) {
    for (std::size_t k = 0; k < plan.scene.pulls.size(); ++k) {
        const Pull& pull = plan.scene.pulls[k];
        try {
            for (const Selected& target : select(tree, ranges, pull.on))
                (pull.in_body ? plan.followers : plan.pulls)
                    .push_back({target.body, target.point_b.template cast<T>(), k});
        } catch (const std::out_of_range& error) {
            throw std::out_of_range("/pulls/" + std::to_string(k) + "/on: " + error.what());
        }
    }
}

template <class T> void plan_attachments(Plan<T>& plan, const Tree& tree, const std::vector<TreeRange>& ranges) {
    for (std::size_t k = 0; k < plan.scene.attachments.size(); ++k) {
        const Attachment& held = plan.scene.attachments[k];
        std::optional<QuinticSpline> course;
        if (!held.time.empty()) course = make_quintic(held.time, held.position);
        const std::string at = "/attachments/" + std::to_string(k);
        const auto selected = [&](const Selector& on, const char* name) {
            try {
                return select(tree, ranges, on);
            } catch (const std::out_of_range& error) {
                throw std::out_of_range(at + name + error.what());
            }
        };
        std::optional<Selected> far;
        if (held.with) far = selected(*held.with, "/with: ").front();
        for (const Selected& target : selected(held.on, "/on: ")) {
            if (far && far->body == target.body)
                throw std::out_of_range(at + "/with: is the body that /on names, expected another");
            plan.attachments.push_back({target.body, target.point_b, k, far, course});
        }
        plan.pairs = plan.pairs || far;
    }
}

// tree: scaled. own: the same, where it may be given back array by array; else null. What reads much of the tree stands first.
template <class T>
Plan<T> plan_tree(const Tree& tree, Tree* own, const std::vector<TreeRange>& ranges, const Scene& scene,
                  const Wishes& wishes, double dt, std::unique_ptr<Stepper<T>> made) {
    require_reduced(tree, scene);
    Plan<T> plan;
    plan.bodies = tree.size_bodies();
    plan.dt = dt;
    plan.stepper = std::move(made);
    Stepper<T>& stepper = *plan.stepper;
    plan.scene = scene;
    plan.gravity = !scene.gravity.isZero();
    plan.wind = scene.wind.has_value(); // a wind of no velocity is still air, which drags
    if (plan.wind) plan.leaf = leaf_terms<T>(scene);
    plan_pulls(plan, tree, ranges);
    plan_attachments(plan, tree, ranges);
    give_back(own, &Tree::level, &Tree::s);
    stepper.refuse(scene);
    refuse_unapplied(scene);
    plan.contact = may_push(scene);
    plan.loads = plan.contact || !scene.walkers.empty() || wishes.loads;
    plan.forces = plan.wind || plan.pushes();
    plan.velocity_wished = wishes.velocity;
    plan.velocity = wishes.velocity || stepper.kind().reads_velocities;
    plan.torque = wishes.torque || wishes.stress;
    if (wishes.stress) plan_stresses(plan, tree);
    const bool held = !scene.attachments.empty() || !scene.pulls.empty() || wishes.loads;
    plan.pose = !stepper.in_lanes() || wishes.pose || wishes.velocity || plan.torque || scene.fracture ||
                !scene.balls.empty() || (held && stepper.kind().places_points);
    plan_root_motion(plan, ranges);
    if (plan.wind) {
        const WindReach reach = reach_of(plan, tree);
        plan.top = std::max(reach.top, wishes.top);
        plan.reach = std::max(reach.reach, wishes.reach);
        plan_clocks(plan, ranges, wishes.clocks);
    }
    plan.field = plan.wind && (varies_over_ground(*scene.wind) || !plan.clock.empty());
    if (plan.wind) plan_surfaces(plan, tree);
    if (plan.wind && wishes.faces && plan.facing.empty()) plan.facing.assign(plan.bodies, T(0));
    plan_composite_masses(plan, tree);
    stepper.take_constants(plan, tree);
    give_back(own, &Tree::size);
    plan_pose(plan, tree, own);
    plan.joint_limit = scene.joint_limit.has_value();
    if (plan.joint_limit) plan_joint_limit(plan, tree);
    plan_bodies(plan, tree, own);
    plan.foliage |= plan.wind && wishes.foliage;
    if (plan.wind && scene.wind->shelter) plan.shelter = shelter_factors(plan, tree.drag);
    stepper.lay_out(plan, ranges);
    if (!plan.pose) give_back_bodies(plan);
    return plan;
}

} // namespace

WindReach wind_reach(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene) {
    Plan<double> plan;
    plan.scene = scene;
    plan_root_motion(plan, ranges);
    return reach_of(plan, tree);
}

template <class T>
Plan<T> make_plan(const Tree& drawn, const std::vector<TreeRange>& ranges, const Scene& scene, const Wishes& wishes,
                  double dt, std::unique_ptr<Stepper<T>> stepper) {
    if (!scales(scene)) return plan_tree<T>(drawn, nullptr, ranges, scene, wishes, dt, std::move(stepper));
    Tree scaled = drawn;
    scale(scaled, scene);
    return plan_tree<T>(scaled, &scaled, ranges, scene, wishes, dt, std::move(stepper));
}

template <class T>
Plan<T> make_plan(Tree&& tree, const std::vector<TreeRange>& ranges, const Scene& scene, const Wishes& wishes,
                  double dt, std::unique_ptr<Stepper<T>> stepper) {
    if (scales(scene)) scale(tree, scene);
    return plan_tree<T>(tree, &tree, ranges, scene, wishes, dt, std::move(stepper));
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template Plan<T> make_plan(const Tree&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double,        \
                               std::unique_ptr<Stepper<T>>);                                                           \
    template Plan<T> make_plan(Tree&&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double,             \
                               std::unique_ptr<Stepper<T>>);
#include "../base/instantiate.inc"

} // namespace bough
