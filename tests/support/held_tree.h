// held_tree.h: trees that attachments hold (lib/coupled/attachment.h), for their tests.
//
// hold(body, k, c)   an attachment of a point of that body
// twig()             a twig of 0.8 mm, 0.36 m of it in 12 pieces
// Held<T>            a run of a tree by the coupled step, plain or in lanes
#pragma once
#include "lib/base/parallel.h"
#include "lib/base/rotation_maps.h"
#include "lib/coupled/attachment.h"
#include "tests/support/coupled_support.h"

namespace coupled {

inline Attachment hold(std::int64_t body, double k, double c) {
    Attachment held;
    held.on.body = body;
    held.on.point = Vec3(0, 0, 0.03);
    held.stiffness = k;
    held.damping = c;
    return held;
}

inline Tree twig() {
    return make_tree::chain(12, 0.36, 0.0004, 0.0004, 0.03, {800, 5e9, 5e8, 0.002});
}

// By differences of fourth order.
template <class Energy> Eigen::VectorXd gradient_of(const Energy& energy_at, const Eigen::VectorXd& at) {
    const double d = 1e-4;
    Eigen::VectorXd gradient(at.size());
    for (int j = 0; j < at.size(); ++j) {
        const auto shifted = [&](double s) {
            Eigen::VectorXd there = at;
            there[j] += s * d;
            return energy_at(there);
        };
        gradient[j] = (8 * (shifted(1) - shifted(-1)) - (shifted(2) - shifted(-2))) / (12 * d);
    }
    return gradient;
}

template <class T> struct Held {
    Plan<T> plan;
    State<T> state;
    Held(const Tree& tree, const Scene& scene, bool lanes, double dt = 1.0 / 30, Scheme scheme = Scheme::p12)
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, dt, Solver::coupled, scheme,
                            lanes ? std::optional(fast::best_target()) : std::nullopt)),
          state(make_state(plan)) {}
    void step() {
        advance(plan, state);
        present(plan, state);
    }
    const Attached& held(std::size_t k = 0) const { return coupled_state(state).attachments.all[k]; }
    Vec3 point(const AttachedEnd& of) const {
        return state.x_w[of.body].template cast<double>() + state.R_wb[of.body].template cast<double>() * of.point_b;
    }
    Vec3 point(std::size_t k = 0) const { return point(held(k)); }
    double largest_angle() const {
        double most = 0;
        for (const Vector3<T>& theta : state.theta) most = std::max(most, double(theta.norm()));
        return most;
    }
    double kinetic() const {
        double sum = 0;
        std::vector<Vec3> omega(plan.bodies), v(plan.bodies);
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            const Mat3 R = state.R_wb[i].template cast<double>();
            const RotationMaps<double> maps = rotation_maps<double>(state.theta[i].template cast<double>());
            omega[i] = R * (maps.R.transpose() * (maps.J * state.theta_dot[i].template cast<double>()));
            v[i].setZero();
            if (plan.parent[i] >= 0) {
                const auto p = std::size_t(plan.parent[i]);
                v[i] = v[p] + omega[p].cross(Vec3((state.x_w[i] - state.x_w[p]).template cast<double>()));
                omega[i] += omega[p];
            }
            const double m = double(plan.mass[i]);
            const Vec3 c = R * plan.com[i].template cast<double>(), w = R.transpose() * omega[i];
            sum += m * (v[i].squaredNorm() / 2 + v[i].dot(omega[i].cross(c))) +
                   w.dot(plan.inertia_joint[i].template cast<double>() * w) / 2;
        }
        return sum;
    }
};

// The hash after 20 frames in float lanes, which is the same on 1, 2 and 5 threads. see(run): what else is looked at.
template <class See> std::uint64_t hash_on_threads(const Tree& tree, const Scene& scene, const See& see) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        Held<float> run(tree, scene, true);
        for (int f = 0; f < 20; ++f) advance(run.plan, run.state);
        CHECK(run.state.calls[std::size_t(Stage::attachments)] == 20);
        see(run);
        hashes.push_back(state_hash(run.plan, run.state));
    }
    CHECK(hashes[0] == hashes[1]);
    CHECK(hashes[0] == hashes[2]);
    return hashes[0];
}
inline std::uint64_t hash_on_threads(const Tree& tree, const Scene& scene) {
    return hash_on_threads(tree, scene, [](const Held<float>&) {});
}

} // namespace coupled
