// attachment_course.h: of attachments (Attachment, scene.h), what is the same whichever solver holds them: which there are, when they hold, and the way
// their targets go.
#pragma once
#include "../plan/plan.h"
#include "attachment_state.h"

namespace bough {

// The plan's, in its order, their targets zero.
template <class T> std::vector<Attached> planned_attachments(const Plan<T>&);
// Of one of them: its target at the run's start, from where its points [m] then are.
template <class T> Vec3 target_at_start(const Plan<T>&, const Attached&, const Vec3& near, const Vec3& far);

// Does it, in a step whose middle is at this time [s]?
inline bool holds(const Attached& held, double middle) {
    return held.from <= middle && middle < held.to;
}
// The way of the target over the step from `time`: from_target, to_target, target_velocity, quicker. As seen from the tree's ground, and of a pair
// from its far end: less by what a moving ground would carry the points along. Needs AttachedEnd::start.
template <class T> void lead(const Plan<T>&, Attached&, double time);
// In the step from `time`, or in the one before, is its target moved, or is it let go or taken up?
template <class T> bool changes(const Plan<T>&, const Attached&, double time);

// What a saved state carries: six numbers for each of the plan's that is still there.
std::vector<double> saved_attachments(const std::vector<Attached>&);
// Throws std::length_error where there are not so many.
void restore_attachments(std::vector<Attached>&, const std::vector<double>&);

} // namespace bough
