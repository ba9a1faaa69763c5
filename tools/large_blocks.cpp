// large_blocks.cpp: the tools' operator new. Blocks of several megabytes (arrays over bodies, file contents) are asked of
// the system in huge pages: a tree of 3 million bodies otherwise costs a million page faults, which took longer than all
// reading, checking and planning together (README, "Loading and writing"). Smaller blocks, other systems and sanitized builds, whose own
// operator new must stay, are as ever. Programs that use bough as a library choose for themselves.
#if defined(__linux__) && !defined(BOUGH_SANITIZED)
#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace {

constexpr std::size_t huge_page = std::size_t(1) << 21;
constexpr std::size_t large = 2 * huge_page;

void* allocate(std::size_t size) {
    if (size < large) return std::malloc(size == 0 ? 1 : size);
    void* block = nullptr;
    if (::posix_memalign(&block, huge_page, size) != 0) return nullptr;
    (void)::madvise(block, size, MADV_HUGEPAGE); // advice: where it is not taken, pages are small
    return block;
}

} // namespace

void* operator new(std::size_t size) {
    for (;;) {
        if (void* block = allocate(size)) return block;
        const std::new_handler handler = std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* block) noexcept {
    std::free(block);
}

void operator delete(void* block, std::size_t) noexcept {
    std::free(block);
}
#endif
