// operations.h: how many operations a step in lanes computes, counted by running it. Its kernels are compiled once more for a target whose registers
// hold one number that counts what is done to it (wide_counted.h). Pads are counted as bodies are, since a machine's registers compute them too. What
// a branch leaves out for a lane is not counted, though a register pays for all its lanes where one needs it. The count is a lower bound there (the
// analytic step's eigenvectors and oscillators, fast turns).
//
// One operation is one addition, subtraction, multiplication, division or square root of reals. A fused multiply-add is two.
// These are not counted: comparisons, changes of sign, moves, whole numbers, and what few bodies need one by one (half turns, pulls).
#pragma once
#include "target.h"
#include <cstdint>

namespace bough::fast {

struct Operations {
    std::uint64_t additions = 0, multiplications = 0, divisions = 0, roots = 0; // subtractions are additions
    std::uint64_t total() const { return additions + multiplications + divisions + roots; }
};

// The operations of the counted target's code in this thread, since it began or was set back. To count a whole step, run it in one thread. (The
// attribute lets it be found without a call, as every operation goes through it.)
extern constinit thread_local Operations operations_of_thread [[gnu::tls_model("initial-exec")]];
inline Operations& counted_operations() {
    return operations_of_thread;
}

} // namespace bough::fast
