// step_flags.h: how often bodies met something in a run's steps that the plain laws do not have.
#pragma once
#include <cstdint>

namespace bough {

// Each counts bodies times steps, from time 0, or from where the run was restored. Only bounded_lambda, energy_guard and limited act on the result.
struct StepFlags {
    std::uint64_t buckling = 0;       // a joint's stiffness with gravity was negative
    std::uint64_t bounded_lambda = 0; // lambda, the rate at which such a joint falls, was bounded
    // A joint turned past half a turn, and its rotation vector went on from the other side
    std::uint64_t half_turns = 0;
    std::uint64_t energy_guard = 0; // a large turn had gained energy, which was taken back
    std::uint64_t limited = 0;      // a joint ended on its limit, which the scene asks for
    std::uint64_t fast_turns = 0;   // a body turned by more than a radian; the implicit steps bound that
    std::uint64_t asleep = 0;       // left out of the step, at rest
    // Of the reference solution, which cuts steps into smaller ones.
    std::uint64_t inner_steps = 0; // these, which is no guard
    std::uint64_t unresolved = 0;  // of them, that missed the tolerance at the smallest length
};

} // namespace bough
