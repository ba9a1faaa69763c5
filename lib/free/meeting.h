// meeting.h: free bodies through one step: their flight, all that they meet on the way, the contacts' impulses, and where they are after it. Reads
// the tree's poses before and after the step (World::before, poses). Writes the bodies' motions, the loads that the trees bear in the next step
// (State::loads), counts and events. The flight runs on all threads and contacts are solved one after the other, so no result depends on threads.
#pragma once
#include "world.h"

namespace bough {

// A free body on its way through the step.
struct Way {
    FreeMotion start, next;       // next: if nothing is met
    double first = 1;             // part of the step at which it meets something
    std::size_t from = 0, to = 0; // its contacts
};

// Finds where each body would be if it met nothing. Returns one way a free body.
template <class T> void fly_all(const Plan<T>&, World<T>&, std::vector<Way>&);

// Finds contacts and impulses, and where all bodies are after the step. Returns the contacts with their impulses.
template <class T> std::vector<ContactPoint> meet_and_go(const Plan<T>&, State<T>&, World<T>&, std::vector<Way>&);

// Lays down leaves that reach the ground.
template <class T> void come_to_ground(const Plan<T>&, World<T>&);

} // namespace bough
