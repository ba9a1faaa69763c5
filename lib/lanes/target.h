// target.h: what the kernels over lanes are compiled for. The program chooses one when it starts.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace bough::fast {

// The targets, rising. baseline: what every machine of the architecture has (128 bits on x86-64 and ARM), also where it has no SIMD at all.
enum class Target : std::uint8_t { baseline, avx2, avx512 };
constexpr std::array<Target, 3> all_targets{Target::baseline, Target::avx2, Target::avx512};
const char* target_name(Target); // as in --simd
// A target that takes the place of a machine's in a plan, to count what a step computes (operations.h). It is not among all_targets: no machine is
// it, and --simd does not name it. It steps as baseline does, bit for bit, far more slowly. It is available where bough was built with
// BOUGH_COUNTING.
constexpr Target counted_target = Target(all_targets.size());

// True if it is compiled in and this machine has it.
bool available(Target);
// Returns the widest available target, nullopt where this machine has none of those that are compiled in.
std::optional<Target> best_target();
// Throws std::invalid_argument for a target that is not available.
void require(Target);
// Returns nullopt for another name.
std::optional<Target> target_named(const std::string&);

} // namespace bough::fast
