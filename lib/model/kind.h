// kind.h: what a body is. It is a header of its own, so that code that knows nothing of Eigen can name kinds. A clump is how the air sees a leaf body
// that stands for several leaves (tree.h); no document has this kind.
#pragma once
#include <cstdint>

namespace bough {

enum class Kind : std::uint8_t { branch = 0, leaf = 1, fruit = 2, petal = 3, clump = 4 };

// True for a body that is a thin plate, in shape and in the air: a leaf, a needle, a petal.
constexpr bool is_flat(Kind kind) {
    return kind == Kind::leaf || kind == Kind::petal;
}

// True for a body that folds with the wind: leaves, alone and many.
constexpr bool is_foliage(Kind kind) {
    return is_flat(kind) || kind == Kind::clump;
}

} // namespace bough
