// method.h: what a run's steps are made by, and in which numbers.
#pragma once
#include <cstdint>

namespace bough {

// What numbers a run is made in. Single is twice as fast; tips differ by some millionths of the deflection.
enum class Precision : std::uint8_t { single, double_ };

// How a step is made: coupled is bough's own, analytic the paper's (lib/study/README.md).
enum class Method : std::uint8_t { coupled, analytic };

} // namespace bough
