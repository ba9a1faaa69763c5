#include "ring_down.h"
#include "../model/sway.h"
#include "../stages/state_update.h"
#include "advance.h"
#include <Eigen/Cholesky>
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

constexpr double periods = 3, least_samples = 8;

// Sum of squared residuals of the best a, b for f, d.
double misfit(const std::vector<double>& y, double dt, double f, double d) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double total = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        const double t = double(k) * dt, e = std::exp(-d * t), angle = 2 * std::numbers::pi * f * t;
        const Eigen::Vector2d base(e * std::cos(angle), e * std::sin(angle));
        normal += base * base.transpose();
        right += base * y[k];
        total += y[k] * y[k];
    }
    return total - right.dot(normal.ldlt().solve(right));
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

// Turns every joint by what an acceleration along x makes of it, so that the mean tip moves by 1 % of the height.
void deflect(const Plan<double>& plan, State<double>& state, const Tree& tree) {
    const std::size_t n = plan.bodies;
    std::vector<Vec3> h(n); // first moments of the composites about their joints
    for (std::size_t i = n; i-- > 0;) {
        h[i] += plan.mass[i] * (state.R_wb[i] * plan.com[i]);
        if (plan.parent[i] < 0) continue;
        const auto p = std::size_t(plan.parent[i]);
        h[p] += h[i] + plan.c_mass[i] * (state.x_w[i] - state.x_w[p]);
    }
    const State<double> rest = state;
    std::vector<Vec3> turn(n);
    for (std::size_t i = 0; i < n; ++i)
        turn[i] = (state.R_wb[i].transpose() * h[i].cross(Vec3::UnitX())).cwiseQuotient(plan.K[i]);
    double height = 0, moved = 0, scale = 1e-6;
    const std::vector<std::size_t> tips = tip_bodies(tree);
    // Two rounds: a tiny deflection says how far the tips go, the second is scaled by it.
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < n; ++i) state.theta[i] = rest.theta[i] + scale * turn[i];
        state_update(plan, state);
        moved = 0;
        for (const std::size_t i : tips) moved += (state.x_w[i] - rest.x_w[i]).norm() / double(tips.size());
        for (const std::size_t i : tips) height = std::max(height, rest.x_w[i].y());
        if (round == 0 && moved > 0) scale *= 0.01 * height / moved;
    }
}

double projection(const Plan<double>& plan, const std::vector<Vec3>& shape, const std::vector<Vec3>& rest,
                  const std::vector<Vec3>& now) {
    double sum = 0;
    for (std::size_t i = 0; i < plan.bodies; ++i) sum += plan.mass[i] * shape[i].dot(now[i] - rest[i]);
    return sum;
}

std::vector<Vec3> centres(const Plan<double>& plan, const State<double>& state) {
    std::vector<Vec3> x(plan.bodies);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = state.x_w[i] + state.R_wb[i] * plan.com[i];
    return x;
}

} // namespace

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
    Scene scene = problem.scene;
    scene.wind.reset();
    scene.pulls.clear();
    scene.root_motion.clear();
    scene.joint_inertia = how.inertia;
    if (scene.pose == Pose::rest) scene.pose = Pose::drawn;
    Tree scaled = problem.tree;
    for (Vec3& K : scaled.stiffness) {
        K *= scene.stiffness_scale;
        if (!(K.minCoeff() > 0)) return {};
    }
    const double about = sway_frequency(scaled, Vec3::UnitX(), scene.gravity.norm());
    if (!(about > 0)) return {};
    const auto samples = std::int64_t(periods / about / dt) + 1;
    if (double(samples) < least_samples) return {};
    Plan<double> plan;
    try {
        plan = make_plan<double>(problem.tree, problem.ranges, scene, {}, dt, how.solver);
    } catch (const std::domain_error&) {
        return {}; // the drawn pose does not hold: there is no rest to ring about
    }
    plan.tolerance = how.tolerance;
    State<double> state = make_state(plan);
    const std::vector<Vec3> rest = centres(plan, state);
    deflect(plan, state, problem.tree);
    std::vector<Vec3> shape = centres(plan, state);
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] -= rest[i];
    std::vector<double> y;
    double first = 0;
    for (std::int64_t k = 0; k < samples; ++k) {
        if (k > 0) advance(plan, state);
        tick();
        if (first_non_finite(state)) return {};
        const double value = projection(plan, shape, rest, centres(plan, state));
        if (k == 0) first = value;
        if (!(first > 0) || !std::isfinite(value)) return {};
        y.push_back(value / first);
    }
    return fit_damped_sinusoid(y, dt, about);
}

} // namespace bough
