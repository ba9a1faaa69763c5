#include "root_term.h"
#include "../laws/ground_course.h"

namespace bough {

template <class T> void root_loads(const Plan<T>& plan, AnalyticWork<T>& work, double time) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) {
        const GroundCourse course = ground_course(plan.splines[k], time, plan.dt);
        const Mat3 back =
            course.turned.isZero(0) ? Mat3(Mat3::Identity()) : rotation_from_vector<double>(-course.turned / 2);
        RootLoad<T>& load = work.root_load[k];
        load.x = (course.start.x + course.start.R * plan.splines[k].pivot).template cast<T>();
        load.g = (back * (plan.scene.gravity - course.a)).template cast<T>();
        load.omega = (back * ((course.start.omega + course.end.omega) / 2)).template cast<T>();
        load.alpha = (back * course.alpha).template cast<T>();
    }
}

#define BOUGH_INSTANTIATE(T) template void root_loads(const Plan<T>&, AnalyticWork<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
