// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "analytic_sweeps.h"
#include "analytic_joints.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

using namespace analytic_step;

template <class T, bool wind, bool pulls, bool gravity, bool field>
struct AnalyticSweep : AnalyticJoints<T, wind, pulls, gravity, field, AnalyticSweep<T, wind, pulls, gravity, field>> {
    using Base = AnalyticJoints<T, wind, pulls, gravity, field, AnalyticSweep>;
    using Base::Base;
    using typename Base::W;

    BOUGH_FORCE V3<W> joint_rate(std::uint32_t row, int lane, const V3<W>& theta, const Turn<W>& turn) const {
        return this->kept_rate(row, lane, theta, turn);
    }

    BOUGH_FORCE void joint_loaded(std::uint32_t row, int lane) { this->step_next(row, lane); }
    void joints_done() {
        this->step_last();
        this->see_finite();
    }
};

// A sweep's code for what the scene loads its bodies with.
template <class T, bool wind, bool pulls, bool gravity, bool field = false> AnalyticSweeps<T> sweeps_with() {
    return {[](const AnalyticRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
                const FlushToZero flush;
                AnalyticSweep<T, wind, pulls, gravity, field>(rows, block, scratch, flags).out();
            },
            [](const AnalyticRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
                const FlushToZero flush;
                AnalyticSweep<T, wind, pulls, gravity, field>(rows, block, scratch, flags).in();
            }};
}

} // namespace

template <class T> AnalyticSweeps<T> analytic_sweeps(SweepLoads loads) {
    if (loads.field) return sweeps_with<T, true, false, true, true>();
    if (loads.wind) // it has forces, and so room for pulls
        return loads.gravity ? sweeps_with<T, true, false, true>() : sweeps_with<T, true, false, false>();
    if (loads.pulls) return loads.gravity ? sweeps_with<T, false, true, true>() : sweeps_with<T, false, true, false>();
    return loads.gravity ? sweeps_with<T, false, false, true>() : sweeps_with<T, false, false, false>();
}

template AnalyticSweeps<float> analytic_sweeps(SweepLoads);
template AnalyticSweeps<double> analytic_sweeps(SweepLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
