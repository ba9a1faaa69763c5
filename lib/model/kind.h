// kind.h: what a body is. By itself, so that code that knows nothing of Eigen can name it. clump: what a leaf body that stands for several
// leaves is to the air (tree.h); no document has it.
#pragma once
#include <cstdint>

namespace bough {

enum class Kind : std::uint8_t { branch = 0, leaf = 1, fruit = 2, petal = 3, clump = 4 };

// A thin plate, in shape and in the air: a leaf, a needle, a petal.
constexpr bool is_flat(Kind kind) {
    return kind == Kind::leaf || kind == Kind::petal;
}

// Folds with the wind: leaves, alone and many.
constexpr bool is_foliage(Kind kind) {
    return is_flat(kind) || kind == Kind::clump;
}

} // namespace bough
