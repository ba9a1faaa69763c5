// Poses against products of quaternions, velocities against central differences of the poses.
#include "lib/plan/state_update.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace solver;

namespace {

std::vector<Tree> updated_trees() {
    return {make_tree::branched(), make_tree::random_tree(200, 5),
            make_tree::forest({make_tree::branched(), make_tree::chain(20, 3, 0.1, 0.01, 0.1)})};
}

Quat turned_by(const Vec3& theta) {
    return Quat(Eigen::Quaterniond(Eigen::AngleAxisd(theta.norm(), theta.normalized())));
}

const Wishes with_velocity{true, false};

} // namespace

TEST_CASE("bodies are turned by the product of all rotations of their path and stay on their parents") {
    for (const Tree& tree : updated_trees()) {
        const auto plan = plan_of(tree, empty_scene());
        State<double> state = make_state(plan);
        shake(plan, state, 1, 1.0, 0);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            Quat q = Quat::Identity();
            Vec3 x = Vec3::Zero();
            // From the body inward: place the whole of what has been gathered into the next frame.
            for (std::int64_t k = std::int64_t(i); k >= 0; k = tree.parent[std::size_t(k)]) {
                const auto b = std::size_t(k);
                const Quat here = tree.joint_rotation[b] * turned_by(state.theta[b]);
                x = tree.joint_position[b] + (b == i ? Vec3(Vec3::Zero()) : Vec3(here * x));
                q = here * q;
            }
            CAPTURE(tree.name, i);
            CHECK((state.R_wb[i] - q.toRotationMatrix()).cwiseAbs().maxCoeff() < 1e-13);
            CHECK((state.x_w[i] - x).norm() < 1e-12);
            if (tree.parent[i] < 0) continue;
            const auto p = std::size_t(tree.parent[i]);
            CHECK((state.x_w[i] - state.x_w[p] - state.R_wb[p] * tree.joint_position[i]).norm() <
                  1e-14 * (1 + x.norm()));
        }
    }
}

TEST_CASE("velocities are the rates of the poses") {
    for (const Tree& tree : updated_trees()) {
        const auto plan = plan_of(tree, empty_scene(), 1.0 / 30, with_velocity);
        State<double> state = make_state(plan);
        shake(plan, state, 2, 1.5, 2.0);
        const double e = 1e-6;
        State<double> ahead = state, behind = state;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            ahead.theta[i] += e * state.theta_dot[i];
            behind.theta[i] -= e * state.theta_dot[i];
        }
        state_update(plan, ahead);
        state_update(plan, behind);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const auto com = [&](const State<double>& s) { return Vec3(s.x_w[i] + s.R_wb[i] * tree.com[i]); };
            const Mat3 spin = (ahead.R_wb[i] - behind.R_wb[i]) / (2 * e) * state.R_wb[i].transpose();
            CAPTURE(tree.name, i);
            CHECK((state.v_w[i] - (com(ahead) - com(behind)) / (2 * e)).norm() < 1e-7 * (1 + state.v_w[i].norm()));
            CHECK((state.omega_w[i] - Vec3(spin(2, 1), spin(0, 2), spin(1, 0))).norm() <
                  1e-7 * (1 + state.omega_w[i].norm()));
        }
        CHECK(state.v_w.back().norm() > 0.1);
    }
}

TEST_CASE("a tree at rest with theta zero stands as it was drawn and does not move") {
    const Tree tree = make_tree::branched();
    const auto plan = plan_of(tree, empty_scene(), 1.0 / 30, with_velocity);
    const State<double> state = make_state(plan);
    CHECK((state.x_w[1] - Vec3(0, 0.5, 0)).norm() < 1e-15);
    CHECK((state.x_w[4] - (state.x_w[1] + state.R_wb[1] * Vec3(0, 0, 0.3))).norm() < 1e-15);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) CHECK(state.v_w[i].norm() + state.omega_w[i].norm() == 0);
}

TEST_CASE("drawn, a tree's weight turns the springs and moves nothing") {
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    const State<double> at_rest = make_state(plan_of(tree, scene));
    scene.gravity = {0, -9.81, 0};
    scene.pose = Pose::drawn;
    const State<double> drawn = make_state(plan_of(tree, scene));
    CHECK(drawn.theta[5].norm() > 1e-4);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((drawn.x_w[i] - at_rest.x_w[i]).norm() < 1e-14);
        CHECK((drawn.R_wb[i] - at_rest.R_wb[i]).norm() < 1e-14);
    }
}

TEST_CASE("float poses agree with double") {
    const Tree tree = make_tree::random_tree(200, 6);
    const auto plan = plan_of<double>(tree, empty_scene(), 1.0 / 30, with_velocity);
    const auto single = plan_of<float>(tree, empty_scene(), 1.0 / 30, with_velocity);
    State<double> a = make_state(plan);
    State<float> b = make_state(single);
    shake(plan, a, 3, 1, 2);
    shake(single, b, 3, 1, 2);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CAPTURE(i);
        CHECK((a.x_w[i] - b.x_w[i].cast<double>()).norm() < 1e-5);
        CHECK((a.v_w[i] - b.v_w[i].cast<double>()).norm() < 1e-4);
    }
}
