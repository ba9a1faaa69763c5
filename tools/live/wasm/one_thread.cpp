// one_thread.cpp: lib/base/parallel.h where there is one thread, as in a page: the caller does all blocks itself, in their order.
#include "lib/base/parallel.h"

namespace bough {

int machine_threads() {
    return 1;
}
int thread_limit() {
    return 1;
}
void set_thread_limit(int) {}
int threads_for(std::size_t, double) {
    return 1;
}

namespace parallel {
void run(std::size_t blocks, int, double, Work work, const void* what) {
    for (std::size_t block = 0; block < blocks; ++block) work(what, block, 0);
}
std::size_t pieces(std::size_t count, double) {
    return count > 0 ? 1 : 0;
}
} // namespace parallel

} // namespace bough
