#include "plan.h"
#include "../fast/plan_lanes.h"
#include "../fast/sleep.h"
#include "../model/branch_mode.h"
#include "air.h"
#include "fictitious.h"
#include "leaf_air.h"
#include "pose.h"
#include "shelter.h"
#include "state_arrays.h"
#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace bough {

const char* stage_name(Stage stage) {
    static constexpr const char* names[stage_count] = {
        "wind_field", "external_forces", "composite",   "drag",     "root_motion", "fictitious",
        "refresh",    "spring",          "articulated", "midpoint", "body_loads",  "resolvent",
        "lanes",      "state_update",    "free_flight", "contacts", "fracture",    "walkers"};
    return names[std::size_t(stage)];
}

const char* solver_name(Solver solver) {
    static constexpr const char* names[] = {"coupled", "analytic", "articulated-explicit", "articulated-implicit",
                                            "articulated-reference"};
    return names[std::size_t(solver)];
}

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
    if (plan.wind) plan.kind = tree.kind;
    plan.parent = tree.parent;
    give_back(own, &Tree::kind, &Tree::parent);
}

// With lanes that hold them all, and nobody who reads poses.
template <class T> void give_back_bodies(Plan<T>& plan) {
    const auto all = [](auto&... arrays) { (give_back(arrays), ...); };
    all(plan.parent, plan.joint_position, plan.R_pj, plan.mass, plan.c_mass, plan.com, plan.inertia_joint, plan.K,
        plan.beta, plan.inertia_factor, plan.gravity_row, plan.carried_moment, plan.drag_area, plan.kind, plan.sway,
        plan.joint_distance, plan.com_distance, plan.inverse_weight, plan.shelter, plan.clock);
}

std::string text(double value) { // of four digits, whatever the locale
    std::array<char, 32> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 4).ptr;
    return std::string(buffer.data(), end);
}

template <class T> void plan_joint_limit(Plan<T>& plan, const Tree& tree) {
    if (is_articulated(plan.solver))
        throw std::domain_error("joint_limit: only the coupled and the analytic solver keep limits, not " +
                                std::string(solver_name(plan.solver)));
    constexpr double degree = 3.14159265358979323846 / 180;
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
                    ") starts " + text(double(plan.theta_start[i][k]) / degree) +
                    " degrees from its spring's rest about " + "xyz"[k] + ", its limit is " + text(most[k]));
        }
        plan.theta_limit.push_back(angle);
    }
}

template <class T> void plan_surfaces(Plan<T>& plan, const Tree& tree, const Scene& scene) {
    plan.drag_area.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i)
        plan.drag_area.push_back(T(drag_area(tree.kind[i], tree.size[i], scene.air_density, plate_kappa(scene))));
}

// [m] What turns with a body is within this of its joint (drag.h): its centre of mass, and of a leaf with the torque of /leaves that its
// inertia too, which is then at most its mass times the rest of this (external_forces.cpp).
template <class T> double air_arm(const Plan<T>& plan, const Tree& tree, std::size_t i) {
    if (!plan.leaf.on || !is_flat(tree.kind[i])) return tree.com[i].norm();
    return std::sqrt(tree.com[i].squaredNorm() + tree.inertia[i].trace() / (2 * tree.mass[i]));
}

// Drag's bounds. A side branch's weight is twice its parent's again (drag.h), up to 2^16.
template <class T> void plan_air_bounds(Plan<T>& plan, const Tree& tree, const std::vector<double>& weight) {
    const std::size_t n = plan.bodies;
    std::vector<std::uint8_t> depth(n, 0); // side branches left on the way from the root, at most those 16
    std::vector<double> sum(n), moved(n);  // over the path: of u, and what it moves the body's joint by
    for (auto* array : {&plan.sway, &plan.joint_distance, &plan.com_distance, &plan.inverse_weight}) array->reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = tree.parent[i] < 0;
        const auto p = std::size_t(tree.parent[i]);
        if (!root) depth[i] = std::uint8_t(std::min(depth[p] + (continues_parent(tree, i) ? 0 : 1), 16));
        const double u = std::ldexp(weight[i], depth[i]);
        const double r = root ? 0 : tree.joint_position[i].norm(), arm = air_arm(plan, tree, i);
        sum[i] = u + (root ? 0 : sum[p]);
        moved[i] = root ? 0 : moved[p] + sum[p] * r;
        plan.sway.push_back(T(moved[i] + sum[i] * arm));
        plan.joint_distance.push_back(T(r));
        plan.com_distance.push_back(T(arm));
        plan.inverse_weight.push_back(T(1 / u));
    }
}

// The factors of inertia, and drag's bounds; returns the weights by which gravity and drag are summed along a path.
template <class T> std::vector<double> plan_modes(Plan<T>& plan, const Tree& tree) {
    BranchModes modes = branch_modes(tree);
    const bool scaled = plan.scene.joint_inertia == JointInertia::branch;
    plan.inertia_factor.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const double fb = scaled ? modes.factor_bend[i] : 1, ft = scaled ? modes.factor_twist[i] : 1;
        plan.inertia_factor.push_back(Vec3(std::sqrt(fb), std::sqrt(fb), std::sqrt(ft)).template cast<T>());
    }
    std::vector<double> weight = std::move(modes.weight);
    modes = {};
    if (plan.wind) plan_air_bounds(plan, tree, weight);
    return weight;
}

// P: the first moment that a body's own turning moves, body axes.
template <class T> std::vector<Vec3> own_moments(const Plan<T>& plan, const Tree& tree) {
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) P[i] = tree.mass[i] * tree.com[i];
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += double(plan.c_mass[i]) * tree.joint_position[i];
    return P;
}

// Sums over the subtree of |g| |P|, plain and times the path's u.
template <class T> void plan_gravity_rows(Plan<T>& plan, const Tree& tree, const std::vector<double>& weight) {
    const std::size_t n = plan.bodies;
    const double strength = plan.gravity ? plan.scene.gravity.norm() : 1;
    plan.row_gravity = plan.gravity ? plan.scene.gravity.template cast<T>().norm() : T(1);
    std::vector<double> plain(n), weighed(n); // weighed: at first the sum of u over the path
    for (std::size_t i = 0; i < n; ++i)
        weighed[i] = weight[i] + (tree.parent[i] < 0 ? 0 : weighed[std::size_t(tree.parent[i])]);
    {
        const std::vector<Vec3> P = own_moments(plan, tree);
        for (std::size_t i = 0; i < n; ++i) plain[i] = strength * P[i].norm();
    }
    for (std::size_t i = 0; i < n; ++i) weighed[i] *= plain[i];
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        plain[std::size_t(tree.parent[i])] += plain[i];
        weighed[std::size_t(tree.parent[i])] += weighed[i];
    }
    plan.gravity_row.reserve(n);
    for (std::size_t i = 0; i < n; ++i) plan.gravity_row.push_back(T(std::max(0.0, weighed[i] / weight[i] - plain[i])));
}

template <class T> void plan_carried_moments(Plan<T>& plan, const Tree& tree) {
    const std::vector<Vec3> P = own_moments(plan, tree);
    plan.carried_moment.reserve(plan.bodies);
    for (const Vec3& moment : P) plan.carried_moment.push_back(moment.template cast<T>());
}

// Highest point that a body could reach by standing straight up from the ground: the wind's table covers it.
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

// Farthest point over the ground from (x, z) that a body could reach, likewise: the swirl's table covers it.
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
    for (const RootMotion& motion : scene.root_motion) {
        if (motion.tree < 0 || std::size_t(motion.tree) >= ranges.size())
            throw std::out_of_range("root_motion: tree " + std::to_string(motion.tree) +
                                    " is not there, the scene has " + std::to_string(ranges.size()));
        const auto k = std::size_t(motion.tree);
        plan.moved.push_back({ranges[k].first_body, ranges[k].bodies, plan.splines.size()});
        plan.splines.push_back(
            make_root_spline(motion, k < scene.trees.size() ? scene.trees[k].position : Vec3::Zero()));
    }
    std::sort(plan.moved.begin(), plan.moved.end(),
              [](const MovedTree& a, const MovedTree& b) { return a.first_body < b.first_body; });
}

} // namespace

template <class T> std::string forces_text(const Plan<T>& plan) {
    std::string text;
    const auto add = [&](bool on, const char* part) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(part);
    };
    add(plan.wind, "/wind");
    add(plan.wind && plan.leaf.on, "/leaves");
    add(!plan.pulls.empty(), "/pulls");
    add(plan.contact && !plan.scene.balls.empty(), "/balls");
    add(plan.contact && plan.scene.fracture.has_value(), "/fracture");
    add(!plan.scene.walkers.empty(), "/walkers");
    return text.empty() ? "no wind, no pulls" : text;
}

const char* free_part(const Scene& scene) {
    return scene.fracture           ? "/fracture"
           : !scene.balls.empty()   ? "/balls"
           : !scene.walkers.empty() ? "/walkers"
                                    : nullptr;
}

bool may_push(const Scene& scene) {
    const Contact contact = scene.contact.value_or(Contact());
    if (!contact.trees) return false;
    if (!scene.balls.empty()) return true;
    if (!scene.fracture) return false;
    const Fracture& f = *scene.fracture;
    const bool wood =
        f.branch < Fracture::never || f.fruit < Fracture::never || f.strength < Fracture::never || !f.joints.empty();
    return wood || contact.leaves;
}

namespace {

// What of a wind varies over the ground, as the plan says it.
std::string parts_of_field(const Wind& wind) {
    const auto text_of = [](std::size_t n, const char* what) { return std::to_string(n) + what; };
    std::string parts;
    if (wind.grid)
        parts += "; /wind/grid, " + text_of(std::size_t(wind.grid->columns) * std::size_t(wind.grid->rows), " cells");
    if (wind.swirl) parts += "; /wind/swirl";
    if (wind.shelter) parts += "; /wind/shelter";
    return parts;
}

// What varies from tree to tree.
std::string parts_of_clocks(const std::vector<double>& clocks) {
    return clocks.size() == 1 ? "" : "; /trees' starts, " + std::to_string(clocks.size()) + " clocks";
}

template <class T> void explain(Plan<T>& plan, const Wishes& wishes) {
    const auto add = [&plan](Stage stage, bool on, const std::string& reason) {
        plan.stages.push_back({stage, on, reason});
    };
    const bool analytic = plan.solver == Solver::analytic, coupled = plan.solver == Solver::coupled;
    const std::string solver = std::string("solver ") + solver_name(plan.solver);
    const std::string own = solver + " (evaluates it in its own pass)";
    const std::string field = plan.wind ? parts_of_field(*plan.scene.wind) + parts_of_clocks(plan.clocks) : "";
    const std::string moved = plan.root_motion ? "; roots moved by /root_motion" : "";
    const std::string limited = plan.joint_limit ? "; angles kept within /joint_limit" : "";
    const std::string forces = forces_text(plan);
    add(Stage::wind_field, (analytic || coupled) && plan.wind && !plan.lanes.on,
        !plan.wind            ? "no wind"
        : plan.lanes.on       ? "in lanes" + field
        : analytic || coupled ? "/wind" + field
                              : own + field);
    const std::string fused = "in lanes";
    const bool joints = analytic && !plan.lanes.on; // one by one, by the plain step
    const auto why = [&](const std::string& plainly, const std::string& other) {
        return joints ? plainly : analytic ? fused : other;
    };
    add(Stage::external_forces, joints && plan.forces, plan.forces ? why(forces, own) : forces);
    add(Stage::composite, joints, why("every scene", solver));
    const bool frozen = plan.refresh > 0;
    add(Stage::drag, joints && plan.wind && !frozen,
        !plan.wind         ? "no wind"
        : joints && frozen ? "with the spring, in frozen modes"
                           : why("/wind", own));
    add(Stage::root_motion, joints && plan.root_motion, plan.root_motion ? why("/root_motion", own) : "no root motion");
    add(Stage::fictitious, plan.fictitious, plan.fictitious ? "/fictitious" : "no lagged fictitious terms");
    add(Stage::refresh, joints && frozen, analytic && frozen && !joints ? fused : plan.refresh_reason);
    add(Stage::spring, joints,
        why(std::string("every scene") + (plan.root_motion ? "; the root's term for /root_motion" : "") + limited,
            solver));
    add(Stage::articulated, is_articulated(plan.solver), solver);
    const bool plain = coupled && !plan.lanes.on;
    add(Stage::midpoint, plain, plain ? "every scene" + moved : coupled ? fused : solver);
    add(Stage::body_loads, plain,
        plain     ? "every scene" + (plan.forces ? "; " + forces : "")
        : coupled ? fused
                  : solver);
    add(Stage::resolvent, plain, plain ? "every scene" + limited : coupled ? fused : solver);
    add(Stage::lanes, plan.lanes.on,
        plan.lanes.on ? std::string("SIMD ") + fast::target_name(plan.target) + (plan.forces ? "; " + forces : "") +
                            moved + (frozen ? "; " + plan.refresh_reason : "") +
                            (plan.lanes.sleep.on ? "; asleep below " + text(plan.lanes.sleep.rate) + " rad/s"
                                                 : "; no sleep: " + plan.lanes.sleep.reason)
                      : "plain path: " + plan.lanes.reason);
    add(Stage::state_update, !plan.lanes.on,
        !plan.pose ? "nobody reads poses"
        : plan.lanes.on
            ? "when poses are read" + moved
            : std::string(!plan.velocity
                              ? (plan.wind ? "every scene (poses; no output field velocity: no velocities)"
                                           : "every scene (poses; no wind, no output field velocity: no velocities)")
                          : wishes.velocity ? "every scene (poses; velocities for output field velocity)"
                          : plan.wind       ? "every scene (poses; velocities for /wind)"
                                            : "every scene (poses; velocities for /fictitious)") +
                  (plan.fictitious ? "; accelerations for /fictitious" : "") + moved);
    const Scene& scene = plan.scene;
    const bool free = scene.fracture || !scene.balls.empty();
    const std::string what = !scene.balls.empty() && scene.fracture ? "/balls, /fracture"
                             : scene.fracture                       ? "/fracture (once something broke)"
                                                                    : "/balls";
    add(Stage::free_flight, free, free ? what : "no balls, no fracture");
    add(Stage::contacts, free,
        !free          ? "no balls, no fracture"
        : plan.contact ? what + ": trees and ground"
                       : what + ": ground alone; nothing free meets trees");
    add(Stage::fracture, scene.fracture.has_value(), scene.fracture ? "/fracture" : "no fracture");
    add(Stage::walkers, !scene.walkers.empty(), scene.walkers.empty() ? "no walkers" : "/walkers");
    State<T> empty;
    visit_arrays(plan, empty, [&](const char* name, auto& array, bool on, const std::string& reason) {
        plan.arrays.push_back({name, on, plan.bodies * sizeof(array[0]), reason});
    });
    if (plan.lanes.on) {
        const fast::Layout& layout = plan.lanes.layout;
        const auto rows = [&](const char* name, std::size_t count, int quantities) {
            plan.arrays.push_back(
                {name, true, count * std::size_t(quantities) * sizeof(fast::Row<T>), "the fast path"});
        };
        if (analytic) {
            constexpr int L = fast::Row<T>::lanes;
            const int inward = fast::analytic::inward_count(plan.wind, plan.pushes());
            rows("lanes.now", layout.rows, fast::analytic::motion::count);
            if (frozen) rows("lanes.frozen", layout.rows, fast::analytic::frozen::count);
            rows("lanes.outward, inward", layout.joints,
                 int(fast::record(fast::analytic::outward_count(plan.field), L) + fast::record(inward, L)) / L);
        } else {
            rows("lanes.table", layout.rows, fast::coupled_columns(fast::waits(layout), scheme_of(plan.scheme).poles));
            rows("lanes.outward, inward, accelerated", layout.joints, fast::records_of_joint<T>());
        }
    }
    plan.arrays.push_back(
        {"articulated", is_articulated(plan.solver),
         plan.bodies * sizeof(ArticulatedBody) * std::max<std::size_t>(1, articulated_passes(plan.solver)), solver});
}

void scale(Tree& tree, const Scene& scene) {
    for (Vec3& K : tree.stiffness) K *= scene.stiffness_scale;
    for (double& beta : tree.damping) beta *= scene.damping_scale;
}

bool scales(const Scene& scene) {
    return scene.stiffness_scale != 1 || scene.damping_scale != 1;
}

// What a plan cannot have.
void refuse_parts(const Scene& scene, Solver solver) {
    if (has_free_bodies(scene) && is_articulated(solver))
        throw std::domain_error(std::string(free_part(scene) + 1) +
                                ": only the coupled and the analytic solver meet free bodies and walkers, not " +
                                solver_name(solver));
    if (scene.fictitious && solver != Solver::analytic)
        throw std::domain_error("fictitious: only for solver analytic; solver " + std::string(solver_name(solver)) +
                                " has these terms by nature, whole and in time");
    for (const auto& [field, there, function] :
         {std::tuple{"wood", scene.wood.has_value(), "override_wood"}, {"load", scene.load.has_value(), "lay_load"}})
        if (there)
            throw std::domain_error(std::string(field) + ": is still in the scene, expected in the tree (" + function +
                                    "), and no longer in the scene");
}

// tree: scaled. own: the same, where it may be given back array by array; else null. What reads much of the tree stands first.
template <class T>
Plan<T> plan_tree(const Tree& tree, Tree* own, const std::vector<TreeRange>& ranges, const Scene& scene,
                  const Wishes& wishes, double dt, Solver solver, Scheme scheme, std::optional<fast::Target> simd,
                  double sleep, double refresh) {
    Plan<T> plan;
    plan.bodies = tree.size_bodies();
    plan.dt = dt;
    plan.solver = solver;
    plan.scheme = scheme;
    plan.scene = scene;
    plan.gravity = !scene.gravity.isZero();
    plan.wind = scene.wind.has_value(); // a wind of no velocity is still air, which drags
    if (plan.wind) plan.leaf = leaf_terms<T>(scene);
    for (std::size_t k = 0; k < scene.pulls.size(); ++k)
        for (const Selected& target : select(tree, ranges, scene.pulls[k].on))
            plan.pulls.push_back({target.body, target.point_b.template cast<T>(), k});
    give_back(own, &Tree::level, &Tree::s);
    refuse_parts(scene, solver);
    plan.contact = may_push(scene);
    plan.loads = plan.contact || !scene.walkers.empty();
    plan.fictitious = scene.fictitious && lags(*scene.fictitious);
    plan.forces = plan.wind || plan.pushes();
    plan.velocity = (plan.wind && solver == Solver::analytic) || plan.fictitious || wishes.velocity;
    plan.torque = wishes.torque;
    plan_root_motion(plan, ranges);
    if (plan.wind) {
        const WindReach reach = reach_of(plan, tree);
        plan.top = std::max(reach.top, wishes.top);
        plan.reach = std::max(reach.reach, wishes.reach);
        plan_clocks(plan, ranges, wishes.clocks);
    }
    plan.field = plan.wind && (varies_over_ground(*scene.wind) || !plan.clock.empty());
    plan.refresh_reason = solver != Solver::analytic ? std::string("solver ") + solver_name(solver)
                          : !(refresh > 0)           ? "not asked for"
                          : plan.root_motion         ? "/root_motion"
                          : has_free_bodies(scene)   ? free_part(scene)
                          : scene.joint_limit        ? "/joint_limit"
                          : plan.fictitious          ? "/fictitious"
                                                     : "";
    if (plan.refresh_reason.empty()) {
        plan.refresh = refresh;
        plan.refresh_reason = "frozen coefficients, tolerance " + text(refresh);
    }
    std::vector<double> weight;
    if (solver == Solver::analytic) weight = plan_modes(plan, tree);
    if (plan.wind) plan_surfaces(plan, tree, scene);
    give_back(own, &Tree::size);
    plan_pose(plan, tree, own);
    plan.joint_limit = scene.joint_limit.has_value();
    if (plan.joint_limit) plan_joint_limit(plan, tree);
    plan_composite_masses(plan, tree);
    if (solver == Solver::analytic && (plan.gravity || plan.root_motion)) plan_gravity_rows(plan, tree, weight);
    give_back(weight);
    if (solver == Solver::coupled && plan.gravity) plan_carried_moments(plan, tree);
    plan_bodies(plan, tree, own);
    if (plan.wind && scene.wind->shelter) plan.shelter = shelter_factors(plan);
    plan.lanes.reason = "not asked for";
    if (simd) {
        plan.target = *simd;
        fast::plan_lanes(plan);
        fast::plan_sleep(plan, sleep);
        if (plan.lanes.on) plan.velocity = wishes.velocity; // the drag finds its own
    }
    plan.pose =
        !plan.lanes.on || wishes.pose || wishes.velocity || wishes.torque || scene.fracture || !scene.balls.empty();
    if (!plan.pose) give_back_bodies(plan);
    explain(plan, wishes);
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
                  double dt, Solver solver, Scheme scheme, std::optional<fast::Target> simd, double sleep,
                  double refresh) {
    if (!scales(scene))
        return plan_tree<T>(drawn, nullptr, ranges, scene, wishes, dt, solver, scheme, simd, sleep, refresh);
    Tree scaled = drawn;
    scale(scaled, scene);
    return plan_tree<T>(scaled, &scaled, ranges, scene, wishes, dt, solver, scheme, simd, sleep, refresh);
}

template <class T>
Plan<T> make_plan(Tree&& tree, const std::vector<TreeRange>& ranges, const Scene& scene, const Wishes& wishes,
                  double dt, Solver solver, Scheme scheme, std::optional<fast::Target> simd, double sleep,
                  double refresh) {
    if (scales(scene)) scale(tree, scene);
    return plan_tree<T>(tree, &tree, ranges, scene, wishes, dt, solver, scheme, simd, sleep, refresh);
}

template Plan<float> make_plan(const Tree&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                               Scheme, std::optional<fast::Target>, double, double);
template Plan<double> make_plan(const Tree&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                                Scheme, std::optional<fast::Target>, double, double);
template Plan<float> make_plan(Tree&&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                               Scheme, std::optional<fast::Target>, double, double);
template Plan<double> make_plan(Tree&&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                                Scheme, std::optional<fast::Target>, double, double);

} // namespace bough
