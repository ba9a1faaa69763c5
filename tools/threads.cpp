#include "threads.h"
#include <algorithm>
#include <thread>
#ifdef _OPENMP
#include <omp.h>
#endif

namespace bough {

void use_threads(int threads) {
#ifdef _OPENMP
    omp_set_num_threads(threads);
#else
    (void)threads; // most_threads is 1
#endif
}
int machine_threads() {
    return std::clamp(int(std::thread::hardware_concurrency()), 1, most_threads);
}

} // namespace bough
