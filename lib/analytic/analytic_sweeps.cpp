// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
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

} // namespace

template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads loads) {
    return sweeps_of<AnalyticSweep, T>(loads);
}

template AnalyticSweeps<float> analytic_sweeps(AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps(AnalyticLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
