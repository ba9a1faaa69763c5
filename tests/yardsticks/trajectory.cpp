#include "trajectory.h"

namespace yardstick {
namespace {

// d turn/dt = turn (0, rate) / 2, on the quaternion's four numbers.
Eigen::Vector4d turn_rate(const Quat& turn, const Vec3& rate) {
    return (turn * Quat(0, rate.x() / 2, rate.y() / 2, rate.z() / 2)).coeffs();
}

struct Slope {
    std::vector<Eigen::Vector4d> turn;
    std::vector<Vec3> rate;
};

class Integrator {
public:
    Integrator(Engine& used, const Tree& of, const bough::Scene& in)
        : engine(used), tree(of), scene(in), n(of.size_bodies()), bodies(n),
          loads(n), motion{std::vector<Quat>(n, Quat(1, 0, 0, 0)), std::vector<Vec3>(n, Vec3::Zero())}, stage(motion) {
        for (Slope& s : k) s = {std::vector<Eigen::Vector4d>(n), std::vector<Vec3>(n)};
    }

    void step(double t, double h) {
        slope(motion, t, k[0]);
        advance(motion, k[0], h / 2, stage);
        slope(stage, t + h / 2, k[1]);
        advance(motion, k[1], h / 2, stage);
        slope(stage, t + h / 2, k[2]);
        advance(motion, k[2], h, stage);
        slope(stage, t + h, k[3]);
        for (std::size_t i = 0; i < n; ++i) {
            motion.turn[i].coeffs() += h / 6 * (k[0].turn[i] + 2 * k[1].turn[i] + 2 * k[2].turn[i] + k[3].turn[i]);
            motion.turn[i].normalize();
            motion.rate[i] += h / 6 * (k[0].rate[i] + 2 * k[1].rate[i] + 2 * k[2].rate[i] + k[3].rate[i]);
        }
    }

    std::vector<Vec3> points(const std::vector<std::size_t>& tips) {
        engine.move(motion, bodies);
        std::vector<Vec3> found;
        for (const std::size_t b : tips)
            found.push_back(bodies.joint[b] + bodies.R_wb[b] * Vec3(0, 0, tree.size[b].x()));
        return found;
    }

private:
    void slope(const Motion& at, double t, Slope& out) {
        engine.move(at, bodies);
        compute_loads(tree, scene, {}, t, at, bodies, loads);
        engine.accelerate(loads, out.rate);
        for (std::size_t i = 0; i < n; ++i) out.turn[i] = turn_rate(at.turn[i], at.rate[i]);
    }
    void advance(const Motion& from, const Slope& by, double h, Motion& to) const {
        for (std::size_t i = 0; i < n; ++i) {
            to.turn[i].coeffs() = from.turn[i].coeffs() + h * by.turn[i];
            to.rate[i] = from.rate[i] + h * by.rate[i];
        }
    }

    Engine& engine;
    const Tree& tree;
    const bough::Scene& scene;
    std::size_t n;
    Bodies bodies;
    Loads loads;
    Motion motion, stage;
    Slope k[4];
};

} // namespace

Track integrate(Engine& engine, const Tree& tree, const bough::Scene& scene, const std::vector<std::size_t>& tips,
                int frames, double fps, int steps) {
    Integrator integrator(engine, tree, scene);
    const double h = 1 / (fps * steps);
    Track track{integrator.points(tips)};
    for (int f = 0; f < frames; ++f) {
        for (int s = 0; s < steps; ++s) integrator.step((f * double(steps) + s) * h, h);
        track.push_back(integrator.points(tips));
    }
    return track;
}

double track_difference(const Track& a, const Track& b) {
    double worst = 0, squares = 0, count = 0;
    for (std::size_t f = 0; f < b.size(); ++f)
        for (std::size_t k = 0; k < b[f].size(); ++k) {
            const double off = (a[f][k] - b[f][k]).norm();
            if (!(off <= worst)) worst = off; // a NaN stays
            if (std::isnan(worst)) return worst;
            squares += (b[f][k] - b[0][k]).squaredNorm();
            count += 1;
        }
    return worst / std::sqrt(squares / count);
}

} // namespace yardstick
