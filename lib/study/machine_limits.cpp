#include "machine_limits.h"
#include "../base/caches.h"
#include "../lanes/row.h"
#include "machine_kernels.h"
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <unistd.h>

namespace bough {
namespace {

using Time = std::chrono::steady_clock;

// [s] of `work(thread)` by all threads at once.
double timed(int threads, const std::function<void(int)>& work) {
    const Time::time_point start = Time::now();
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int t = 0; t < threads; ++t) work(t);
    return std::chrono::duration<double>(Time::now() - start).count();
}

struct OwnRows {
    std::size_t first, count; // floats
};
// Even shares of whole rows.
OwnRows own_rows(std::size_t rows, int threads, int thread) {
    constexpr std::size_t row = fast::Row<float>::lanes;
    const std::size_t n = std::size_t(threads), t = std::size_t(thread);
    const std::size_t first = rows * t / n, end = rows * (t + 1) / n;
    return {first * row, (end - first) * row};
}

// As exact as sums in float are, piece by piece (machine_kernels.h).
double sum(const fast::MemoryKernels& kernels, const float* from, std::size_t n) {
    constexpr std::size_t piece = std::size_t(1) << 28;
    double total = 0;
    for (std::size_t i = 0; i < n; i += piece) total += kernels.sum(from + i, std::min(piece, n - i));
    return total;
}

void measure_memory(MachineLimits& limits, const fast::MemoryKernels& kernels, int threads, std::size_t array) {
    const std::size_t rows = std::max(array / 64, std::size_t(threads) * 2), half = rows / 2;
    const std::unique_ptr<void, void (*)(void*)> memory(fast::allocate_rows(rows * 64), fast::free_rows);
    auto* const values = static_cast<float*>(memory.get());
    const auto mine = [&](int t) { return own_rows(rows, threads, t); };
    const auto put = [&](float value) {
        return timed(threads, [&](int t) { kernels.fill(values + mine(t).first, mine(t).count, value); });
    };
    put(0); // the first touch
    const double written = put(1);
    std::vector<double> sums(std::size_t(threads), 0);
    const double read =
        timed(threads, [&](int t) { sums[std::size_t(t)] = sum(kernels, values + mine(t).first, mine(t).count); });
    double total = 0;
    for (const double s : sums) total += s;
    if (total != double(rows * fast::Row<float>::lanes))
        throw std::logic_error("memory was read other than it was written");
    const double copied = timed(threads, [&](int t) {
        const OwnRows p = own_rows(half, threads, t);
        kernels.copy(values + half * fast::Row<float>::lanes + p.first, values + p.first, p.count);
    });
    limits.read = double(rows * 64) / read;
    limits.write = double(rows * 64) / written;
    limits.copy = 2 * double(half * 64) / copied;
}

template <class T> double measure_peak(fast::Target target, int threads) {
    const fast::ArithmeticKernel<T> kernel = fast::arithmetic_kernel_for<T>(target);
    std::vector<double> results(std::size_t(threads), 0);
    for (std::uint64_t times = 1 << 16;; times *= 4) {
        const double seconds =
            timed(threads, [&](int t) { results[std::size_t(t)] = kernel.multiply_add(T(0.5), T(1), times); });
        // All numbers have come to 2 by now: the loop was really run.
        if (!(results[0] == 2.0 * kernel.reals)) throw std::logic_error("multiply-adds gave another number");
        if (seconds > 0.02) return 2.0 * double(times) * kernel.reals * threads / seconds;
    }
}

} // namespace

MachineLimits measure_limits(fast::Target target, int threads, std::size_t array) {
    MachineLimits limits;
    measure_memory(limits, fast::memory_kernels_for(target), threads, array);
    limits.peak_float = measure_peak<float>(target, threads);
    limits.peak_double = measure_peak<double>(target, threads);
    return limits;
}

std::size_t default_array() {
    const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
    const std::size_t memory = pages > 0 && page > 0 ? std::size_t(pages) * std::size_t(page) : 0;
    const std::size_t wanted = std::max(4 * last_cache(), std::size_t(256) << 20);
    return memory == 0 ? wanted : std::min(wanted, memory / 4);
}

} // namespace bough
