// threads.h: how many threads a tool works with.
#pragma once
#include "lib/base/parallel.h"

namespace bough {

void use_threads(int); // from now on, in loops of the calling thread: of parallel.h, and of OpenMP, which Eigen has

} // namespace bough
