// count_allocations.h: for a test program that counts its allocations: replaces operator new and calloc (rows of lanes) of the whole program, so one
// source alone includes it.
// The address sanitizer has an allocator of its own; with it nothing is counted.
#pragma once
#include <atomic>
#include <cstdlib>
#include <cstring>
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
extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
    ++allocations;
    if (size > 0 && count > std::size_t(-1) / size) return nullptr;
    void* p = nullptr; // not by malloc, with which a compiler would make a call of calloc of this
    return posix_memalign(&p, 64, count * size) == 0 ? std::memset(p, 0, count * size) : nullptr;
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
