// radix_order.h: the order of many whole numbers, faster than by comparing them.
#pragma once
#include <cstdint>
#include <vector>

namespace bough {

// The indices of `key` in ascending order of the keys, equal ones in their own order. Fewer than 2^32 of them. Digits that
// are the same in all keys cost nothing. O(keys), 24 bytes each while it works.
std::vector<std::uint32_t> radix_order(std::vector<std::uint64_t>&& key);

} // namespace bough
