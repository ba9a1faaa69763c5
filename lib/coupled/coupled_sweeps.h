// coupled_sweeps.h: the coupled step (coupled_step.h) in three sweeps over a block's rows of lanes, fused from the plain step's
// stages: outward midpoint and body_loads, inward the resolvent's elimination, outward its accelerations and the step's end.
//
// Side by side in the lanes run chains of one level; along a chain the parent's quantities stay in registers, and only where a chain
// begins on another's body does anything pass through memory, by a record turned about in registers (wide.h, transpose).
// Terminal groups, most of a tree, go out and back before the next one does. Composites need every body of a subtree before the
// accelerations can start, so 216 bytes a body in float wait in memory between the inward and the second outward sweep; the blocks
// are taken in reverse order then, as the last ones are still in the cache. A block of whole trees goes on outward at once.
// What is absent is compiled out: a sweep exists with and without wind, with and without gravity; for a wind that varies over the ground
// there is one, with gravity, which may be 0.
// Each target's copy is compiled from one source, coupled_sweeps.cpp; targets.h chooses.
#pragma once
#include "coupled_rows.h"

namespace bough::fast {

template <class T> struct CoupledSweeps {
    // First sweep outward, and for terminal groups at once inward: `scratch` holds loaded::count quantities for each row of the block.
    void (*outward)(const CoupledRows<T>&, const Block&, T* scratch, SweepFlags&);
    // The rest inward. Adds to forks, which outward has set to zero, and to ports. Needs outward before, with the same scratch.
    void (*inward)(const CoupledRows<T>&, const Block&, const T* scratch);
    // Second sweep outward; writes rows.next.
    void (*accelerate)(const CoupledRows<T>&, const Block&, SweepFlags&);
};

} // namespace bough::fast
