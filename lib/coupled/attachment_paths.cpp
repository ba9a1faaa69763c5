#include "attachment_paths.h"
#include "attachment_ties.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {
namespace {

constexpr double far_turn = 0.1; // [rad] that a joint may be asked to turn by in a step

// What the joints of the path would turn by at most for the force beyond the last step's, each answering by its own spring and inertia alone, over
// far_turn; at most 1.
template <class T>
double straining(const Plan<T>& plan, const Attachments& a, const Attached& held, double per_metre, const Vec3& more) {
    Mat3 give = Mat3::Identity() / per_metre; // [m/N] of the point and of the attachment
    along_paths(a, held, [&](const AttachedBody& b, const Vec3& arm, const Vec3&) {
        give += (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose()) / answering_stiffness(plan, b);
    });
    const Vec3 force = give.inverse() * (more / per_metre);
    double most = 0;
    along_paths(a, held, [&](const AttachedBody& b, const Vec3& arm, const Vec3&) {
        most = std::max(most, arm.cross(force).norm() / answering_stiffness(plan, b));
    });
    return std::min(1.0, most / far_turn);
}

} // namespace

Mat3 direction_bound(const Vec3& P, const Vec3& f, double any) {
    const double arm = P.norm(), force = f.norm();
    if (!(arm > 0)) return Mat3::Zero();
    const Vec3 p = P / arm;
    const double n2 = force > 0 ? (p.cross(f) / force).squaredNorm() : 0;
    return arm * ((force + any) * Mat3::Identity() - (force * (1 - n2 / 2) + any / 2) * p * p.transpose());
}

template <class T> void find_bodies(const Plan<T>& plan, Attachments& a) {
    const auto ends = [&](const auto& visit) {
        each_end(a.all, visit);
        for (PulledPoint& point : a.pulled) visit(point);
    };
    find_path_joints(plan, ends, a.touched, a.bodies);
    find_ties(a);
}

template <class T> double answering_stiffness(const Plan<T>& plan, const AttachedBody& b) {
    const double h = plan.dt;
    const Vector3<T>& K = plan.K[b.body];
    const Matrix3<T>& J = plan.inertia_joint[b.body];
    return double(std::min(K[0], K[1])) * (1 + double(plan.beta[b.body]) / h) +
           double(std::min(J(0, 0), J(1, 1))) / (h * h);
}

template <class T>
PathAnswer path_answer(const Plan<T>& plan, const Attachments& a, const AttachedEnd& end, std::complex<double> s1) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PathAnswer least{infinity, infinity};
    along_path(a, end, [&](const AttachedBody& b, const Vec3& arm, const Vec3&) {
        const double arm2 = arm.squaredNorm();
        if (!(arm2 > 0)) return;
        const Vector3<T>& K = plan.K[b.body];
        const Matrix3<T>& J = plan.inertia_joint[b.body];
        const double z = std::abs(double(plan.beta[b.body]) * s1 + s1 * s1);
        for (int axis = 0; axis < 3; ++axis) {
            const double inertia = double(J(axis, axis) + T(z) * K[axis]);
            least = {std::min(least.mass, inertia / arm2), std::min(least.push, inertia / std::sqrt(arm2))};
        }
    });
    return least;
}

template <class T> void add_direction(const Plan<T>& plan, Attachments& a, const Attached& held) {
    const Vec3 start = held.far ? Vec3(held.start - held.far->start) : held.start,
               velocity = held.far ? Vec3(held.velocity - held.far->velocity) : held.velocity;
    const Vec3 now =
        held.k * ((held.from_target + held.to_target) / 2 - start) + held.c * (held.target_velocity - velocity);
    const double strain = straining(plan, a, held, held.k + held.c / plan.dt, Vec3(now - held.force)),
                 excess = std::max(0.0, strain * strain * now.norm() - held.force.norm());
    along_paths(a, held, [&](AttachedBody& b, const Vec3&, const Vec3& P) {
        const Mat3 H = direction_bound(P, held.force, excess);
        b.sums.A_stiffness += H;
        b.sums.N -= H * b.turn;
        b.sums.N_rate += H * b.own;
    });
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void find_bodies(const Plan<T>&, Attachments&);                                                           \
    template double answering_stiffness(const Plan<T>&, const AttachedBody&);                                          \
    template PathAnswer path_answer(const Plan<T>&, const Attachments&, const AttachedEnd&, std::complex<double>);     \
    template void add_direction(const Plan<T>&, Attachments&, const Attached&);
#include "../base/instantiate.inc"

} // namespace bough
