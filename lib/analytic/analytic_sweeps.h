// analytic_sweeps.h: the analytic step (analytic/analytic_step.h) in two sweeps over a block's rows of lanes, fused from the plain step's stages:
// outward state_update and external_forces, inward composite, drag and spring.
//
// The order is reversed against analytic_step.cpp's: poses and velocities are worked out where they are read, at the start of the next step, and
// never written. As in coupled_sweeps.h chains run side by side in the lanes, and terminal groups go out and back before the next one
// does. A joint's own step (wide_spring.h) follows as soon as its composite is there. Two rows are stepped at a time, which keeps the units busy
// while each waits for its own eigenvalues. Joints wait for nothing further out than their blocks, so a step visits each block once and goes through
// memory once.
// What is absent is compiled out: a sweep exists with and without gravity, and with wind, with pulls alone and with neither. For a wind that varies
// over the ground there is one sweep, with gravity, which may be 0. Each target's copy is compiled from one source, analytic_sweeps.cpp;
// analytic_targets.h chooses.
#pragma once
#include "analytic_rows.h"

namespace bough::fast {

template <class T> struct AnalyticSweeps {
    // The sweep outward, which also takes terminal groups inward at once, with their joints' steps. `scratch` holds analytic::loaded::count
    // quantities for each row of the block.
    void (*outward)(const AnalyticRows<T>&, const Block&, T* scratch, SweepFlags&);
    // The sweep inward of the rest, with their joints' steps. It adds to forks, which outward has set to zero, and to ports. It runs after outward,
    // with the same scratch.
    void (*inward)(const AnalyticRows<T>&, const Block&, T* scratch, SweepFlags&);
};

} // namespace bough::fast
