// machine_kernels.h: loops that do nothing but what a machine is limited by, in the code of one SIMD target: memory read, written, copied,
// and multiply-adds. What a step costs is held against them (treeprofile scaling).
//
// Arrays of whole rows, aligned to 64 bytes. Written past the caches where the architecture can (x86), so that a byte written is a byte moved.
#pragma once
#include <cstddef>
#include <cstdint>

namespace bough::fast {

enum class Target : std::uint8_t;

struct MemoryKernels {
    double (*sum)(const float* from,
                  std::size_t n); // all values are added; exact for whole numbers while each lane's sum is below 2^24
    void (*fill)(float* to, std::size_t n, float value);
    void (*copy)(float* to, const float* from, std::size_t n);
};

// x = x a + b, `times` times, for `reals` numbers side by side, which start at 0, 1, 2 ...: enough of them in registers that none waits for its own
// last result. Two operations a number and time. Returns the sum of all.
template <class T> struct ArithmeticKernel {
    int reals;
    double (*multiply_add)(T a, T b, std::uint64_t times);
};

// The target's, which must be available.
MemoryKernels memory_kernels_for(Target);
template <class T> ArithmeticKernel<T> arithmetic_kernel_for(Target);

} // namespace bough::fast
