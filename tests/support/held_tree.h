// held_tree.h: trees that attachments hold (lib/coupled/attachment.h), for their tests.
//
// hold(body, k, c)   an attachment of a point of that body
// twig()             a twig of 0.8 mm, 0.36 m of it in 12 pieces
// Held<T>            a run of a tree, plain or in lanes
// check_grid, check_rest   of any stiffness; where energy is least
#pragma once
#include "lib/analytic/analytic_state.h"
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
    Held(const Tree& tree, const Scene& scene, bool lanes, double dt = 1.0 / 30, Scheme scheme = Scheme::p12,
         Solver solver = Solver::coupled)
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, dt, solver, scheme,
                            lanes ? fast::best_target() : std::nullopt)),
          state(make_state(plan)) {}
    void step() {
        advance(plan, state);
        present(plan, state);
    }
    const Attached& held(std::size_t k = 0) const {
        if (const auto* work = dynamic_cast<const AnalyticWork<T>*>(&*state.own)) return work->held.all[k];
        return coupled_state(state).attachments.all[k];
    }
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
    // [J] The most in the first 60 of 240 frames, and in the third and the last 60.
    struct Energies {
        double early = 0, third = 0, last = 0;
    };
    Energies energies() {
        Energies most;
        for (int f = 0; f < 240; ++f) {
            step();
            const double energy = kinetic();
            REQUIRE(std::isfinite(energy));
            if (f < 60) most.early = std::max(most.early, energy);
            if (f >= 120 && f < 180) most.third = std::max(most.third, energy);
            if (f >= 180) most.last = std::max(most.last, energy);
        }
        return most;
    }
};

// 240 steps of 1/120 s, one number at a time and in lanes, in both precisions. see(plain, lanes): what else is looked at, at the end.
template <class See> void check_lanes(const Tree& tree, const Scene& scene, const See& see) {
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        Held<double> plain(tree, scene, false, 1.0 / 120, scheme), lanes(tree, scene, true, 1.0 / 120, scheme);
        Held<float> single(tree, scene, true, 1.0 / 120, scheme);
        double moved = 0, off = 0, off_single = 0;
        for (int f = 0; f < 240; ++f) {
            plain.step();
            lanes.step();
            single.step();
            for (std::size_t i = 0; i < plain.plan.bodies; ++i) {
                const Vec3& x = plain.state.x_w[i];
                moved = std::max(moved, plain.state.theta[i].norm());
                off = std::max(off, (x - lanes.state.x_w[i]).norm());
                off_single = std::max(off_single, (x - single.state.x_w[i].cast<double>()).norm());
            }
        }
        CAPTURE(scheme_of(scheme).name);
        CHECK(moved > 0.1);
        CHECK(off < 1e-9);
        CHECK(off_single < 5e-3);
        see(plain, lanes);
    }
}

// The first two attachments led about from where they are, a and b.
inline void check_order(Motion motion, const Vec3& a, const Vec3& b) {
    motion.scene.attachments[0].time = {0, 0.4, 0.8, 1};
    motion.scene.attachments[1].time = {0, 0.5, 1};
    motion.scene.attachments[0].position = {a, a + Vec3(0.2, 0, 0.1), a + Vec3(0, -0.1, 0.2), a};
    motion.scene.attachments[1].position = {b, b + Vec3(0, -0.1, 0.1), b};
    const Track truth = truth_of(motion);
    const double coarse = error_of(motion, truth, Scheme::p12, 1), fine = error_of(motion, truth, Scheme::p12, 4);
    CAPTURE(coarse, fine);
    CHECK(coarse < 0.02);
    CHECK(order_at(motion, truth, Scheme::p12, 4) > 1.8);
    CHECK(order_at(motion, truth, Scheme::p34, 4) > 1.8);
}

// Where a twig is held: in its reach, beside it, three times as far as it reaches, and moved to and fro.
inline std::vector<Attachment> hands(std::int64_t body, double k, double c) {
    std::vector<Attachment> all(4, hold(body, k, c));
    all[0].target = Vec3(0.1, 0.25, 0.05);
    all[1].target = Vec3(-0.3, 0.05, 0.1);
    all[2].target = Vec3(1, 0.3, -0.2);
    all[3].time = {0, 0.3, 0.6, 0.9, 1.2};
    all[3].position = {Vec3(0, 0.36, 0), Vec3(0.3, 0.2, 0), Vec3(0, 0.2, 0.6), Vec3(-0.3, 0.3, 0), Vec3(0.2, 0.2, 0.1)};
    return all;
}

template <class T> void check_grid(Solver solver, bool lanes) {
    const Tree tree = twig();
    for (const double k : {0.0, 1e-3, 1.0, 20.0, 1e3, 1e5, 1e7, 1e9, 1e12})
        for (const double c : {0.0, 1e-2, 1.0, 1e3, 1e9}) {
            if (k == 0 && c == 0) continue;
            for (std::size_t hand = 0; hand < 4; ++hand) {
                Scene scene = solver::empty_scene();
                scene.gravity = Vec3(0, -9.81, 0);
                scene.attachments = {hands(11, k, c)[hand]};
                Held<T> run(tree, scene, lanes, 1.0 / 30, Scheme::p12, solver);
                CAPTURE(sizeof(T), lanes, k, c, hand);
                const auto [early, third, last] = run.energies();
                CHECK(run.largest_angle() < 3.2);
                CHECK(last <= 1.05 * third + 5e-5); // [J] it falls by its length for 5e-4
                if (solver == Solver::coupled) CHECK(last <= 0.05 * early + 5e-5);
                const bool creeps = solver == Solver::analytic && c > k; // in c/k seconds; coupled takes c as weaker
                if (hand < 2 && k >= 1e3 && !creeps)
                    CHECK((run.point() - *scene.attachments[0].target).norm() < 0.05); // as it comes to rest
            }
        }
}

// [J] Elastic and potential energy of the chain of bodies [first, end); visit(body, x, R): where theta puts each.
template <class Visit>
double chain_energy(const Tree& tree, const Scene& scene, const Eigen::VectorXd& theta, std::size_t first,
                    std::size_t end, const Visit& visit) {
    long double sum = 0;
    Mat3 R = Mat3::Identity();
    Vec3 x = Vec3::Zero();
    for (std::size_t i = first; i < end; ++i) {
        const Vec3 angle = theta.segment<3>(3 * Eigen::Index(i));
        x += R * tree.joint_position[i];
        R = R * tree.joint_rotation[i].toRotationMatrix() *
            Mat3(Eigen::AngleAxisd(angle.norm(), angle.stableNormalized()));
        sum += angle.dot(tree.stiffness[i].cwiseProduct(angle)) / 2;
        sum -= tree.mass[i] * scene.gravity.dot(x + R * tree.com[i]);
        visit(i, x, R);
    }
    return double(sum);
}

// The energy's gradient where the run stands is nothing beside the moments that stand against each other there.
template <class Energy>
void check_least(const Held<double>& run, const Tree& tree, double k, double within, const Energy& energy_at) {
    Eigen::VectorXd at(3 * Eigen::Index(tree.size_bodies()));
    double moment = 0; // [N m]
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        at.segment<3>(3 * Eigen::Index(i)) = run.state.theta[i];
        moment = std::max(moment, tree.stiffness[i].cwiseProduct(run.state.theta[i]).norm());
    }
    const Eigen::VectorXd gradient = gradient_of(energy_at, at);
    CAPTURE(k, gradient.norm());
    CHECK(moment > 0.05);
    CHECK(gradient.norm() < within * moment * std::max(1.0, k / 1e3));
}

// Where the sum of elastic, potential and the spring's energy is least, by differences of it: none of the solver's equations.
inline void check_rest(Solver solver, int frames, double within) {
    const Tree tree = make_tree::chain(5, 1.0, 0.006, 0.004, 0.1, {800, 2e9, 2e8, 0.05});
    Scene scene = solver::empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.pose = Pose::rest;
    for (const double k : {5.0, 300.0, 1e6}) {
        scene.attachments = {hold(3, k, 1)};
        scene.attachments[0].on.point = Vec3(0.001, 0, 0.15);
        scene.attachments[0].target = Vec3(0.5, 0.55, 0.2);
        Held<double> run(tree, scene, false, 1.0 / 30, Scheme::p12, solver);
        for (int f = 0; f < frames; ++f) advance(run.plan, run.state);
        present(run.plan, run.state);
        check_least(run, tree, k, within, [&](const Eigen::VectorXd& theta) {
            Vec3 held = Vec3::Zero();
            const double own = chain_energy(tree, scene, theta, 0, 5, [&](std::size_t i, const Vec3& x, const Mat3& R) {
                if (i == 3) held = x + R * *scene.attachments[0].on.point;
            });
            return own + k / 2 * (held - *scene.attachments[0].target).squaredNorm();
        });
        const Vec3 force = k * (*scene.attachments[0].target - run.point());
        CHECK((run.held().force - force).norm() < 1e-6 * force.norm());
    }
}

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
