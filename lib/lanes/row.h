// row.h: 64 bytes of one quantity, a cache line and a register of the widest machines (layout.h), and arrays of them.
#pragma once
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace bough::fast {

template <class T> struct alignas(64) Row {
    static constexpr int lanes = int(64 / sizeof(T));
    T lane[lanes];
};

// Gives aligned memory of zeros, in huge pages where it is large and the system gives them. A sweep goes through megabytes, and looking up small
// pages took a third of the time that reading them did. The system gives a large array's pages, already zero, as each is first touched, to the
// thread that does: nobody fills them here. Throws std::bad_alloc.
void* allocate_rows(std::size_t bytes);
void free_rows(void*) noexcept;
constexpr std::size_t huge_page = std::size_t(2) << 20;
std::size_t row_alignment(std::size_t bytes); // of what allocate_rows gives: huge_page, or a cache line

template <class X> struct RowAllocator {
    using value_type = X;
    RowAllocator() = default;
    template <class Y> RowAllocator(const RowAllocator<Y>&) {}
    X* allocate(std::size_t n) { return static_cast<X*>(allocate_rows(n * sizeof(X))); }
    void deallocate(X* p, std::size_t) noexcept { free_rows(p); }
    void construct([[maybe_unused]] X* p) noexcept { assert(is_zero(p)); } // as it is allocated
    template <class... From> void construct(X* p, From&&... from) {
        ::new (static_cast<void*>(p)) X(std::forward<From>(from)...);
    }
    friend bool operator==(const RowAllocator&, const RowAllocator&) { return true; }

private:
    static bool is_zero(const X* p) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(p);
        return std::all_of(bytes, bytes + sizeof(X), [](unsigned char byte) { return byte == 0; });
    }
};

// A vector of rows must not shrink and grow again: what is cut off stays in its memory, and would be taken for zeros.
template <class T> using RowVector = std::vector<Row<T>, RowAllocator<Row<T>>>;

// Makes `rows` so many rows of zeros.
template <class T> void set_zero_rows(RowVector<T>& rows, std::size_t count) {
    if (rows.size() == count) return void(rows.assign(count, Row<T>{}));
    rows = RowVector<T>(); // before there are two
    rows = RowVector<T>(count);
}

} // namespace bough::fast
