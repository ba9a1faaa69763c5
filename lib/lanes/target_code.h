// target_code.h: code that is compiled once for each SIMD target, in a namespace of the target's name, and found when the program runs.
//
//   BOUGH_IN_TARGETS(template <class T> Sweeps<T> sweeps(bool wind);)          declares it in the namespace of each target that is compiled in
//   return BOUGH_OF_TARGET(target, sweeps<T>(wind));                           calls that of `target`, which must be available
// The macros ending in _MACHINE declare and call what the counted target does not have.
#pragma once
#include "operations.h"
#include "target.h"
#include <stdexcept>

#ifdef BOUGH_HAS_BASELINE
#define BOUGH_IN_BASELINE(...)                                                                                         \
    namespace baseline {                                                                                               \
    __VA_ARGS__                                                                                                        \
    }
#define BOUGH_OR_BASELINE(target, ...) (target) == ::bough::fast::Target::baseline ? baseline::__VA_ARGS__:
#else
#define BOUGH_IN_BASELINE(...)
#define BOUGH_OR_BASELINE(target, ...)
#endif
#ifdef BOUGH_HAS_AVX2
#define BOUGH_IN_AVX2(...)                                                                                             \
    namespace avx2 {                                                                                                   \
    __VA_ARGS__                                                                                                        \
    }
#define BOUGH_OR_AVX2(target, ...) (target) == ::bough::fast::Target::avx2 ? avx2::__VA_ARGS__:
#else
#define BOUGH_IN_AVX2(...)
#define BOUGH_OR_AVX2(target, ...)
#endif
#ifdef BOUGH_HAS_AVX512
#define BOUGH_IN_AVX512(...)                                                                                           \
    namespace avx512 {                                                                                                 \
    __VA_ARGS__                                                                                                        \
    }
#define BOUGH_OR_AVX512(target, ...) (target) == ::bough::fast::Target::avx512 ? avx512::__VA_ARGS__:
#else
#define BOUGH_IN_AVX512(...)
#define BOUGH_OR_AVX512(target, ...)
#endif
#ifdef BOUGH_HAS_COUNTED
#define BOUGH_IN_COUNTED(...)                                                                                          \
    namespace counted {                                                                                                \
    __VA_ARGS__                                                                                                        \
    }
#define BOUGH_OR_COUNTED(target, ...) (target) == ::bough::fast::counted_target ? counted::__VA_ARGS__:
#else
#define BOUGH_IN_COUNTED(...)
#define BOUGH_OR_COUNTED(target, ...)
#endif

#define BOUGH_NO_TARGET throw std::logic_error("a SIMD target that require() lets pass is not there")

#define BOUGH_IN_TARGETS_MACHINE(...)                                                                                  \
    BOUGH_IN_BASELINE(__VA_ARGS__)                                                                                     \
    BOUGH_IN_AVX2(__VA_ARGS__)                                                                                         \
    BOUGH_IN_AVX512(__VA_ARGS__)
#define BOUGH_OF_TARGET_MACHINE(target, ...)                                                                           \
    (::bough::fast::require(target), BOUGH_OR_AVX512(target, __VA_ARGS__) BOUGH_OR_AVX2(target, __VA_ARGS__)           \
                                         BOUGH_OR_BASELINE(target, __VA_ARGS__) BOUGH_NO_TARGET)

#define BOUGH_IN_TARGETS(...)                                                                                          \
    BOUGH_IN_TARGETS_MACHINE(__VA_ARGS__)                                                                              \
    BOUGH_IN_COUNTED(__VA_ARGS__)
#define BOUGH_OF_TARGET(target, ...)                                                                                   \
    (::bough::fast::require(target),                                                                                   \
     BOUGH_OR_COUNTED(target, __VA_ARGS__) BOUGH_OR_AVX512(target, __VA_ARGS__) BOUGH_OR_AVX2(target, __VA_ARGS__)     \
         BOUGH_OR_BASELINE(target, __VA_ARGS__) BOUGH_NO_TARGET)
