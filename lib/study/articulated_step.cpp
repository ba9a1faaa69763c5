#include "articulated_step.h"

namespace bough {

void explicit_euler(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    articulated_pass(plan, pass, time, 0);
    for (ArticulatedBody& b : pass.body) {
        b.theta += h * (body_rate_jacobian_inverse(b.theta) * b.rate);
        b.rate += h * b.rate_dot;
    }
}

void implicit_euler(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    articulated_pass(plan, pass, time, h);
    for (ArticulatedBody& b : pass.body) {
        b.rate += h * b.rate_dot;
        b.theta += h * (body_rate_jacobian_inverse(b.theta) * b.rate);
    }
}

} // namespace bough
