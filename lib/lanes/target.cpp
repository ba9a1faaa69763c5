#include "target.h"
#include <stdexcept>

namespace bough::fast {

const char* target_name(Target target) {
    static constexpr const char* names[] = {"baseline", "avx2", "avx512", "counted"};
    return names[std::size_t(target)];
}

std::optional<Target> target_named(const std::string& name) {
    for (Target target : all_targets)
        if (name == target_name(target)) return target;
    return std::nullopt;
}

bool available(Target target) {
#ifndef BOUGH_HAS_COUNTED
    if (target == counted_target) return false;
#endif
    switch (target) {
    case Target::avx512:
#ifdef BOUGH_HAS_AVX512
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("fma");
#else
        return false;
#endif
    case Target::avx2:
#ifdef BOUGH_HAS_AVX2
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
        return false;
#endif
    case Target::baseline:
#ifdef BOUGH_HAS_BASELINE
        return true;
#else
        return false;
#endif
    }
    return true; // counted
}

std::optional<Target> best_target() {
    std::optional<Target> best;
    for (Target target : all_targets)
        if (available(target)) best = target;
    return best;
}

void require(Target target) {
    if (available(target)) return;
    const std::optional<Target> best = best_target();
    throw std::invalid_argument(std::string("SIMD target ") + target_name(target) + " is not there, the best is " +
                                (best ? target_name(*best) : "none"));
}

} // namespace bough::fast
