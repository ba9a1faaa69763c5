// What single precision costs the coupled step on 1e4 bodies whose masses span 1e7: one step in float from a state of a
// run in double (rounded to float, with the float plan's constants, so that both precisions are given the same numbers).
//
// Its answer is put into the equations of that step, set up in double and solved by nobody: from the changes of theta and
// theta_dot the complex accelerations of all joints (one pair of poles: two real numbers give one complex), outward those of the
// bodies, inward the moments that they ask for, as in inverse_dynamics.h; what is left over at a joint is the residual. It is
// relative to the terms that cancel there, root mean squares over the joints. And the two answers are compared: by the
// moments M (a_float - a_double), a the mean acceleration of the step, by inverse_dynamics.h.
#include "tests/support/coupled_support.h"
#include "tests/support/inverse_dynamics.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace coupled;

namespace {

using Z = std::complex<double>;
using V = Eigen::Vector3cd;
using M = Eigen::Matrix3cd;

constexpr double dt = 1.0 / 30;

// A trunk of 10 pieces, and on each piece of a branch one of 5, half as long and 0.28 times as thick: five levels, 35 deep.
Tree large(double E) {
    Tree tree;
    const make_tree::Wood wood{900, E, E / 15, 0.002};
    std::vector<std::size_t> open;
    for (int i = 0; i < 10; ++i)
        open.push_back(make_tree::add_piece(tree, i - 1, i == 0 ? Vec3(0, 0, 0) : Vec3(0, 0, 2.5),
                                            i == 0 ? make_tree::upright() : make_tree::turn(0.03, Vec3(1, i, 0)), 2.5,
                                            0.4, 0.4, 0, 0, 0.1 * i, wood));
    make_tree::Dice dice{std::mt19937(4)};
    std::int32_t branch = 0;
    for (std::size_t k = 0; tree.size_bodies() < 10000; ++k) {
        auto on = std::int32_t(open[k]);
        const std::int32_t level = tree.level[open[k]] + 1;
        const double l = tree.size[open[k]].x() / 2, r = 0.28 * tree.size[open[k]].y();
        ++branch;
        for (int i = 0; i < 5; ++i) {
            const double around = dice(-3, 3), away = dice(0.5, 1.2), place = dice(0.2, 1), bend = dice(-0.2, 0.2);
            const Quat turn = i == 0
                                  ? Quat(make_tree::turn(around, Vec3::UnitZ()) * make_tree::turn(away, Vec3::UnitY()))
                                  : make_tree::turn(bend, Vec3(std::cos(around), std::sin(around), 0));
            const Vec3 at(0, 0, i == 0 ? 2 * l * place : l);
            on = std::int32_t(make_tree::add_piece(tree, on, at, turn, l, r, r, branch, level, 0.2 * i, wood));
            open.push_back(std::size_t(on));
        }
    }
    return tree;
}

template <class To, class From> void convert(std::vector<To>& to, const std::vector<From>& from) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        if constexpr (std::is_arithmetic_v<From>)
            to[i] = To(from[i]);
        else
            to[i] = from[i].template cast<typename To::Scalar>();
}

// The double plan, given the float one's constants.
void take_constants(Plan<double>& to, const Plan<float>& from) {
    convert(to.joint_position, from.joint_position);
    convert(to.R_pj, from.R_pj);
    convert(to.mass, from.mass);
    convert(to.com, from.com);
    convert(to.inertia_joint, from.inertia_joint);
    convert(to.K, from.K);
    convert(to.beta, from.beta);
    convert(fast::coupled_plan(to)->carried_moment, parts::bodies(from).carried_moment);
    convert(to.drag_area, from.drag_area);
}

template <class T> void take_state(State<T>& to, const State<double>& from) {
    to.step = from.step;
    convert(to.theta, from.theta);
    convert(to.theta_dot, from.theta_dot);
    convert(parts::theta_change(to), parts::theta_change(from));
    convert(parts::theta_dot_change(to), parts::theta_dot_change(from));
}

// `at`: the state after a step of a scheme of one pair of poles from theta_dot = eta, whose coupled[] is that step's set-up;
// theta, theta_dot: the changes to be judged.
double residual(const Plan<double>& plan, const State<double>& at, const std::vector<Vec3>& eta,
                const std::vector<Vec3>& theta, const std::vector<Vec3>& theta_dot) {
    const Pole& pole = scheme_of(parts::bodies(plan).scheme).pole[0];
    const Z p = pole.p, c = pole.c, s1 = dt / p, s2 = s1 * s1, slope = 1.0 / p - 0.5;
    const std::size_t n = plan.bodies;
    std::vector<V> alpha(n), a(n), N(n), F(n), tau(n);
    std::vector<double> size(n);
    for (std::size_t i = 0; i < n; ++i) {
        const CoupledBody<double>& b = parts::bodies(at).coupled[i];
        // 2 dt Re(c x_v) = theta_dot, 2 dt Re(c (dt x_v - eta) / p) = theta
        Eigen::Matrix2d two;
        const Z e = c * dt / p;
        two << c.real(), -c.imag(), e.real(), -e.imag();
        const Eigen::Matrix2d inverse = two.inverse();
        V x_v;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d known(theta_dot[i][k] / (2 * dt),
                                        theta[i][k] / (2 * dt) + (c / p).real() * eta[i][k]);
            const Eigen::Vector2d x = inverse * known;
            x_v[k] = Z(x[0], x[1]);
        }
        const V gamma = b.rates.inverse() * (-p * x_v);
        V alpha_p = V::Zero(), a_p = V::Zero();
        if (plan.parent[i] >= 0) {
            alpha_p = alpha[std::size_t(plan.parent[i])];
            a_p = a[std::size_t(plan.parent[i])];
        }
        alpha[i] = alpha_p + gamma;
        a[i] = a_p - cross_matrix(b.r) * alpha_p;
        const Mat3 C = cross_matrix(b.c), D = plan.wind ? b.D : Mat3(Mat3::Zero());
        const V turning = b.J * alpha[i] + s2 * (b.H * alpha[i]) + s1 * (C * D * C.transpose() * alpha[i]);
        N[i] = turning + plan.mass[i] * (C * a[i]) + s1 * (C * D * a[i]) + b.N + s1 * (b.H * b.omega_0) +
               slope * b.slope_N;
        F[i] = plan.mass[i] * (C.transpose() * alpha[i]) + s1 * (D * C.transpose() * alpha[i]) + plan.mass[i] * a[i] +
               s1 * (D * a[i]) + b.F + slope * b.slope_F;
        size[i] = turning.norm() + (plan.mass[i] * (C * a[i])).norm() + b.N.norm();
        const Mat3 stiffness = b.rates.transpose() * plan.K[i].asDiagonal() * b.rates;
        tau[i] = b.torque - s1 * b.torque_rate - (plan.beta[i] * s1 + s2) * (stiffness * gamma);
    }
    double squares = 0, sizes = 0;
    for (std::size_t i = n; i-- > 0;) {
        squares += (N[i] - tau[i]).squaredNorm();
        sizes += std::pow(size[i] + tau[i].norm(), 2);
        if (plan.parent[i] < 0) continue;
        const auto q = std::size_t(plan.parent[i]);
        const V lever = cross_matrix(parts::bodies(at).coupled[i].r) * F[i];
        N[q] += N[i] + lever;
        F[q] += F[i];
        size[q] += N[i].norm() + lever.norm();
    }
    return std::sqrt(squares / sizes);
}

// Of M (a - b) / dt relative to all moments that act at the state.
double moment_of_difference(const Plan<double>& plan, const State<double>& from, const std::vector<Vec3>& a,
                            const std::vector<Vec3>& b) {
    Plan<double> bare = plan;
    bare.wind = false;
    bare.pulls.clear();
    bare.scene.gravity.setZero();
    for (Vec3& K : bare.K) K.setZero();
    const std::vector<Vec3> none(plan.bodies, Vec3::Zero());
    std::vector<Vec3> rate(plan.bodies), mean(plan.bodies), off(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Mat3 J = body_rate_jacobian(from.theta[i]);
        rate[i] = J * from.theta_dot[i];
        mean[i] = J * b[i] / dt;
        off[i] = J * (a[i] - b[i]) / dt;
    }
    const double time = double(from.step) * dt;
    return inverse_dynamics(bare, from.theta, none, off, time).rms /
           inverse_dynamics(plan, from.theta, rate, mean, time).moment_rms;
}

} // namespace

TEST_CASE("a step in float leaves a residual of 1e-6 of the moments at most: 1e4 bodies, mass ratio 1e7, E from 1e10 "
          "to 1e17") {
    for (const double E : {1e11, 1e14, 1e17}) {
        const Tree tree = large(E);
        const auto [lightest, heaviest] = std::minmax_element(tree.mass.begin(), tree.mass.end());
        REQUIRE(*heaviest > 1e7 * *lightest);
        Scene scene;
        scene.pose = Pose::rest;
        scene.wind = wind_preset("breeze");
        CoupledRun<double> run(tree, scene);
        CoupledRun<float> single(tree, scene);
        take_constants(run.plan, single.plan);
        run.steps(20);
        take_state(single.state, run.state);
        State<double> start = run.state;
        convert(start.theta, single.state.theta);
        convert(start.theta_dot, single.state.theta_dot);
        convert(parts::theta_change(start), parts::theta_change(single.state));
        convert(parts::theta_dot_change(start), parts::theta_dot_change(single.state));
        run.state = start;
        run.steps(1);
        single.steps(1);
        std::vector<Vec3> theta, theta_dot;
        convert(theta, parts::theta_change(single.state));
        convert(theta_dot, parts::theta_dot_change(single.state));
        const double of_double = residual(run.plan, run.state, start.theta_dot, parts::theta_change(run.state),
                                          parts::theta_dot_change(run.state));
        const double of_float = residual(run.plan, run.state, start.theta_dot, theta, theta_dot);
        const double apart = moment_of_difference(run.plan, start, theta_dot, parts::theta_dot_change(run.state));
        CAPTURE(E, of_double, of_float, apart);
        REQUIRE(run.state.flags.fast_turns + single.state.flags.fast_turns == 0);
        CHECK(of_double < 1e-12);
        CHECK(of_float < 1e-6);
        CHECK(apart < 1e-6);
    }
}
