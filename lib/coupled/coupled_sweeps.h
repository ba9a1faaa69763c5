// coupled_sweeps.h: the coupled step (coupled_step.h) in three sweeps over a block's rows of lanes, fused from the plain step's stages. The first
// goes outward (midpoint and body_loads), the second inward (the resolvent's elimination), the third outward (its accelerations and the step's end).
//
// Chains run side by side in the lanes. Along a chain the parent's quantities stay in registers. Only where a chain begins on another's
// body do they pass through memory, by a record that is transposed in registers (wide.h, transpose). Terminal groups, most of a tree, go out and back
// before the next one does. Composites need every body of a subtree before the accelerations can start, so 216 bytes a body in float wait in memory
// between the inward and the second outward sweep. The blocks are then taken in reverse order, as the last ones are still in the cache. A block of
// whole trees goes on outward at once.
// What is absent is compiled out: a sweep exists with and without wind, and with and without gravity. For a wind that varies over the ground there is
// one sweep, with gravity, which may be 0. Each target's copy is compiled from one source, coupled_sweeps.cpp; coupled_targets.h chooses.
#pragma once
#include "coupled_rows.h"

namespace bough::fast {

template <class T> struct CoupledSweeps {
    // The first sweep outward, which also takes terminal groups inward at once. `scratch` holds loaded::count quantities for each row of the block.
    void (*outward)(const CoupledRows<T>&, const Block&, T* scratch, SweepFlags&);
    // The sweep inward of the rest. It adds to forks, which outward has set to zero, and to ports. It runs after outward, with the same scratch.
    void (*inward)(const CoupledRows<T>&, const Block&, const T* scratch);
    // The second sweep outward. It writes rows.next.
    void (*accelerate)(const CoupledRows<T>&, const Block&, SweepFlags&);
};

} // namespace bough::fast
