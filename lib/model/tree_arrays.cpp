#include "tree_arrays.h"

namespace bough {

void Tree::resize(std::size_t bodies) {
    const auto one = [&](const char*, const auto& absent, auto& array) {
        if constexpr (always_there<std::decay_t<decltype(absent)>>)
            array.resize(bodies);
        else if (!array.empty())
            array.resize(bodies, absent);
    };
    each_array(one, *this);
}

void copy_labels(Tree& to, const Tree& from) {
    to.name = from.name;
    to.material = from.material;
    to.source = from.source;
    to.color = from.color;
}

Tree bodies_of(const Tree& tree, const std::vector<std::int32_t>& bodies) {
    Tree part;
    copy_labels(part, tree);
    const auto copy = [&](const char*, const auto&, auto& to, const auto& from) {
        if (from.empty()) return;
        to.reserve(bodies.size());
        for (const std::int32_t i : bodies) to.push_back(from[std::size_t(i)]);
    };
    each_array(copy, part, tree);
    return part;
}

} // namespace bough
