// large_pages.cpp: the tools' large arrays come in pages of 2 MB where the system has them. A program of a million bodies spends more time on asking
// for pages of 4 KB than on its work: treesim took 0.9 s to its first frame with those and 0.64 s with these. It is the programs' matter, not the
// library's: a library does not replace its user's `operator new`. The address and thread sanitizers keep their own.
// treeprofile has them as well, for it measures what treesim costs. The tables of lanes come in such pages in any program (lib/lanes/row.h).
#include "lib/base/sanitizers.h"
#if defined(__linux__) && !BOUGH_ADDRESS_SANITIZER && !BOUGH_THREAD_SANITIZER
#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace {

void* taken(std::size_t bytes) {
    constexpr std::size_t page = std::size_t(2) << 20;
    if (bytes < 2 * page || bytes > std::size_t(-1) - page) return std::malloc(bytes ? bytes : 1);
    void* const found = std::aligned_alloc(page, (bytes + page - 1) / page * page);
#ifdef MADV_HUGEPAGE
    if (found) madvise(found, bytes, MADV_HUGEPAGE); // advice: without it all is slower, nothing else
#endif
    return found;
}

} // namespace

void* operator new(std::size_t bytes) {
    while (true) {
        if (void* const found = taken(bytes)) return found;
        const std::new_handler handler = std::get_new_handler(); // formats/forked.cpp sets one
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
#endif
