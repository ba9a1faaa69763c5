// kind.h: what a body is. It is a header of its own, so that code that knows nothing of Eigen can name kinds. A clump is how the air sees a leaf body
// that stands for several leaves (tree.h), a tuft one whose leaves are narrow, as needles; no document has these kinds.
#pragma once
#include <cstdint>

namespace bough {

enum class Kind : std::uint8_t { branch = 0, leaf = 1, fruit = 2, petal = 3, clump = 4, tuft = 5 };

// True for a body that is a thin plate, in shape and in the air: a leaf, a needle, a petal.
constexpr bool is_flat(Kind kind) {
    return kind == Kind::leaf || kind == Kind::petal;
}

constexpr bool stands_for_many(Kind kind) {
    return kind == Kind::clump || kind == Kind::tuft;
}

// True for a body that folds with the wind: leaves, alone and many.
constexpr bool is_foliage(Kind kind) {
    return is_flat(kind) || stands_for_many(kind);
}

} // namespace bough
