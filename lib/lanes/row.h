// row.h: 64 bytes of one quantity, a cache line and a register of the widest machines (layout.h), and arrays of them.
#pragma once
#include <cstddef>
#include <vector>

namespace bough::fast {

template <class T> struct alignas(64) Row {
    static constexpr int lanes = int(64 / sizeof(T));
    T lane[lanes];
};

// Gives aligned memory, in huge pages where it is large and the system gives them. A sweep goes through megabytes, and looking up small pages took a
// third of the time that reading them did. Throws std::bad_alloc.
void* allocate_rows(std::size_t bytes);
void free_rows(void*) noexcept;

template <class X> struct RowAllocator {
    using value_type = X;
    RowAllocator() = default;
    template <class Y> RowAllocator(const RowAllocator<Y>&) {}
    X* allocate(std::size_t n) { return static_cast<X*>(allocate_rows(n * sizeof(X))); }
    void deallocate(X* p, std::size_t) noexcept { free_rows(p); }
    friend bool operator==(const RowAllocator&, const RowAllocator&) { return true; }
};

template <class T> using RowVector = std::vector<Row<T>, RowAllocator<Row<T>>>;

} // namespace bough::fast
