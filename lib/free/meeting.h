// meeting.h: free bodies through one step: their flight, all that they meet on the way, the contacts' impulses, and where they are after it.
// Reads the tree's poses before and after the step (World::before, poses); writes the bodies' motions, the loads that the trees bear in the
// next step (State::loads), counts and events. Flight on all threads, contacts one after the other: no result depends on threads.
#pragma once
#include "world.h"

namespace bough {

// A free body on its way through the step.
struct Way {
    FreeMotion start, next;       // next: if nothing is met
    double first = 1;             // part of the step at which it meets something
    std::size_t from = 0, to = 0; // its contacts
};

// Where each would be if it met nothing. One way a free body.
template <class T> void fly_all(const Plan<T>&, World<T>&, std::vector<Way>&);

// Contacts, impulses, and where all are after the step. Returns the contacts with their impulses.
template <class T> std::vector<ContactPoint> meet_and_go(const Plan<T>&, State<T>&, World<T>&, std::vector<Way>&);

// Leaves that reach the ground lie down on it.
template <class T> void come_to_ground(const Plan<T>&, World<T>&);

} // namespace bough
