#include "skin_joint.h"
#include <limits>
#include <tuple>

namespace bough {

void NodesByName::add(std::string_view name) {
    const auto node = std::int32_t(next_.size());
    next_.push_back(-1);
    const auto [found, is_new] = of_.try_emplace(name, Ends{node, node});
    if (is_new) return;
    next_[std::size_t(found->second.last)] = node;
    found->second.last = node;
}

std::int32_t NodesByName::first(std::string_view name) const {
    const auto found = of_.find(name);
    return found == of_.end() ? -1 : found->second.first;
}

std::int32_t joint_of(const NodesByName& nodes, std::string_view name, const std::vector<Eigen::Matrix4d>& world,
                      const std::vector<NodeRole>& role, const Eigen::Matrix4d& offset, const Eigen::Matrix4d& mesh) {
    const std::int32_t only = nodes.first(name);
    if (only < 0 || nodes.next(only) < 0) return only;
    // Distances below this are those of single precision.
    const double rounding = 1e-5 * mesh.norm();
    std::int32_t best = only;
    auto least = std::tuple(std::numeric_limits<double>::infinity(), true);
    for (std::int32_t i = only; i >= 0; i = nodes.next(i)) {
        const double off = (world[std::size_t(i)] * offset - mesh).norm();
        const auto cost = std::tuple(off <= rounding ? 0 : off, role[std::size_t(i)] == NodeRole::joint);
        if (!(cost < least)) continue;
        least = cost;
        best = i;
    }
    return best;
}

} // namespace bough
