#include "attachment_plain.h"
#include "articulated_algebra.h"
#include "attachment_ties.h"

namespace bough {

template <class T, class S>
void tie_bodies(const Plan<T>& plan, CoupledWork<T>& work, std::vector<ResolventBody<S>>& body,
                std::complex<double> p) {
    Attachments& a = work.attachments;
    const auto wide = [](S z) { return std::complex<double>(z); };
    for (std::size_t k = 0; k < a.bodies.size(); ++k) {
        const ResolventBody<S>& q = body[a.bodies[k].body];
        SolvedBody& solved = a.solved[k];
        solved.E = q.E.unaryExpr(wide);
        solved.EA = solved.E * q.A.unaryExpr(wide);
        solved.EB = solved.E * q.B.unaryExpr(wide);
        solved.Eu = solved.E * q.u.unaryExpr(wide);
    }
    solve_ties(plan, work, p);
    for (std::size_t k = 0; k < a.bodies.size(); ++k)
        for (int axis = 0; axis < 3; ++axis) body[a.bodies[k].body].u[axis] -= field<S>(a.solved[k].moment[axis], T());
}

#define BOUGH_INSTANTIATE(T, S)                                                                                        \
    template void tie_bodies(const Plan<T>&, CoupledWork<T>&, std::vector<ResolventBody<S>>&, std::complex<double>);
BOUGH_INSTANTIATE(float, float)
BOUGH_INSTANTIATE(float, std::complex<float>)
BOUGH_INSTANTIATE(double, double)
BOUGH_INSTANTIATE(double, std::complex<double>)
#undef BOUGH_INSTANTIATE

} // namespace bough
