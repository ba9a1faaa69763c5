// disjoint_sets.h: which of n things belong together, joined two by two (Galler and Fischer 1964, with path halving). O(log n) a call, mostly less.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace bough {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : of_(n) { std::iota(of_.begin(), of_.end(), 0); }
    // The least of its set.
    std::int32_t find(std::int32_t i) {
        while (of_[std::size_t(i)] != i) i = of_[std::size_t(i)] = of_[std::size_t(of_[std::size_t(i)])];
        return i;
    }
    void join(std::int32_t a, std::int32_t b) {
        a = find(a), b = find(b);
        of_[std::size_t(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<std::int32_t> of_;
};

} // namespace bough
