#include "plan.h"
#include "../fast/plan_lanes.h"
#include "../fast/sleep.h"
#include "../model/body_shape.h"
#include "../model/branch_mode.h"
#include "pose.h"
#include "state_arrays.h"
#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace bough {

const char* stage_name(Stage stage) {
    static constexpr const char* names[stage_count] = {
        "wind_field",  "external_forces", "composite",  "drag",      "root_motion", "refresh",     "spring",
        "articulated", "midpoint",        "body_loads", "resolvent", "lanes",       "state_update"};
    return names[std::size_t(stage)];
}

const char* solver_name(Solver solver) {
    static constexpr const char* names[] = {"coupled", "analytic", "articulated-explicit", "articulated-implicit",
                                            "articulated-reference"};
    return names[std::size_t(solver)];
}

namespace {

constexpr double cylinder_drag = 1.2, sphere_drag = 0.47, plate_drag = 1.2; // C_d; kappa is half of each

double drag_area(const Tree& tree, std::size_t i, double air_density) {
    const Vec3& size = tree.size[i];
    switch (tree.kind[i]) {
    case Kind::leaf:
    case Kind::petal:
        return plate_drag / 2 * air_density * leaf_area(size[0], size[1]);
    case Kind::fruit:
        return sphere_drag / 2 * air_density * sphere_section(size[1]);
    case Kind::branch:
        break;
    }
    return cylinder_drag / 2 * air_density * frustum_section(size[0], size[1], size[2]);
}

template <class T> void plan_bodies(Plan<T>& plan, const Tree& tree, const Scene& scene) {
    const std::size_t n = plan.bodies;
    const StartPose pose = start_pose(tree, scene.gravity, scene.pose);
    std::vector<double> c_mass(tree.mass);
    for (std::size_t i = n; i-- > 0;)
        if (tree.parent[i] >= 0) c_mass[std::size_t(tree.parent[i])] += c_mass[i];
    plan.parent = tree.parent;
    for (std::size_t i = 0; i < n; ++i) {
        const Mat3 com = cross_matrix(tree.com[i]);
        plan.joint_position.push_back(tree.joint_position[i].template cast<T>());
        plan.R_pj.push_back(pose.joint_rotation[i].toRotationMatrix().template cast<T>());
        plan.theta_start.push_back(pose.theta[i].template cast<T>());
        plan.mass.push_back(T(tree.mass[i]));
        plan.c_mass.push_back(T(c_mass[i]));
        plan.com.push_back(tree.com[i].template cast<T>());
        plan.inertia_joint.push_back(Mat3(tree.inertia[i] - tree.mass[i] * com * com).template cast<T>());
        plan.K.push_back(tree.stiffness[i].template cast<T>());
        plan.beta.push_back(T(tree.damping[i]));
    }
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
    plan.kind = tree.kind;
    for (std::size_t i = 0; i < plan.bodies; ++i) plan.drag_area.push_back(T(drag_area(tree, i, scene.air_density)));
}

// Drag's bounds. A side branch's weight is twice its parent's again (drag.h), up to 2^16.
template <class T> void plan_air_bounds(Plan<T>& plan, const Tree& tree, const std::vector<double>& weight) {
    const std::size_t n = plan.bodies;
    std::vector<int> depth(n, 0);         // side branches left on the way from the root
    std::vector<double> sum(n), moved(n); // over the path: of u, and what it moves the body's joint by
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = tree.parent[i] < 0;
        const auto p = std::size_t(tree.parent[i]);
        if (!root) depth[i] = depth[p] + (continues_parent(tree, i) ? 0 : 1);
        const double u = std::ldexp(weight[i], std::min(depth[i], 16));
        const double r = root ? 0 : tree.joint_position[i].norm();
        sum[i] = u + (root ? 0 : sum[p]);
        moved[i] = root ? 0 : moved[p] + sum[p] * r;
        plan.sway.push_back(T(moved[i] + sum[i] * tree.com[i].norm()));
        plan.joint_distance.push_back(T(r));
        plan.com_distance.push_back(T(tree.com[i].norm()));
        plan.inverse_weight.push_back(T(1 / u));
    }
}

// The factors of inertia, and the weights by which gravity and drag are summed along a path.
template <class T> void plan_modes(Plan<T>& plan, const Tree& tree, const Scene& scene) {
    const std::size_t n = plan.bodies;
    const bool scaled = scene.joint_inertia == JointInertia::branch;
    const BranchModes modes = branch_modes(tree);
    std::vector<double> sum(n); // of u over the path
    for (std::size_t i = 0; i < n; ++i) {
        const double fb = scaled ? modes.factor_bend[i] : 1, ft = scaled ? modes.factor_twist[i] : 1;
        plan.inertia_factor.push_back(Vec3(std::sqrt(fb), std::sqrt(fb), std::sqrt(ft)).template cast<T>());
        const auto p = std::size_t(tree.parent[i]);
        sum[i] = modes.weight[i] + (tree.parent[i] < 0 ? 0 : sum[p]);
    }
    if (plan.gravity || plan.root_motion) {
        // P: the first moment that a body's own turning moves; sums over the subtree of |g| |P|, plain and times the path's u.
        const double strength = plan.gravity ? scene.gravity.norm() : 1;
        plan.row_gravity = plan.gravity ? scene.gravity.template cast<T>().norm() : T(1);
        std::vector<Vec3> P(n);
        std::vector<double> plain(n), weighed(n);
        for (std::size_t i = 0; i < n; ++i) P[i] = tree.mass[i] * tree.com[i];
        for (std::size_t i = 0; i < n; ++i)
            if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += double(plan.c_mass[i]) * tree.joint_position[i];
        for (std::size_t i = 0; i < n; ++i) {
            plain[i] = strength * P[i].norm();
            weighed[i] = plain[i] * sum[i];
        }
        for (std::size_t i = n; i-- > 0;) {
            if (tree.parent[i] < 0) continue;
            plain[std::size_t(tree.parent[i])] += plain[i];
            weighed[std::size_t(tree.parent[i])] += weighed[i];
        }
        for (std::size_t i = 0; i < n; ++i)
            plan.gravity_row.push_back(T(std::max(0.0, weighed[i] / modes.weight[i] - plain[i])));
    }
    if (plan.wind) plan_air_bounds(plan, tree, modes.weight);
}

template <class T> void plan_carried_moments(Plan<T>& plan, const Tree& tree) {
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) P[i] = tree.mass[i] * tree.com[i];
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += double(plan.c_mass[i]) * tree.joint_position[i];
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

template <class T> void explain(Plan<T>& plan, const Wishes& wishes) {
    const auto add = [&plan](Stage stage, bool on, const std::string& reason) {
        plan.stages.push_back({stage, on, reason});
    };
    const bool analytic = plan.solver == Solver::analytic, coupled = plan.solver == Solver::coupled;
    const std::string solver = std::string("solver ") + solver_name(plan.solver);
    const std::string own = solver + " (evaluates it in its own pass)";
    const std::string moved = plan.root_motion ? "; roots moved by /root_motion" : "";
    const std::string limited = plan.joint_limit ? "; angles kept within /joint_limit" : "";
    const std::string forces = !plan.forces                       ? "no wind, no pulls"
                               : plan.wind && !plan.pulls.empty() ? "/wind, /pulls"
                               : plan.wind                        ? "/wind"
                                                                  : "/pulls";
    add(Stage::wind_field, (analytic || coupled) && plan.wind && !plan.lanes.on,
        !plan.wind            ? "no wind"
        : plan.lanes.on       ? "in lanes"
        : analytic || coupled ? "/wind"
                              : own);
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
        plan.lanes.on
            ? "when poses are read" + moved
            : std::string(!plan.velocity
                              ? (plan.wind ? "every scene (poses; no output field velocity: no velocities)"
                                           : "every scene (poses; no wind, no output field velocity: no velocities)")
                          : wishes.velocity ? "every scene (poses; velocities for output field velocity)"
                                            : "every scene (poses; velocities for /wind)") +
                  moved);
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
            const int inward = fast::analytic::inward_count(plan.wind, !plan.pulls.empty());
            rows("lanes.now", layout.rows, fast::analytic::motion::count);
            if (frozen) rows("lanes.frozen", layout.rows, fast::analytic::frozen::count);
            rows("lanes.outward, inward", layout.joints,
                 int(fast::record(fast::analytic::outward::count, L) + fast::record(inward, L)) / L);
        } else {
            rows("lanes.now, next", 2 * std::size_t(layout.rows), fast::motion::count);
            rows("lanes.solved", fast::waits(layout) ? layout.rows : 0, fast::solved::count);
            rows("lanes.outward, inward, accelerated", layout.joints, fast::records_of_joint<T>());
        }
    }
    plan.arrays.push_back(
        {"articulated", is_articulated(plan.solver),
         plan.bodies * sizeof(ArticulatedBody) * std::max<std::size_t>(1, articulated_passes(plan.solver)), solver});
}

} // namespace

template <class T>
Plan<T> make_plan(const Tree& drawn, const std::vector<TreeRange>& ranges, const Scene& scene, const Wishes& wishes,
                  double dt, Solver solver, Scheme scheme, std::optional<fast::Target> simd, double sleep,
                  double refresh) {
    Tree scaled; // a copy only where it differs
    if (scene.stiffness_scale != 1 || scene.damping_scale != 1) {
        scaled = drawn;
        for (Vec3& K : scaled.stiffness) K *= scene.stiffness_scale;
        for (double& beta : scaled.damping) beta *= scene.damping_scale;
    }
    const Tree& tree = scaled.size_bodies() > 0 ? scaled : drawn;
    Plan<T> plan;
    plan.bodies = tree.size_bodies();
    plan.dt = dt;
    plan.solver = solver;
    plan.scheme = scheme;
    plan.scene = scene;
    plan.gravity = !scene.gravity.isZero();
    plan.wind = scene.wind.has_value(); // a wind of no velocity is still air, which drags
    for (std::size_t k = 0; k < scene.pulls.size(); ++k)
        for (const Selected& target : select(tree, ranges, scene.pulls[k].on))
            plan.pulls.push_back({target.body, target.point_b.template cast<T>(), k});
    plan.forces = plan.wind || !plan.pulls.empty();
    plan.velocity = (plan.wind && solver == Solver::analytic) || wishes.velocity;
    plan.torque = wishes.torque;
    plan_root_motion(plan, ranges);
    plan.top = plan.wind ? highest_reach(tree, plan.splines, plan.moved) : 0;
    plan_bodies(plan, tree, scene);
    plan.refresh_reason = solver != Solver::analytic ? std::string("solver ") + solver_name(solver)
                          : !(refresh > 0)           ? "not asked for"
                          : plan.root_motion         ? "/root_motion"
                          : scene.joint_limit        ? "/joint_limit"
                                                     : "";
    if (plan.refresh_reason.empty()) {
        plan.refresh = refresh;
        plan.refresh_reason = "frozen coefficients, tolerance " + text(refresh);
    }
    plan.joint_limit = scene.joint_limit.has_value();
    if (plan.joint_limit) plan_joint_limit(plan, tree);
    if (plan.wind) plan_surfaces(plan, tree, scene);
    if (solver == Solver::analytic) plan_modes(plan, tree, scene);
    if (solver == Solver::coupled && plan.gravity) plan_carried_moments(plan, tree);
    plan.lanes.reason = "not asked for";
    if (simd) {
        plan.target = *simd;
        fast::plan_lanes(plan);
        fast::plan_sleep(plan, sleep);
        if (plan.lanes.on) plan.velocity = wishes.velocity; // the drag finds its own
    }
    explain(plan, wishes);
    return plan;
}

template Plan<float> make_plan(const Tree&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                               Scheme, std::optional<fast::Target>, double, double);
template Plan<double> make_plan(const Tree&, const std::vector<TreeRange>&, const Scene&, const Wishes&, double, Solver,
                                Scheme, std::optional<fast::Target>, double, double);

} // namespace bough
