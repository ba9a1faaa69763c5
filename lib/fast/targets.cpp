#include "targets.h"
#include "machine_kernels.h"
#include "operations.h"
#include <stdexcept>

namespace bough::fast {

namespace baseline {
template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep(bool wind, bool field);
MemoryKernels memory_kernels();
template <class T> ArithmeticKernel<T> arithmetic_kernel();
template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads);
} // namespace baseline
#ifdef BOUGH_HAS_COUNTED
namespace counted {
template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep(bool wind, bool field);
template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads);
} // namespace counted
#endif
#ifdef BOUGH_HAS_AVX2
namespace avx2 {
template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep(bool wind, bool field);
MemoryKernels memory_kernels();
template <class T> ArithmeticKernel<T> arithmetic_kernel();
template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads);
} // namespace avx2
#endif
#ifdef BOUGH_HAS_AVX512
namespace avx512 {
template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep(bool wind, bool field);
MemoryKernels memory_kernels();
template <class T> ArithmeticKernel<T> arithmetic_kernel();
template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads);
} // namespace avx512
#endif

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
        break;
    }
    return true;
}

Target best_target() {
    Target best = Target::baseline;
    for (Target target : all_targets)
        if (available(target)) best = target;
    return best;
}

namespace {

void require(Target target) {
    if (!available(target))
        throw std::invalid_argument(std::string("SIMD target ") + target_name(target) + " is not there, the best is " +
                                    target_name(best_target()));
}

} // namespace

template <class T> CoupledSweeps<T> coupled_sweeps_for(Target target, bool wind, bool gravity, bool field) {
    require(target);
#ifdef BOUGH_HAS_COUNTED
    if (target == counted_target) return counted::coupled_sweeps<T>(wind, gravity, field);
#endif
#ifdef BOUGH_HAS_AVX512
    if (target == Target::avx512) return avx512::coupled_sweeps<T>(wind, gravity, field);
#endif
#ifdef BOUGH_HAS_AVX2
    if (target == Target::avx2) return avx2::coupled_sweeps<T>(wind, gravity, field);
#endif
    return baseline::coupled_sweeps<T>(wind, gravity, field);
}

template <class T> EnergySweepOf<T> energy_sweep_for(Target target, bool wind, bool field) {
    require(target);
#ifdef BOUGH_HAS_COUNTED
    if (target == counted_target) return counted::energy_sweep<T>(wind, field);
#endif
#ifdef BOUGH_HAS_AVX512
    if (target == Target::avx512) return avx512::energy_sweep<T>(wind, field);
#endif
#ifdef BOUGH_HAS_AVX2
    if (target == Target::avx2) return avx2::energy_sweep<T>(wind, field);
#endif
    return baseline::energy_sweep<T>(wind, field);
}

MemoryKernels memory_kernels_for(Target target) {
    require(target);
#ifdef BOUGH_HAS_AVX512
    if (target == Target::avx512) return avx512::memory_kernels();
#endif
#ifdef BOUGH_HAS_AVX2
    if (target == Target::avx2) return avx2::memory_kernels();
#endif
    return baseline::memory_kernels();
}

template <class T> ArithmeticKernel<T> arithmetic_kernel_for(Target target) {
    require(target);
#ifdef BOUGH_HAS_AVX512
    if (target == Target::avx512) return avx512::arithmetic_kernel<T>();
#endif
#ifdef BOUGH_HAS_AVX2
    if (target == Target::avx2) return avx2::arithmetic_kernel<T>();
#endif
    return baseline::arithmetic_kernel<T>();
}

template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target target, AnalyticLoads loads) {
    require(target);
#ifdef BOUGH_HAS_COUNTED
    if (target == counted_target) return counted::analytic_sweeps<T>(loads);
#endif
#ifdef BOUGH_HAS_AVX512
    if (target == Target::avx512) return avx512::analytic_sweeps<T>(loads);
#endif
#ifdef BOUGH_HAS_AVX2
    if (target == Target::avx2) return avx2::analytic_sweeps<T>(loads);
#endif
    return baseline::analytic_sweeps<T>(loads);
}

template CoupledSweeps<float> coupled_sweeps_for(Target, bool, bool, bool);
template CoupledSweeps<double> coupled_sweeps_for(Target, bool, bool, bool);
template EnergySweepOf<float> energy_sweep_for<float>(Target, bool, bool);
template EnergySweepOf<double> energy_sweep_for<double>(Target, bool, bool);
template ArithmeticKernel<float> arithmetic_kernel_for(Target);
template ArithmeticKernel<double> arithmetic_kernel_for(Target);
template AnalyticSweeps<float> analytic_sweeps_for(Target, AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps_for(Target, AnalyticLoads);

} // namespace bough::fast
