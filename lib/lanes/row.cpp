#include "row.h"
#include <cstdint>
#include <cstdlib>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace bough::fast {

// Before the rows stands where calloc's memory begins. (There is no aligned calloc, and one alone knows what the system has just made zero.)
void* allocate_rows(std::size_t bytes) {
    constexpr std::size_t huge = std::size_t(2) << 20;
    const bool large = bytes >= 2 * huge;
    const std::size_t unit = large ? huge : 64;
    void* const from = std::calloc(1, bytes + unit + sizeof from);
    if (!from) throw std::bad_alloc();
    void** const rows =
        reinterpret_cast<void**>((reinterpret_cast<std::uintptr_t>(from) + sizeof from + unit - 1) / unit * unit);
    rows[-1] = from;
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (large) madvise(rows, bytes, MADV_HUGEPAGE); // advice: without it all is slower, nothing else
#endif
    return rows;
}

void free_rows(void* rows) noexcept {
    if (rows) std::free(static_cast<void**>(rows)[-1]);
}

} // namespace bough::fast
