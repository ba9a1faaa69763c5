// random.h: random numbers without a state: each is a hash (SplitMix64's finalizer) of a key and of what it is drawn for.
//
// A stem's key is its parent's key mixed with what it is there (child, clone, leaf ...) and its number, so a key stands
// for seed and stem path. No draw depends on how many were made before it.
#pragma once
#include <cstdint>

namespace bough {

using RandomKey = std::uint64_t;

inline RandomKey mix_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// The key of draw or descendant `index` of the given name.
template <class Name> RandomKey random_key(RandomKey key, Name name, std::uint64_t index) {
    const std::uint64_t golden = 0x9e3779b97f4a7c15u;
    return mix_bits(mix_bits(key + golden * (static_cast<std::uint64_t>(name) + 1)) + golden * (index + 1));
}

// Uniform in 0..1 without 1, 53 bits.
template <class Name> double random_unit(RandomKey key, Name name, std::uint64_t index = 0) {
    return static_cast<double>(random_key(key, name, index) >> 11) * 0x1p-53;
}

// Uniform in -1..1: the paper's "plus or minus".
template <class Name> double random_sign(RandomKey key, Name name, std::uint64_t index = 0) {
    return 2 * random_unit(key, name, index) - 1;
}

} // namespace bough
