// The composite sweep against sums over each joint's subtree, body by body; the drag's row sums against double loops.
#include "lib/analytic/composite.h"
#include "lib/analytic/external_forces.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <Eigen/SVD>
#include <catch2/catch.hpp>

using namespace bough;
using namespace solver;

namespace {

struct Moving {
    Plan<double> plan;
    State<double> state;
};

Moving moving(const Tree& tree, bool wind, unsigned seed) {
    Scene scene = empty_scene();
    if (wind) {
        scene.wind = Wind{};
        scene.wind->velocity = {5, 1, -3};
    }
    Pull pull;
    pull.on.body = std::int64_t(tree.size_bodies() / 2);
    pull.time = {0, 1};
    pull.force = {Vec3(7, -3, 2), Vec3(7, -3, 2)};
    scene.pulls.push_back(pull);
    Moving m{plan_of(tree, scene), {}};
    m.state = make_state(m.plan);
    shake(m.plan, m.state, seed, 0.8, 5);
    if (wind) evaluate_wind(*scene.wind, 0.5, m.state.wind);
    parts::external_forces(m.plan, m.state, 0.5);
    parts::composite_update(m.plan, m.state);
    return m;
}

bool outboard(const Tree& tree, std::size_t b, std::size_t j) { // b is j or hangs on it
    std::int64_t k = std::int64_t(b);
    while (k > std::int64_t(j)) k = tree.parent[std::size_t(k)];
    return k == std::int64_t(j);
}

// Way along the tree from joint j to the centre of mass of b, which is outboard of it.
double way(const Tree& tree, std::size_t b, std::size_t j) {
    // Of a leaf, whose own turning the air damps, out to where its inertia would be in one point.
    const double spread = is_flat(tree.kind[b]) ? tree.inertia[b].trace() / (2 * tree.mass[b]) : 0;
    double length = std::sqrt(tree.com[b].squaredNorm() + spread);
    for (std::size_t k = b; k != j; k = std::size_t(tree.parent[k])) length += tree.joint_position[k].norm();
    return length;
}

std::vector<Tree> trees() {
    return {make_tree::branched(), make_tree::random_tree(200, 1), make_tree::random_tree(200, 2),
            make_tree::random_tree(200, 3),
            make_tree::forest({make_tree::branched(), make_tree::chain(5, 2, 0.05, 0.01)})};
}

constexpr double rounding = 1e-13;

} // namespace

TEST_CASE("a composite's mass, first moment and inertia are sums over the bodies outboard") {
    unsigned seed = 0;
    for (const Tree& tree : trees()) {
        const Moving m = moving(tree, false, ++seed);
        const State<double>& s = m.state;
        for (std::size_t j = 0; j < tree.size_bodies(); ++j) {
            double mass = 0;
            Vec3 h = Vec3::Zero(), f = Vec3::Zero(), tau = Vec3::Zero();
            Mat3 J = Mat3::Zero();
            for (std::size_t b = j; b < tree.size_bodies(); ++b) {
                if (!outboard(tree, b, j)) continue;
                const Vec3 r = s.x_w[b] + s.R_wb[b] * tree.com[b] - s.x_w[j];
                mass += tree.mass[b];
                h += tree.mass[b] * r;
                J += s.R_wb[b] * tree.inertia[b] * s.R_wb[b].transpose() +
                     tree.mass[b] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
                f += parts::joints(s).f_w[b];
                tau += parts::joints(s).tau_w[b] + (s.x_w[b] - s.x_w[j]).cross(parts::joints(s).f_w[b]);
            }
            CAPTURE(tree.name, seed, j);
            CHECK(std::abs(m.plan.c_mass[j] - mass) <= rounding * mass);
            CHECK((parts::joints(s).c_h_w[j] - h).norm() <= rounding * (mass + h.norm()));
            CHECK((parts::joints(s).c_J_w[j] - J).norm() <= 10 * rounding * J.norm());
            CHECK((parts::joints(s).c_f_w[j] - f).norm() <= rounding * 10);
            CHECK((parts::joints(s).c_tau_w[j] - tau).norm() <= rounding * 100);
        }
    }
}

TEST_CASE("with wind, forces and drag of a composite are sums over the bodies outboard") {
    unsigned seed = 10;
    for (const Tree& tree : trees()) {
        const Moving m = moving(tree, true, ++seed);
        const State<double>& s = m.state;
        for (std::size_t j = 0; j < tree.size_bodies(); ++j) {
            Vec3 f = Vec3::Zero(), tau = f, drag = f, drag_tau = f;
            double size = 0, row = 0;
            for (std::size_t b = j; b < tree.size_bodies(); ++b) {
                if (!outboard(tree, b, j)) continue;
                // Moments of forces at the centres of mass; the pull acts there too.
                const Vec3 r = s.x_w[b] + s.R_wb[b] * tree.com[b] - s.x_w[j];
                f += parts::joints(s).f_w[b];
                tau += r.cross(parts::joints(s).f_w[b]);
                drag += parts::joints(s).drag_f_w[b];
                // A leaf's own turning is damped by a torque beside.
                drag_tau += r.cross(parts::joints(s).drag_f_w[b]) + parts::joints(s).drag_tau_w[b] -
                            Vec3(s.R_wb[b] * tree.com[b]).cross(parts::joints(s).drag_f_w[b]);
                size += (parts::joints(s).f_w[b].norm() + parts::joints(s).drag_f_w[b].norm()) * (1 + r.norm());
                double W = 0; // how far the weights of the path move the body
                for (std::int64_t k = std::int64_t(b); k >= 0; k = tree.parent[std::size_t(k)])
                    W += way(tree, b, std::size_t(k)) / parts::joints(m.plan).inverse_weight[std::size_t(k)];
                row += way(tree, b, j) * parts::joints(s).drag_bound[b] * W;
            }
            CAPTURE(tree.name, seed, j);
            CHECK((parts::joints(s).c_f_w[j] - f).norm() <= rounding * size);
            CHECK((parts::joints(s).c_tau_w[j] - tau).norm() <= 10 * rounding * size);
            CHECK((parts::joints(s).c_drag_f_w[j] - drag).norm() <= rounding * size);
            CHECK((parts::joints(s).c_drag_tau_w[j] - drag_tau).norm() <= 10 * rounding * size);
            CHECK(std::abs(parts::joints(s).c_drag_row[j] - row) <= 10 * rounding * row);
        }
    }
}

TEST_CASE("the drag's diagonal bounds the weighted rows of its matrix over the joints") {
    unsigned seed = 20;
    for (const Tree& tree : trees()) {
        const Moving m = moving(tree, true, ++seed);
        const State<double>& s = m.state;
        const std::size_t n = tree.size_bodies();
        make_tree::Dice dice{std::mt19937(seed)};
        std::vector<Mat3> C(n); // any matrix with the bound as its norm
        for (std::size_t b = 0; b < n; ++b) {
            const Vec3 axis = random_vector(dice, 1).normalized();
            C[b] = parts::joints(s).drag_bound[b] * (b % 2 ? Mat3(axis * axis.transpose()) : Mat3(Mat3::Identity()));
        }
        double tightest = 1e300;
        for (std::size_t j = 0; j < n; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < n; ++k) {
                Mat3 D = Mat3::Zero();
                for (std::size_t b = std::max(j, k); b < n; ++b) {
                    if (!outboard(tree, b, j) || !outboard(tree, b, k)) continue;
                    const Vec3 at = s.x_w[b] + s.R_wb[b] * tree.com[b];
                    D += cross_matrix<double>(at - s.x_w[j]).transpose() * C[b] * cross_matrix<double>(at - s.x_w[k]);
                }
                if (D.isZero(0)) continue;
                const double norm = Eigen::JacobiSVD<Mat3>(D).singularValues()[0];
                sum += norm * parts::joints(m.plan).inverse_weight[j] / parts::joints(m.plan).inverse_weight[k];
            }
            const double d = parts::joints(m.plan).inverse_weight[j] * parts::joints(s).c_drag_row[j];
            CAPTURE(tree.name, seed, j);
            CHECK(d >= sum * (1 - 1e-12));
            tightest = std::min(tightest, d / std::max(sum, 1e-300));
        }
        CHECK(tightest < 10); // a bound, not just a large number
    }
}

TEST_CASE("the composite's float run agrees with double") {
    const Tree tree = make_tree::random_tree(200, 4);
    const Scene scene = empty_scene();
    const auto plan = plan_of<double>(tree, scene);
    const auto single = plan_of<float>(tree, scene);
    State<double> a = make_state(plan);
    State<float> b = make_state(single);
    shake(plan, a, 5, 0.5, 0);
    shake(single, b, 5, 0.5, 0);
    parts::composite_update(plan, a);
    parts::composite_update(single, b);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CAPTURE(i);
        CHECK((parts::joints(a).c_J_w[i] - parts::joints(b).c_J_w[i].cast<double>()).norm() <
              3e-5 * parts::joints(a).c_J_w[i].norm());
        CHECK((parts::joints(a).c_h_w[i] - parts::joints(b).c_h_w[i].cast<double>()).norm() < 3e-5 * plan.c_mass[i]);
    }
}
