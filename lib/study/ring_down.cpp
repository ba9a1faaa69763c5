#include "ring_down.h"
#include "../plan/state_update.h"
#include "solvers.h"
#include <cmath>
#include <numbers>

namespace bough {
namespace {

constexpr double periods = 3, least_samples = 8;
constexpr double amplitude = 0.01; // [rad] of the joint that turns most

// Sum of squared residuals of the best a, b for f, d: y = e^(-d t) (a cos + b sin), whose two equations are solved by Cramer's rule.
double misfit(const std::vector<double>& y, double dt, double f, double d) {
    double cc = 0, cs = 0, ss = 0, yc = 0, ys = 0, yy = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        const double t = double(k) * dt, e = std::exp(-d * t), angle = 2 * std::numbers::pi * f * t;
        const double c = e * std::cos(angle), s = e * std::sin(angle);
        cc += c * c, cs += c * s, ss += s * s;
        yc += y[k] * c, ys += y[k] * s, yy += y[k] * y[k];
    }
    return yy - (ss * yc * yc - 2 * cs * yc * ys + cc * ys * ys) / (cc * ss - cs * cs);
}

// Smallest value of `cost` in [a, b] by golden sections.
template <class Cost> double golden(double a, double b, const Cost& cost) {
    const double ratio = (std::sqrt(5.0) - 1) / 2;
    double c = b - ratio * (b - a), d = a + ratio * (b - a), fc = cost(c), fd = cost(d);
    for (int k = 0; k < 60 && b - a > 1e-12 * (std::abs(a) + std::abs(b)); ++k) {
        if (fc < fd) {
            b = d, d = c, fd = fc;
            c = b - ratio * (b - a), fc = cost(c);
        } else {
            a = c, c = d, fc = fd;
            d = a + ratio * (b - a), fd = cost(d);
        }
    }
    return (a + b) / 2;
}

// M phi: the joints' moments [body axes] of unit-step accelerations phi of the joints, at the plan's start pose, without
// velocities: outward the bodies' accelerations, inward the wrenches they need.
std::vector<Vec3> inertia_times(const Plan<double>& plan, const State<double>& state, const std::vector<Vec3>& phi) {
    const std::size_t n = plan.bodies;
    std::vector<Vec3> alpha(n), a(n), F(n), N(n), result(n);
    const auto arm = [&](std::size_t i) { return Vec3(state.x_w[i] - state.x_w[std::size_t(plan.parent[i])]); };
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = plan.parent[i] < 0;
        const auto p = std::size_t(plan.parent[i]);
        const Mat3& R = state.R_wb[i];
        alpha[i] = R * phi[i] + (root ? Vec3(Vec3::Zero()) : alpha[p]);
        a[i] = root ? Vec3(Vec3::Zero()) : Vec3(a[p] + alpha[p].cross(arm(i)));
        const Vec3 c = R * plan.com[i];
        F[i] = plan.mass[i] * (a[i] + alpha[i].cross(c));
        N[i] = R * (plan.inertia_joint[i] * (R.transpose() * alpha[i])) + plan.mass[i] * c.cross(a[i]);
    }
    for (std::size_t i = n; i-- > 0;) {
        result[i] = state.R_wb[i].transpose() * N[i];
        if (plan.parent[i] < 0) continue;
        const auto p = std::size_t(plan.parent[i]);
        F[p] += F[i];
        N[p] += N[i] + arm(i).cross(F[i]);
    }
    return result;
}

double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

} // namespace

Mode first_mode(const Plan<double>& plan) {
    const State<double> state = make_state(plan);
    Mode mode;
    mode.shape.assign(plan.bodies, Vec3::Zero());
    for (std::size_t i = 0; i < plan.bodies; ++i) // a push along x bends each joint about the axis across it
        mode.shape[i] = state.R_wb[i].transpose() * Vec3(0, 0, -1) / double(plan.bodies);
    double previous = 0;
    for (int k = 0; k < 1000; ++k) {
        mode.moment = inertia_times(plan, state, mode.shape);
        double kk = 0;
        for (std::size_t i = 0; i < plan.bodies; ++i) kk += mode.shape[i].dot(plan.K[i].cwiseProduct(mode.shape[i]));
        const double modal_mass = product(mode.shape, mode.moment), square = kk / modal_mass;
        mode.frequency = std::sqrt(square) / (2 * std::numbers::pi);
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            mode.shape[i] /= std::sqrt(modal_mass);
            mode.moment[i] /= std::sqrt(modal_mass);
        }
        if (k > 20 && std::abs(square - previous) < 1e-10 * square) break;
        previous = square;
        for (std::size_t i = 0; i < plan.bodies; ++i) mode.shape[i] = mode.moment[i].cwiseQuotient(plan.K[i]);
    }
    return mode;
}

RingDown fit_damped_sinusoid(const std::vector<double>& y, double dt, double about) {
    const double highest = std::min(8 * about, 0.5 / dt);
    double best = INFINITY, f = NAN, d = NAN;
    constexpr int steps = 240;
    const double lowest = 0.3 * about, ratio = std::pow(highest / lowest, 1.0 / steps);
    for (int k = 0; k <= steps; ++k)
        for (int j = 0; j < 12; ++j) {
            const double trial = lowest * std::pow(ratio, k), decay = j == 0 ? 0 : 0.01 * about * std::pow(2, j - 1);
            const double left = misfit(y, dt, trial, decay);
            if (left < best) best = left, f = trial, d = decay;
        }
    for (int round = 0; round < 30; ++round) {
        const double width = std::pow(0.75, round);
        f = golden(f * (1 - 0.1 * width), std::min(f * (1 + 0.1 * width), 0.5 / dt),
                   [&](double trial) { return misfit(y, dt, trial, d); });
        const double reach = width * (d + 0.1 * f);
        d = golden(d - reach, d + reach, [&](double trial) { return misfit(y, dt, f, trial); });
    }
    return {f, d};
}

RingDown ring_down(const Problem& problem, const Variant& how, double dt, const std::function<void()>& tick) {
    Scene scene = for_solver(problem.scene, how.solver);
    scene.wind.reset();
    scene.pulls.clear();
    scene.attachments.clear();
    scene.root_motion.clear();
    scene.gravity.setZero();
    scene.pose = Pose::rest;
    scene.joint_inertia = how.inertia;
    Plan<double> plan = make_plan<double>(problem.tree, problem.ranges, scene, {}, dt, how.solver, how.scheme,
                                          problem.simd, 0, how.tolerance);
    for (const Vec3& K : plan.K)
        if (!(K.minCoeff() > 0)) return {};
    const Mode mode = first_mode(plan);
    const auto samples = std::int64_t(periods / mode.frequency / dt) + 1;
    if (!(mode.frequency > 0) || double(samples) < least_samples) return {};
    double largest = 0;
    for (const Vec3& turn : mode.shape) largest = std::max(largest, turn.norm());
    State<double> state = make_state(plan);
    for (std::size_t i = 0; i < plan.bodies; ++i) state.theta[i] = mode.shape[i] * (amplitude / largest);
    restart(plan, state);
    std::vector<double> y;
    for (std::int64_t k = 0; k < samples; ++k) {
        if (k > 0) advance(plan, state);
        present(plan, state);
        tick();
        if (first_non_finite(state)) return {};
        y.push_back(product(mode.moment, state.theta) / (amplitude / largest));
    }
    return fit_damped_sinusoid(y, dt, mode.frequency);
}

} // namespace bough
