// analytic_sweeps.h: the analytic step (analytic/analytic_step.h) in two sweeps over a block's rows of lanes, fused from the plain step's stages:
// outward state_update and external_forces, inward composite, drag and spring.
//
// The order is turned round against step.cpp's: poses and velocities are worked out where they are read, at the start of the next
// step, and never written. As in coupled_sweeps.h chains of one level run side by side in the lanes, and terminal groups go out and
// back before the next one does. A joint's own step (wide_spring.h) follows as soon as its composite is there, two rows at a time,
// which keep the units busy while each waits for its own eigenvalues. Joints wait for nothing further out than their blocks: one
// visit to each block, and memory is gone through once a step.
// What is absent is compiled out: a sweep exists with and without gravity, with wind, with pulls alone and with neither; for a wind that varies
// over the ground there is one, with gravity, which may be 0.
// Each target's copy is compiled from one source, analytic_sweeps.cpp; targets.h chooses.
#pragma once
#include "analytic_rows.h"

namespace bough::fast {

template <class T> struct AnalyticSweeps {
    // Outward, and for terminal groups at once inward, with their joints' steps: `scratch` holds analytic::loaded::count quantities
    // for each row of the block.
    void (*outward)(const AnalyticRows<T>&, const Block&, T* scratch, SweepFlags&);
    // The rest inward, with their joints' steps. Adds to forks, which outward has set to zero, and to ports. Needs outward before,
    // with the same scratch.
    void (*inward)(const AnalyticRows<T>&, const Block&, T* scratch, SweepFlags&);
};

} // namespace bough::fast
