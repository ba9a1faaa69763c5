#include "threads.h"
#ifdef _OPENMP
#include <omp.h>
#endif

namespace bough {

void use_threads(int threads) {
    set_thread_limit(threads);
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
}

} // namespace bough
