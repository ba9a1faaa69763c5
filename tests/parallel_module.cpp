// parallel_module.cpp: parallel.h in a library that parallel.cpp loads and unloads.
#include "lib/base/parallel.h"
#include <atomic>

extern "C" __attribute__((visibility("default"))) int run_loop(int threads) {
    const bough::ThreadLimit limit(threads);
    std::atomic<int> blocks{0};
    bough::parallel_blocks(60, 1e6, [&](std::size_t, int) { ++blocks; });
    return blocks;
}
