// threads.h: how many threads a tool works with.
#pragma once
#include "lib/base/parallel.h"

namespace bough {

void use_threads(int); // from now on, in loops of the calling thread: a step's (parallel.h) and OpenMP's

} // namespace bough
