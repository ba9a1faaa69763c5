// attachment_course.h: what is the same about attachments (Attachment, scene.h) with any solver: which there are, when they hold, and the way their
// targets go.
#pragma once
#include "attached.h"

namespace bough {

// Returns the plan's attachments, in its order, with their targets zero.
template <class T> std::vector<Attached> planned_attachments(const Plan<T>&);
// Returns the target of one of them at the run's start, from where its points [m] then are.
template <class T> Vec3 target_at_start(const Plan<T>&, const Attached&, const Vec3& near, const Vec3& far);

// True if it holds in a step whose middle is at this time [s].
inline bool holds(const Attached& held, double middle) {
    return held.from <= middle && middle < held.to;
}
// Finds the target's way over the step from `time`: from_target, to_target, target_velocity, quicker. They are as seen from the tree's ground, and
// for a pair from its far end: less by what a moving ground would carry the points along. Needs AttachedEnd::start.
template <class T> void lead(const Plan<T>&, Attached&, double time);
// True if in the step from `time`, or in the one before, its target is moved, or it is let go or taken up.
template <class T> bool changes(const Plan<T>&, const Attached&, double time);

// Returns what a saved state carries: six numbers for each of the plan's attachments that is still there.
std::vector<double> saved_attachments(const std::vector<Attached>&);
// Restores them. Throws std::length_error for another count of numbers.
void restore_attachments(std::vector<Attached>&, const std::vector<double>&);

} // namespace bough
