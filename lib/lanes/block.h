// block.h: the pieces that a layout is made of (layout.h), for code that knows no containers.
#pragma once
#include "../model/kind.h"
#include <cstdint>

namespace bough::fast {

constexpr std::uint32_t nothing = 0xffffffffu;

struct Group {
    std::uint32_t first_row = 0, length = 0;
    std::uint32_t first_base = 0; // of the lanes' base joints, in Layout::base and Layout::landing
    Kind kind = Kind::branch;     // branch, fruit, clump, or leaf for leaf and petal
};

struct Block {
    std::uint32_t first_group = 0, end_group = 0, terminal_group = 0; // from terminal_group on: nothing begins on them
    std::uint32_t first_fork = 0, end_fork = 0;                       // joints
    std::uint32_t first_row = 0, end_row = 0;
    bool whole = false; // whole trees: nothing of it stands on another block
};

} // namespace bough::fast
