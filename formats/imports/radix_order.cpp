#include "radix_order.h"
#include <array>
#include <cstddef>

namespace bough {
namespace {

constexpr int bits = 11, digits = 6; // 66: all of a key
constexpr std::size_t values = std::size_t(1) << bits;

std::size_t digit(std::uint64_t key, int d) {
    return std::size_t(key >> (bits * d)) & (values - 1);
}

} // namespace

std::vector<std::uint32_t> radix_order(std::vector<std::uint64_t>&& given) {
    std::vector<std::uint64_t> key = std::move(given);
    const std::size_t n = key.size();
    std::vector<std::array<std::uint32_t, values>> count(digits);
    for (const std::uint64_t k : key)
        for (int d = 0; d < digits; ++d) ++count[std::size_t(d)][digit(k, d)];
    std::vector<std::uint32_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = std::uint32_t(i);
    std::vector<std::uint64_t> next_key(n);
    std::vector<std::uint32_t> next_order(n);
    for (int d = 0; d < digits; ++d) {
        std::array<std::uint32_t, values>& at = count[std::size_t(d)];
        if (n == 0 || at[digit(key.front(), d)] == n) continue; // all the same
        std::uint32_t before = 0;
        for (std::uint32_t& c : at) {
            const std::uint32_t here = c;
            c = before;
            before += here;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t to = at[digit(key[i], d)]++;
            next_key[to] = key[i];
            next_order[to] = order[i];
        }
        key.swap(next_key);
        order.swap(next_order);
    }
    return order;
}

} // namespace bough
