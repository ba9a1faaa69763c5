// coupled_support.h: a tree, a scene and the coupled step, and runs held against the articulated reference.
#pragma once
#include "lib/reference/advance.h"
#include "lib/reference/trajectory.h"
#include "lib/stages/energy.h"
#include "tests/solver_support.h"

namespace coupled {

using namespace bough;

constexpr std::array<Scheme, 5> extrapolating{Scheme::p12, Scheme::p25, Scheme::p50, Scheme::p34, Scheme::midpoint};

template <class T = double> struct Run {
    Plan<T> plan;
    State<T> state;
    Run(const Tree& tree, const Scene& scene, Scheme scheme = Scheme::p12, double dt = 1.0 / 30)
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, dt, Solver::coupled, scheme)),
          state(make_state(plan)) {}
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state);
    }
    double total_energy() const {
        const Energy e = energy(plan, state);
        return e.bodies + e.elastic + e.potential;
    }
};

// Root mean square of the tips' distance between two runs over tips and frames, over that of the second's tips from its start.
inline double track_error(const Trajectory& run, const Trajectory& truth) {
    if (!run.finite || run.tip.size() != truth.tip.size()) return INFINITY;
    double off = 0, way = 0;
    for (std::size_t f = 0; f < truth.tip.size(); ++f)
        for (std::size_t k = 0; k < truth.tip[f].size(); ++k) {
            off += (run.tip[f][k] - truth.tip[f][k]).squaredNorm();
            way += (truth.tip[f][k] - truth.tip[0][k]).squaredNorm();
        }
    return std::sqrt(off / way);
}

inline Trajectory truth_of(const Problem& problem, double tolerance = 1e-9) {
    Variant reference{Solver::articulated_reference};
    reference.tolerance = tolerance;
    return run_trajectory(problem, reference, false, 1, [] {});
}

inline Trajectory run_of(const Problem& problem, Scheme scheme, double steps_per_frame) {
    Variant variant{Solver::coupled};
    variant.scheme = scheme;
    variant.steps_per_frame = steps_per_frame;
    return run_trajectory(problem, variant, false, 1, [] {});
}

// Errors at `steps` steps a frame.
inline std::vector<double> errors_of(const Problem& problem, const Trajectory& truth, Scheme scheme,
                                     const std::vector<double>& steps) {
    std::vector<double> errors;
    for (const double n : steps) errors.push_back(track_error(run_of(problem, scheme, n), truth));
    return errors;
}

// The order that errors at steps h, h/2, h/4 ... show: the last two's.
inline double last_order(const std::vector<double>& errors) {
    return std::log2(errors[errors.size() - 2] / errors.back());
}

} // namespace coupled
