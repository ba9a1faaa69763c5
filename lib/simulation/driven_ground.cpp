#include "driven_ground.h"
#include "../base/nearest_vector.h"
#include "../base/rotation_maps.h"
#include <algorithm>

namespace bough {
namespace {

// At x with velocity v now; before and after likewise.
void pass(QuinticSpline& c, double now, const Vec3& x, const Vec3& v) {
    const Vec3 none = Vec3::Zero();
    c.time = {now - 1, now, now + 1};
    c.x = {x - v, x, x + v};
    c.v = {v, v, v};
    c.a = {none, none, none};
}

// From there now to x with velocity v, h seconds later, and on.
void lead(QuinticSpline& c, double now, double h, const CurvePoint& from, const Vec3& x, const Vec3& v) {
    c.time = {now, now + h, now + 2 * h};
    c.x = {from.x, x, x + h * v};
    c.v = {from.v, v, v};
    c.a = {from.a, (2 * from.v + 4 * v) / h - 6 / (h * h) * (x - from.x), Vec3::Zero()};
}

// How the pivot is displaced.
struct Pivot {
    Vec3 x, v; // [m], [m/s]
};
Pivot pivot_of(const RootSpline& spline, const Ground& ground) {
    const Vec3 arm = ground.R * spline.pivot;
    return {ground.x + arm - spline.pivot, ground.v + ground.omega.cross(arm)};
}

} // namespace

void move_all_trees(Scene& scene, std::size_t trees) {
    for (std::size_t k = 0; k < trees; ++k) {
        const auto moves = [k](const RootMotion& motion) { return std::size_t(motion.tree) == k; };
        if (std::any_of(scene.root_motion.begin(), scene.root_motion.end(), moves)) continue;
        RootMotion still;
        still.tree = std::int32_t(k);
        still.time = {0, 1};
        still.position.assign(2, Vec3::Zero());
        still.rotation.assign(2, Quat::Identity());
        scene.root_motion.push_back(std::move(still));
    }
}

Ground ground_of(const RootSpline& spline, const GroundMotion& motion) {
    Ground ground;
    ground.R = motion.rotation.normalized().toRotationMatrix();
    const Vec3 arm = ground.R * spline.pivot;
    ground.omega = motion.angular_velocity;
    ground.x = motion.position + spline.pivot - arm;
    ground.v = motion.velocity - ground.omega.cross(arm);
    return ground;
}

GroundMotion motion_of(const RootSpline& spline, const Ground& ground) {
    const Pivot pivot = pivot_of(spline, ground);
    return {pivot.x, Quat(ground.R), pivot.v, ground.omega};
}

void make_driven(RootSpline& spline) {
    spline.position.emplace();
    spline.rotation.emplace();
    put_ground(spline, 0, {});
}

void put_ground(RootSpline& spline, double now, const Ground& at) {
    const Pivot pivot = pivot_of(spline, at);
    spline.first = at.R;
    pass(*spline.position, now, pivot.x, pivot.v);
    pass(*spline.rotation, now, Vec3::Zero(), at.omega);
}

void lead_ground(RootSpline& spline, double now, double seconds, const Ground& to) {
    const Ground from = ground_at(spline, now);
    const Pivot pivot = pivot_of(spline, to);
    const Quat turn(Mat3(to.R * from.R.transpose()));
    const Vec3 phi = nearest_vector(turn.normalized(), seconds / 2 * (from.omega + to.omega));
    lead(*spline.position, now, seconds, curve_at(*spline.position, now), pivot.x, pivot.v);
    spline.first = from.R;
    lead(*spline.rotation, now, seconds, {Vec3::Zero(), from.omega, from.alpha}, phi,
         rotation_maps<double>(phi).J_inverse * to.omega);
}

void keep_going(RootSpline& spline, double now, double seconds) {
    if (now < spline.position->time[1]) return;
    Ground to = ground_at(spline, now);
    const Pivot pivot = pivot_of(spline, to);
    to.R = rotation_from_vector<double>(seconds * to.omega) * to.R;
    const Vec3 arm = to.R * spline.pivot;
    to.x = pivot.x + seconds * pivot.v + spline.pivot - arm;
    to.v = pivot.v - to.omega.cross(arm);
    lead_ground(spline, now, seconds, to);
}

} // namespace bough
