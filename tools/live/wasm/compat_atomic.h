// compat_atomic.h: std::atomic_ref, which Emscripten 3.1.6's libc++ lacks, as lib/analytic/spring.cpp uses it, where there is one thread.
#pragma once
#include <atomic>
#ifndef __cpp_lib_atomic_ref
namespace std {
template <class T> class atomic_ref {
public:
    explicit atomic_ref(T& to) : to_(to) {}
    T fetch_add(T more, memory_order) noexcept {
        const T before = to_;
        to_ += more;
        return before;
    }

private:
    T& to_;
};
} // namespace std
#endif
