// count_allocations.h: for a test program that counts its allocations: replaces operator new and aligned_alloc (rows of lanes) of the whole program, so
// one source alone includes it.
// The address sanitizer has an allocator of its own; with it nothing is counted.
#pragma once
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocations{0};

#ifndef BOUGH_SANITIZED
void* counted(std::size_t bytes) {
    ++allocations;
    if (void* p = std::malloc(bytes ? bytes : 1)) return p;
    throw std::bad_alloc();
}
#endif

} // namespace

#ifndef BOUGH_SANITIZED
void* operator new(std::size_t bytes) {
    return counted(bytes);
}
void* operator new[](std::size_t bytes) {
    return counted(bytes);
}
extern "C" void* aligned_alloc(std::size_t unit, std::size_t bytes) noexcept {
    ++allocations;
    void* p = nullptr;
    return posix_memalign(&p, unit, bytes) == 0 ? p : nullptr;
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
    std::free(p);
}
#endif
