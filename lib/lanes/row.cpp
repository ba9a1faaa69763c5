#include "row.h"
#include "../base/sanitizers.h"
#include <cstdint>
#include <cstdlib>
#include <cstring>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace bough::fast {

#if BOUGH_ADDRESS_SANITIZER // which sees what is written beyond a block only where the block ends with its rows
void* allocate_rows(std::size_t bytes) {
    void* const rows = std::aligned_alloc(row_alignment(bytes), (bytes + 63) / 64 * 64);
    if (!rows) throw std::bad_alloc();
    return std::memset(rows, 0, bytes);
}

void free_rows(void* rows) noexcept {
    std::free(rows);
}
#else
// Before the rows stands where calloc's memory begins. (There is no aligned calloc, and one alone knows what the system has just made zero.)
void* allocate_rows(std::size_t bytes) {
    const std::size_t unit = row_alignment(bytes);
    void* const from = std::calloc(1, bytes + unit + sizeof from);
    if (!from) throw std::bad_alloc();
    void** const rows =
        reinterpret_cast<void**>((reinterpret_cast<std::uintptr_t>(from) + sizeof from + unit - 1) / unit * unit);
    rows[-1] = from;
#ifdef MADV_HUGEPAGE
    if (unit == huge_page) madvise(rows, bytes, MADV_HUGEPAGE); // advice: without it all is slower, nothing else
#endif
    return rows;
}

void free_rows(void* rows) noexcept {
    if (rows) std::free(static_cast<void**>(rows)[-1]);
}
#endif

std::size_t row_alignment([[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE) && !BOUGH_ADDRESS_SANITIZER
    if (bytes >= 2 * huge_page) return huge_page;
#endif
    return 64;
}

} // namespace bough::fast
