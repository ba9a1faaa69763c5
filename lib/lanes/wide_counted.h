// wide_counted.h: wide.h for the target that counts (operations.h): a register of one number.
#pragma once
#include "operations.h"
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class T> struct Counted {
    T value;

    Counted() = default;
    Counted(T v) : value(v) {}
    // Its bits as a whole number (wide_pair.h), and back.
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    using UnsignedBits = std::make_unsigned_t<Bits>;
    explicit Counted(Bits b) : value(std::bit_cast<T>(b)) {}
    explicit Counted(UnsignedBits b) : value(std::bit_cast<T>(b)) {}
    explicit operator Bits() const { return std::bit_cast<Bits>(value); }
    explicit operator UnsignedBits() const { return std::bit_cast<UnsignedBits>(value); }
    friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
    friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
    friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
    T& operator[](int) { return value; }
    const T& operator[](int) const { return value; }

    friend Counted operator+(Counted a, Counted b) {
        ++counted_operations().additions;
        return a.value + b.value;
    }
    friend Counted operator-(Counted a, Counted b) {
        ++counted_operations().additions;
        return a.value - b.value;
    }
    friend Counted operator*(Counted a, Counted b) {
        ++counted_operations().multiplications;
        return a.value * b.value;
    }
    friend Counted operator/(Counted a, Counted b) {
        ++counted_operations().divisions;
        return a.value / b.value;
    }
    Counted& operator+=(Counted more) { return *this = *this + more; }
    Counted& operator-=(Counted less) { return *this = *this - less; }
    Counted& operator*=(Counted factor) { return *this = *this * factor; }
    friend Counted operator-(Counted a) { return -a.value; }
    friend Counted root(Counted a) {
        ++counted_operations().roots;
        return std::sqrt(a.value);
    }
    friend bool any_above(Counted a, Counted b) { return a.value > b.value; }
    friend Counted where_above(Counted a, Counted b, Counted then) { return a.value > b.value ? then : Counted{}; }
    friend T total(Counted a) { return a.value; }
    friend Counted smaller(Counted a, Counted b) { return a.value < b.value ? a : b; }
    friend Counted larger(Counted a, Counted b) { return a.value > b.value ? a : b; }
    friend void stream(T* at, Counted a) { *at = a.value; }
};

using WideFloat = Counted<float>;
using WideDouble = Counted<double>;
template <class T> constexpr int width = 1;
template <class T> Counted<T> all(T value) {
    return value;
}

inline void transpose(WideFloat (&)[1]) {}
inline void transpose(WideDouble (&)[1]) {}

} // namespace BOUGH_TARGET
} // namespace bough::fast
