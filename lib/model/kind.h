// kind.h: what a body is. By itself, so that code that knows nothing of Eigen can name it.
#pragma once
#include <cstdint>

namespace bough {

enum class Kind : std::uint8_t { branch = 0, leaf = 1, fruit = 2, petal = 3 };

// A thin plate, in shape and in the air: a leaf, a needle, a petal.
constexpr bool is_flat(Kind kind) {
    return kind == Kind::leaf || kind == Kind::petal;
}

} // namespace bough
