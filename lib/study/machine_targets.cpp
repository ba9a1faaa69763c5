#include "../lanes/target_code.h"
#include "machine_kernels.h"

namespace bough::fast {

BOUGH_IN_TARGETS_MACHINE(MemoryKernels memory_kernels();)
BOUGH_IN_TARGETS_MACHINE(template <class T> ArithmeticKernel<T> arithmetic_kernel();)

MemoryKernels memory_kernels_for(Target target) {
    return BOUGH_OF_TARGET_MACHINE(target, memory_kernels());
}

template <class T> ArithmeticKernel<T> arithmetic_kernel_for(Target target) {
    return BOUGH_OF_TARGET_MACHINE(target, arithmetic_kernel<T>());
}

template ArithmeticKernel<float> arithmetic_kernel_for(Target);
template ArithmeticKernel<double> arithmetic_kernel_for(Target);

} // namespace bough::fast
