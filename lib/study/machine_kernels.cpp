// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "machine_kernels.h"
#include "../lanes/wide.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

constexpr int reals = int(64 / sizeof(float)); // a line
constexpr int parts = lanes<float> / width<float>;

double sum(const float* from, std::size_t n) {
    constexpr int lines = 8; // side by side: as many loads on their way
    WideFloat sums[lines * parts] = {};
    std::size_t i = 0;
    for (; i + lines * reals <= n; i += lines * reals)
        for (int k = 0; k < lines * parts; ++k) sums[k] += read(from + i + std::size_t(k * width<float>));
    double total = 0;
    for (const WideFloat& s : sums)
        for (int l = 0; l < width<float>; ++l) total += double(s[l]);
    for (; i < n; ++i) total += double(from[i]);
    return total;
}

// wide.h streams whole lines only; here the rest of a line follows at once.
void put_past_caches(float* at, WideFloat w) {
#if BOUGH_WIDTH == 32
    _mm256_stream_ps(at, __m256(w));
#elif BOUGH_WIDTH == 16 && defined(__SSE2__)
    _mm_stream_ps(at, __m128(w));
#else
    stream(at, w);
#endif
}

void end_of_stores() {
#ifdef __SSE2__
    _mm_sfence();
#endif
}

void fill(float* to, std::size_t n, float value) {
    const WideFloat w = all(value);
    for (std::size_t i = 0; i < n; i += std::size_t(width<float>)) put_past_caches(to + i, w);
    end_of_stores();
}

void copy(float* to, const float* from, std::size_t n) {
    for (std::size_t i = 0; i < n; i += std::size_t(width<float>)) put_past_caches(to + i, read(from + i));
    end_of_stores();
}

// A multiply-add takes 4 to 5 steps of the clock, and two can begin in each; 16 registers must hold them
constexpr int chains = 12;

template <class T> double multiply_add(T a, T b, std::uint64_t times) {
    Wide<T> x[chains];
    for (int k = 0; k < chains; ++k)
        for (int l = 0; l < width<T>; ++l) x[k][l] = T(k * width<T> + l);
    const Wide<T> factor = all(a), more = all(b);
    for (std::uint64_t i = 0; i < times; ++i)
        for (int k = 0; k < chains; ++k) x[k] = x[k] * factor + more;
    double total = 0;
    for (int k = 0; k < chains; ++k)
        for (int l = 0; l < width<T>; ++l) total += double(x[k][l]);
    return total;
}

} // namespace

MemoryKernels memory_kernels() {
    return {sum, fill, copy};
}
template <class T> ArithmeticKernel<T> arithmetic_kernel() {
    return {chains * width<T>, multiply_add<T>};
}
template ArithmeticKernel<float> arithmetic_kernel();
template ArithmeticKernel<double> arithmetic_kernel();

} // namespace BOUGH_TARGET
} // namespace bough::fast
