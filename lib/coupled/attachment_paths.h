// attachment_paths.h: how the joints between an attachment's ends and the ground answer it (attachment.h), each by its own spring and inertia alone.
#pragma once
#include "coupled_state.h"
#include <complex>

namespace bough {

// Finds the bodies of all paths. Called where what holds or pulls them has changed. Bodies that stay keep nothing, since a step fills them anew.
// O(paths). Allocates if there are more than before.
template <class T> void find_bodies(const Plan<T>&, Attachments&);

// Calls, for the joints between an end and the ground, from the end on: visit(body, from its joint to the end, from its joint to the next joint or
// the end).
template <class Of, class Visit> void along_path(Of& a, const AttachedEnd& end, Visit&& visit) {
    const Vec3 point = a.bodies[end.at].x + end.rho;
    Vec3 outward = point;
    for (auto k = std::int64_t(end.at); k >= 0; k = a.bodies[std::size_t(k)].parent) {
        auto& b = a.bodies[std::size_t(k)];
        visit(b, Vec3(point - b.x), Vec3(outward - b.x));
        outward = b.x;
    }
}
template <class Of, class Visit> void along_paths(Of& a, const Attached& held, Visit&& visit) {
    along_path(a, held, visit);
    if (held.far) along_path(a, *held.far, visit);
}

// [N m/rad] Returns how a joint resists a turn in one step about its softest axis: by its spring, its damping and its inertia.
template <class T> double answering_stiffness(const Plan<T>&, const AttachedBody&);

// How the path's joints answer at the point, with |s| of the scheme's slowest pole. Each value is the least of the joints'.
struct PathAnswer {
    double mass; // [kg] (J + |z| K) / l^2
    double push; // [kg m] (J + |z| K) / l: over |s|^2, the force that turns it by a radian
};
template <class T>
PathAnswer path_answer(const Plan<T>&, const Attachments&, const AttachedEnd&, std::complex<double> s1);

// [N m/rad] Returns a bound on (P.f) 1 - sym(P f^T), which attachment.h derives. `any` [N] is of unknown direction.
Mat3 direction_bound(const Vec3& P, const Vec3& f, double any);

// Adds H to every body of the paths, from their places at y*.
template <class T> void add_direction(const Plan<T>&, Attachments&, const Attached&);

} // namespace bough
