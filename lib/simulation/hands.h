// hands.h: what a program holds by hand in a run (Simulation::attach): attachments that no scene names. Private to simulation.
#pragma once
#include "../plan/attached.h"
#include "run.h"

namespace bough {

template <class T> bool has_broken_off(const Run<T>&, std::size_t body);

// All of these are for a run of the coupled solver. Each wakes what its stepper has to. O(bodies).

// Attaches at a point [m, body frame] of a body of the whole trees; the target is where the point is. Returns the attachment's number. Throws
// SceneError for a body that stands still or has broken off, and where the run keeps no poses.
template <class T>
std::uint64_t attach_hand(Run<T>&, const Assembly&, std::size_t body, const Vec3& point, double stiffness,
                          double damping);
// Returns the attachments that are still there; none in a run of another solver.
template <class T> std::vector<Attached> hands_of(const Run<T>&);
// Takes over an attachment of another run, on a body of this one.
template <class T> void adopt_hand(Run<T>&, const Attached&, std::size_t body);
template <class T> void release_hand(Run<T>&, std::uint64_t number); // of one that is there

} // namespace bough
