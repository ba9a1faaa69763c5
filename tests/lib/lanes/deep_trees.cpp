// The layout of trees with long ways out: how many lanes stay empty, how large blocks are, what it depends on. layout.cpp has what holds for all.
#include "lib/lanes/layout.h"
#include "tests/support/lane_shapes.h"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace bough;
using namespace bough::fast;
using namespace lane_shapes;

// The rows that a tree's longest ways out and its number of bodies make necessary, whatever the order, are within a fifth of what is taken.
TEST_CASE("long axes with long side branches leave few lanes empty") {
    const Shape shape = limbs(60);
    const std::vector<std::int32_t>& parent = shape.parent;
    for (const int lanes : {8, 16}) {
        const Layout layout = shape.layout(lanes);
        std::vector<std::size_t> bodies(layout.blocks.size(), 0), height(parent.size(), 1), block(parent.size());
        std::vector<std::size_t> longest(layout.blocks.size(), 0);
        for (std::size_t b = 0; b < layout.blocks.size(); ++b)
            for (std::size_t s = layout.blocks[b].first_row * std::size_t(lanes);
                 s < layout.blocks[b].end_row * std::size_t(lanes); ++s)
                if (layout.body[s] >= 0) block[std::size_t(layout.body[s])] = b;
        for (std::size_t i = parent.size(); i-- > 0;) {
            ++bodies[block[i]];
            longest[block[i]] = std::max(longest[block[i]], height[i]);
            if (parent[i] < 0 || block[std::size_t(parent[i])] != block[i]) continue;
            height[std::size_t(parent[i])] = std::max(height[std::size_t(parent[i])], height[i] + 1);
        }
        std::size_t least = 0;
        for (std::size_t b = 0; b < bodies.size(); ++b)
            least += std::max(longest[b], (bodies[b] + std::size_t(lanes) - 1) / std::size_t(lanes));
        CAPTURE(lanes, layout.rows, least, parent.size());
        CHECK(double(layout.rows) < 1.2 * double(least));
        CHECK(double(layout.rows) * lanes < 1.5 * double(parent.size()));
    }
}

TEST_CASE("blocks grow where that saves rows, and only there") {
    const auto largest = [](const Shape& shape) {
        const Layout layout = shape.layout(16);
        std::size_t most = 0;
        for (std::size_t b = 1; b < layout.blocks.size(); ++b) {
            std::size_t bodies = 0;
            for (std::size_t s = layout.blocks[b].first_row * std::size_t(16);
                 s < layout.blocks[b].end_row * std::size_t(16); ++s)
                bodies += layout.body[s] >= 0;
            most = std::max(most, bodies);
        }
        return most;
    };
    CHECK(largest(limbs(60)) > 4096);
    CHECK(largest(limbs(10)) <= 4096); // a tenth of the stand
    CHECK(largest(ropes(10, 20000)) <= 4096);
    CHECK(largest(bare_star(200000)) <= 4096); // its rows are full
}

// Bodies of the first tree stand in the same lanes of as long groups, in the same blocks, whatever follows.
TEST_CASE("what a tree's layout is does not depend on trees beyond its stand") {
    for (const Shape& a : {limbs(60), Shape("", grown_tree(20000)), ropes(10, 20000)})
        for (const int lanes : {8, 16}) {
            CAPTURE(a.name, lanes);
            const Layout alone = a.layout(lanes), with = beside(a, ropes(12, 20000)).layout(lanes);
            const auto block_of = [](const Layout& layout, std::uint32_t slot) {
                std::size_t b = 0;
                while (slot / std::uint32_t(layout.lanes) >= layout.blocks[b].end_row) ++b;
                return b;
            };
            std::size_t differ = 0;
            for (std::size_t i = 0; i < a.parent.size(); i += 7) {
                const std::size_t block = block_of(alone, alone.slot[i]);
                const auto row = [&](const Layout& layout) {
                    return layout.slot[i] - layout.blocks[block].first_row * std::uint32_t(lanes);
                };
                differ += block_of(with, with.slot[i]) != block || row(alone) != row(with);
            }
            CHECK(differ == 0);
        }
}

TEST_CASE("a chain of half a million bodies, and one of leaves, are laid out") { // once quadratic: minutes
    std::vector<std::int32_t> parent;
    for (std::int32_t k = 0; k < 500000; ++k) parent.push_back(k - 1);
    for (const Kind kind : {Kind::branch, Kind::leaf})
        CHECK(Shape("", parent, std::vector<Kind>(parent.size(), kind)).layout(16).rows == parent.size());
}
