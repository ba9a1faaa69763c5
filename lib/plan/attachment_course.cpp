#include "attachment_course.h"
#include <stdexcept>
#include <string>

namespace bough {
namespace {

// The grounds of a step's start and end under a body, where it is moved.
struct Grounds {
    Ground start, end;
    bool moved = false;
};
template <class T> Grounds grounds_of(const Plan<T>& plan, std::size_t body, double time) {
    Grounds g;
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, body) : -1;
    if (spline < 0) return g;
    g.moved = true;
    g.start = ground_at(plan.splines[std::size_t(spline)], time);
    g.end = ground_at(plan.splines[std::size_t(spline)], time + plan.dt);
    return g;
}

// Where the target is at t; its velocity.
template <class T> CurvePoint target_at(const Plan<T>& plan, const Attached& held, double t) {
    if (held.planned >= 0)
        if (const std::optional<QuinticSpline>& course = plan.attachments[std::size_t(held.planned)].course)
            return curve_at(*course, t);
    return {held.target, Vec3::Zero(), Vec3::Zero()};
}

// What the ground alone does with a point in the step: `of` -1 is taken off the target's way, 1 goes on it.
template <class T> void go_along(const Plan<T>& plan, const AttachedEnd& end, double time, double of, Attached& held) {
    const Grounds grounds = grounds_of(plan, end.body, time);
    if (!grounds.moved) return;
    const Vec3 X = grounds.start.R.transpose() * (end.start - grounds.start.x);
    held.to_target += of * (grounds.end.x + grounds.end.R * X - end.start);
    held.quicker += of * (grounds.end.v + grounds.end.omega.cross(Vec3(grounds.end.R * X)) - grounds.start.v -
                          grounds.start.omega.cross(Vec3(grounds.start.R * X)));
}

} // namespace

template <class T> std::vector<Attached> planned_attachments(const Plan<T>& plan) {
    std::vector<Attached> all;
    all.reserve(plan.attachments.size());
    for (const PlannedAttachment& planned : plan.attachments) {
        const Attachment& of = plan.scene.attachments[planned.source];
        Attached held{};
        held.planned = &planned - plan.attachments.data();
        held.body = planned.body;
        held.point_b = planned.point_b;
        if (planned.far) held.far = AttachedEnd{planned.far->body, 0, planned.far->point_b};
        held.stiffness = of.stiffness;
        held.damping = of.damping;
        held.from = of.from;
        held.to = of.to;
        all.push_back(held);
    }
    return all;
}

template <class T> Vec3 target_at_start(const Plan<T>& plan, const Attached& held, const Vec3& near, const Vec3& far) {
    const Attachment& of = plan.scene.attachments[plan.attachments[std::size_t(held.planned)].source];
    return of.target.value_or(held.far ? Vec3(near - far) : near);
}

template <class T> void lead(const Plan<T>& plan, Attached& held, double time) {
    const CurvePoint start = target_at(plan, held, time), end = target_at(plan, held, time + plan.dt);
    held.from_target = start.x;
    held.to_target = end.x;
    held.quicker = end.v - start.v;
    if (held.steps > 0) held.to_target += (held.goal - held.target) / held.steps;
    go_along(plan, held, time, -1, held);
    if (held.far) go_along(plan, *held.far, time, 1, held);
    held.target_velocity = (held.to_target - held.from_target) / plan.dt;
}

template <class T> bool changes(const Plan<T>& plan, const Attached& held, double time) {
    if (held.steps > 0) return true;
    const double h = plan.dt;
    if (holds(held, time + h / 2) != holds(held, time - h / 2)) return true;
    const Vec3 now = target_at(plan, held, time).x;
    return target_at(plan, held, time - h).x != now || target_at(plan, held, time + h).x != now;
}

std::vector<double> saved_attachments(const std::vector<Attached>& all) {
    std::vector<double> saved;
    for (const Attached& held : all)
        if (held.planned >= 0)
            for (const Vec3* v : {&held.force, &held.spring})
                for (int k = 0; k < 3; ++k) saved.push_back((*v)[k]);
    return saved;
}

void restore_attachments(std::vector<Attached>& all, const std::vector<double>& saved) {
    std::size_t next = 0, needed = 0;
    for (const Attached& held : all) needed += held.planned >= 0 ? 6 : 0;
    if (saved.size() != needed)
        throw std::length_error("has " + std::to_string(saved.size()) + " numbers, this run needs " +
                                std::to_string(needed));
    for (Attached& held : all)
        if (held.planned >= 0)
            for (Vec3* v : {&held.force, &held.spring})
                for (int k = 0; k < 3; ++k) (*v)[k] = saved[next++];
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::vector<Attached> planned_attachments(const Plan<T>&);                                                \
    template Vec3 target_at_start(const Plan<T>&, const Attached&, const Vec3&, const Vec3&);                          \
    template void lead(const Plan<T>&, Attached&, double);                                                             \
    template bool changes(const Plan<T>&, const Attached&, double);
#include "../base/instantiate.inc"

} // namespace bough
