// A tree's answer to impulses, against one dense solve.
#include "lib/free/path_response.h"
#include "tests/support/free_support.h"
#include <Eigen/Cholesky>

using namespace bough;
using namespace free_bodies;

TEST_CASE("A tree answers impulses as one dense solve of M + h beta K + h^2 K does") {
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    scene.balls = {ball(Vec3(9, 9, 9), Vec3::Zero())};
    FreeRun<> run(tree, scene, ways[0]);
    run.world.poses.begin(run.plan, run.state);
    const std::size_t n = tree.size_bodies();
    // J_i: velocity of body i's point p by the joints' rates, drawn pose: (x - x_k) crossed from the axes of joint k.
    const auto jacobian = [&](std::size_t body, const Vec3& p, bool angular) {
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, std::ptrdiff_t(3 * n));
        for (std::int64_t k = std::int64_t(body); k >= 0; k = tree.parent[std::size_t(k)]) {
            const BodyPose pose = run.world.poses.of(std::size_t(k));
            J.block<3, 3>(0, 3 * k) = angular ? pose.R_joint : Mat3(-cross_matrix(Vec3(p - pose.x)) * pose.R_joint);
        }
        return J;
    };
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(std::ptrdiff_t(3 * n), std::ptrdiff_t(3 * n));
    for (std::size_t i = 0; i < n; ++i) {
        const BodyPose pose = run.world.poses.of(i);
        const Eigen::MatrixXd v = jacobian(i, pose.at(tree.com[i]), false), w = jacobian(i, Vec3::Zero(), true);
        D += tree.mass[i] * v.transpose() * v + w.transpose() * (pose.R * tree.inertia[i] * pose.R.transpose()) * w;
        const double h = run.plan.dt;
        for (int k = 0; k < 3; ++k) {
            const auto at = std::ptrdiff_t(3 * i) + k;
            D(at, at) += (h * tree.damping[i] + h * h) * tree.stiffness[i][k];
        }
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(D);
    // Two impulses at once; velocities at a third body too.
    const std::vector<std::size_t> bodies{5, 13, 9};
    std::vector<Vec3> points;
    for (const std::size_t i : bodies) points.push_back(run.world.poses.of(i).at(Vec3(0.01, 0.02, 0.1)));
    const Vec3 a(0.3, -1, 0.2), b(-0.5, 0.1, 0.4);
    PathResponse response(run.plan, run.world.poses, run.world.response, run.world.rigid,
                          std::vector<std::int64_t>(bodies.begin(), bodies.end()));
    response.apply_impulse(0, points[0], a);
    response.apply_impulse(1, points[1], b);
    const Eigen::VectorXd rates = solver.solve(jacobian(bodies[0], points[0], false).transpose() * a +
                                               jacobian(bodies[1], points[1], false).transpose() * b);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 truth = jacobian(bodies[k], points[k], false) * rates;
        CHECK((response.velocity(k, points[k]) - truth).norm() < 1e-9 * truth.norm());
    }
    const Eigen::MatrixXd J = jacobian(bodies[0], points[0], false);
    const Mat3 truth = J * solver.solve(J.transpose());
    CHECK((response.mobility(0, points[0], true) - truth).norm() < 1e-9 * truth.norm());
    // Without springs, as of the instant.
    Eigen::MatrixXd M = D;
    for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
            const auto at = std::ptrdiff_t(3 * i) + k;
            M(at, at) -= (run.plan.dt * tree.damping[i] + run.plan.dt * run.plan.dt) * tree.stiffness[i][k];
        }
    const Mat3 at_once = J * M.ldlt().solve(J.transpose());
    CHECK((response.mobility(0, points[0], false) - at_once).norm() < 1e-6 * at_once.norm());
    // Springs out of their rest, of the joints on the ways alone: -h K (theta + (h + beta) theta_dot). Angles are too small to turn anything.
    Eigen::VectorXd moments = Eigen::VectorXd::Zero(std::ptrdiff_t(3 * n));
    for (std::size_t i = 0; i < n; ++i) {
        run.state.theta[i] = 1e-9 * Vec3(double(i % 3) - 1, double(i % 5) - 2, 0.5);
        run.state.theta_dot[i] = 1e-8 * Vec3(double(i % 2), 1 - double(i % 4), -0.3);
    }
    for (const std::size_t body : bodies)
        for (std::int64_t i = std::int64_t(body); i >= 0; i = tree.parent[std::size_t(i)]) {
            const auto k = std::size_t(i);
            const double h = run.plan.dt;
            moments.segment<3>(3 * i) = -h * tree.stiffness[k].cwiseProduct(Vec3(
                                                 run.state.theta[k] + (h + tree.damping[k]) * run.state.theta_dot[k]));
        }
    const Eigen::VectorXd sprung = solver.solve(moments);
    run.world.poses.begin(run.plan, run.state);
    PathResponse bent(run.plan, run.world.poses, run.world.response, run.world.rigid,
                      std::vector<std::int64_t>(bodies.begin(), bodies.end()));
    bent.apply_springs();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 of_springs = jacobian(bodies[k], points[k], false) * sprung;
        CHECK((bent.velocity(k, points[k]) - of_springs).norm() < 1e-7 * of_springs.norm());
    }
}
