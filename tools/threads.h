// threads.h: how many threads a tool works with.
#pragma once

namespace bough {

// --threads takes up to this many; 1 where built without OpenMP.
#ifdef _OPENMP
constexpr int most_threads = 4096;
#else
constexpr int most_threads = 1;
#endif
int machine_threads();
void use_threads(int); // from now on, in parallel loops of the calling thread

} // namespace bough
