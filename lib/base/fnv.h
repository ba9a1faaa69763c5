// fnv.h: FNV-1a, 64 bits, over the little-endian bytes of numbers.
#pragma once
#include <bit>
#include <cstdint>
#include <type_traits>

namespace bough {

class Fnv {
public:
    Fnv() = default;
    explicit Fnv(std::uint64_t goes_on_from) : hash(goes_on_from) {}
    template <class T> void add(T value) {
        static_assert(sizeof(T) == 4 || sizeof(T) == 8);
        using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        const Bits bits = std::bit_cast<Bits>(value);
        for (unsigned shift = 0; shift < 8 * sizeof(T); shift += 8) {
            hash ^= (bits >> shift) & 0xff;
            hash *= 0x100000001b3u;
        }
    }
    std::uint64_t value() const { return hash; }

private:
    std::uint64_t hash = 0xcbf29ce484222325u;
};

} // namespace bough
