#include "shared_constants.h"
#include <algorithm>
#include <cstring>
#include <utility>

namespace bough::fast {
namespace {

// Of the words of 64-byte lines, eight sums side by side. Only how often rows are compared in vain hangs on it.
std::uint64_t hash_of(const void* lines, std::size_t count) {
    constexpr std::size_t words = 8;
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;
    std::uint64_t sum[words] = {}, word[words];
    for (std::size_t k = 0; k < count; ++k) {
        std::memcpy(word, static_cast<const char*>(lines) + k * sizeof word, sizeof word);
        for (std::size_t j = 0; j < words; ++j) {
            sum[j] = (sum[j] ^ word[j]) * odd;
            sum[j] ^= sum[j] >> 32;
        }
    }
    std::uint64_t hash = 0;
    for (const std::uint64_t s : sum) hash = (hash ^ s ^ hash >> 32) * odd;
    return hash;
}

} // namespace

std::string reason_against_sharing(const Scene& scene, const std::vector<TreeRange>& ranges) {
    if (scene.fracture) return "/fracture";
    if (ranges.size() < 2) return "one tree";
    std::vector<std::pair<std::size_t, std::string>> trees;
    for (std::size_t k = 0; k < ranges.size(); ++k)
        if (ranges[k].bodies > 0)
            trees.emplace_back(ranges[k].bodies, k < scene.trees.size() ? scene.trees[k].file : std::string());
    std::sort(trees.begin(), trees.end());
    const bool twice = std::adjacent_find(trees.begin(), trees.end()) != trees.end();
    return twice ? "" : "no tree stands at two places";
}

template <class T> std::size_t shared_rows(const PlannedLanes<T>& lanes) {
    if (!lanes.sharing.on) return 0;
    return 1 + *std::max_element(lanes.sharing.row.begin(), lanes.sharing.row.end());
}

// The room for all is set aside; the system gives memory to what of it is written.
template <class T>
SharedRows<T>::SharedRows(PlannedLanes<T>& lanes, int quantities)
    : lanes_(lanes), quantities_(std::size_t(quantities)) {
    lanes.constants.reserve(lanes.layout.rows * quantities_);
    lanes.sharing.row.reserve(lanes.layout.rows + std::size_t(1));
}

template <class T> void SharedRows<T>::add(const Row<T>* row) {
    RowVector<T>& rows = lanes_.constants;
    const std::uint64_t hash = hash_of(row, quantities_);
    const auto [first, end] = known_.equal_range(hash);
    const auto same = std::find_if(first, end, [&](const auto& known) {
        return std::memcmp(&rows[known.second * quantities_], row, quantities_ * sizeof *row) == 0;
    });
    if (same != end) {
        lanes_.sharing.row.push_back(same->second);
        return;
    }
    const auto number = std::uint32_t(rows.size() / quantities_);
    known_.emplace(hash, number);
    rows.insert(rows.end(), row, row + quantities_);
    lanes_.sharing.row.push_back(number);
}

template <class T> void SharedRows<T>::finish() {
    PlannedSharing& sharing = lanes_.sharing;
    RowVector<T>& rows = lanes_.constants;
    if (rows.size() == sharing.row.size() * quantities_) {
        sharing = {false, "no two rows are equal", {}};
        return;
    }
    // Where little is shared, the copy would take more than the room that is left.
    if (rows.size() <= rows.capacity() / 2) rows.shrink_to_fit();
    sharing.row.push_back(sharing.row.back()); // asked for in advance
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::size_t shared_rows(const PlannedLanes<T>&);                                                          \
    template class SharedRows<T>;
#include "../base/instantiate.inc"

} // namespace bough::fast
