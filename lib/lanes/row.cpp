#include "row.h"
#include <cstdlib>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace bough::fast {

void* allocate_rows(std::size_t bytes) {
    constexpr std::size_t huge = std::size_t(2) << 20;
    const bool large = bytes >= 2 * huge;
    const std::size_t unit = large ? huge : 64;
    void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (!memory) throw std::bad_alloc();
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (large) madvise(memory, bytes, MADV_HUGEPAGE); // advice: without it all is slower, nothing else
#endif
    return memory;
}

void free_rows(void* memory) noexcept {
    std::free(memory);
}

} // namespace bough::fast
