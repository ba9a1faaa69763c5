#include "rigid_error.h"
#include "../laws/added_motion.h"
#include "../model/drawn_pose.h"
#include "../simulation/any_run.h"
#include "trajectory.h"
#include <algorithm>
#include <limits>

namespace bough {

RigidComparison::RigidComparison(const Tree& whole) : tree_(whole), tips_(tip_bodies(whole)) {
    const DrawnPose drawn = drawn_pose(whole);
    const auto end = [&](std::size_t i) { return Vec3(drawn.x_w[i] + drawn.R_wb[i].col(2) * whole.size[i][0]); };
    for (const std::size_t i : tips_) drawn_.push_back(end(i));
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < whole.size_bodies(); ++i) {
        if (whole.parent[i] < 0) low = std::min(low, drawn.x_w[i].y());
        high = std::max({high, drawn.x_w[i].y(), end(i).y()});
    }
    found_.height = high - low;
    found_.tips = tips_.size();
    worst_.resize(tips_.size(), 0);
}

template <class T> void RigidComparison::tips_of(const State<T>& whole, std::vector<Vector3<float>>& to) const {
    to.resize(tips_.size());
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const std::size_t i = tips_[k];
        to[k] = (whole.x_w[i] + whole.R_wb[i].col(2) * T(tree_.size[i][0])).template cast<float>();
    }
}

template <class T>
void RigidComparison::tips_of(const Reduced& reduced, const Plan<T>& plan, const State<T>& state,
                              std::vector<Vector3<float>>& to) const {
    to.resize(tips_.size());
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const WholePose pose = whole_pose(reduced, plan, state, tips_[k]);
        to[k] = Vec3(pose.x + pose.R.col(2) * tree_.size[tips_[k]][0]).cast<float>();
    }
}

void RigidComparison::tips_of(Simulation& run, std::vector<Vector3<float>>& to) const {
    std::vector<Vec3> ends;
    run_of(run).shown_ends(tips_, ends);
    to.resize(ends.size());
    for (std::size_t k = 0; k < ends.size(); ++k) to[k] = ends[k].cast<float>();
}

double RigidComparison::compare(const std::vector<Vector3<float>>& whole, const std::vector<Vector3<float>>& reduced) {
    double worst = 0;
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const Vec3 is = whole[k].cast<double>();
        const double off = (is - reduced[k].cast<double>()).squaredNorm();
        squares_ += off;
        worst = std::max(worst, off);
        worst_[k] = std::max(worst_[k], off);
        deflection_squares_ += (is - drawn_[k]).squaredNorm();
    }
    ++found_.frames;
    worst = std::sqrt(worst);
    found_.worst = std::max(found_.worst, worst);
    return worst;
}

RigidError RigidComparison::result() const {
    RigidError result = found_;
    const double count = double(found_.frames) * double(found_.tips);
    if (count > 0) {
        result.rms = std::sqrt(squares_ / count);
        result.deflection = std::sqrt(deflection_squares_ / count);
    }
    return result;
}

template void RigidComparison::tips_of(const State<float>&, std::vector<Vector3<float>>&) const;
template void RigidComparison::tips_of(const State<double>&, std::vector<Vector3<float>>&) const;
template void RigidComparison::tips_of(const Reduced&, const Plan<float>&, const State<float>&,
                                       std::vector<Vector3<float>>&) const;
template void RigidComparison::tips_of(const Reduced&, const Plan<double>&, const State<double>&,
                                       std::vector<Vector3<float>>&) const;

} // namespace bough
