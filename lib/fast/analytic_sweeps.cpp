// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "analytic_joints.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

using namespace analytic_step;

template <class T, bool wind, bool pulls, bool gravity>
struct AnalyticSweep : AnalyticJoints<T, wind, pulls, gravity, AnalyticSweep<T, wind, pulls, gravity>> {
    using Base = AnalyticJoints<T, wind, pulls, gravity, AnalyticSweep>;
    using Base::Base;
    using Base::flags;
    using Base::forces;
    using Base::L;
    using Base::rows;
    using typename Base::W;
    using Work = Pair<W>; // two registers at a time

    static constexpr bool frozen = false;
    static constexpr int motion_count = motion::count;

    Place waiting[2]; // joints whose composites are there
    int waiters = 0;

    BOUGH_FORCE V3<W> joint_rate(std::uint32_t row, int lane, const V3<W>& theta, const Turn<W>& turn) const {
        const V3<W> eta = Rows<const T>{this->motion_at(row, lane)}.vector(motion::theta_dot),
                    across = cross(theta, eta);
        return eta - turn.c1 * across + turn.c2 * cross(theta, across);
    }

    BOUGH_FORCE void joint_loaded(std::uint32_t row, int lane, const Seen<W>&) {
        waiting[waiters++] = {row, lane};
        if (waiters < 2) return;
        step_joints<Work>(); // while both are at hand
        waiters = 0;
    }
    void joints_done() {
        if (waiters > 0) step_joints<W>();
        waiters = 0;
        this->see_finite();
    }

    template <class X> [[gnu::noinline]] void step_joints() {
        const auto a = this->template at<X>(waiting);
        JointLoad<X> in = this->load(a);
        in.J = a.loaded.symmetric(loaded::J);
        if constexpr (gravity) in.gravity_row = a.constants.real(constant::gravity_row);
        if constexpr (wind) {
            in.wind_row = a.loaded.real(loaded::wind);
            in.turn_row = a.loaded.real(loaded::turn);
        }
        in.beta = a.constants.real(constant::beta);
        in.bend = a.constants.real(constant::bend);
        in.twist = a.constants.real(constant::twist);
        JointLambdas<X> o;
        JointStep<X> step = step_joint<wind, gravity, forces>(in, rows.h, largest_lambda<T>(), o);

        const X softest = -larger(larger(-o.lambda[0], -o.lambda[1]), -o.lambda[2]);
        if (any_above(X{}, softest) || o.bounded)
            for (int m = 0; m < 3; ++m)
                for (int j = 0; j < Registers<X>::count; ++j) {
                    const W mass = read<T>(a.constants.at[j] + constant::mass * L);
                    this->count(-Registers<X>::part(o.lambda[m], j), 0, mass, flags.buckling);
                    this->count(Registers<X>::part(o.with_air[m], j), largest_lambda<T>(), mass, flags.bounded_lambda);
                }
        this->finish(a, in, step);
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
