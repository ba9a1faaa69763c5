// target.h: what the kernels over lanes are compiled for; which one runs is chosen when the program starts.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace bough::fast {

// Rising. baseline: what every machine of the architecture has (128 bits on x86-64 and ARM), also where it has no SIMD at all.
enum class Target : std::uint8_t { baseline, avx2, avx512 };
constexpr std::array<Target, 3> all_targets{Target::baseline, Target::avx2, Target::avx512};
const char* target_name(Target); // as in --simd

// Compiled in, and this machine has it.
bool available(Target);
// The widest available one.
Target best_target();
// Throws std::invalid_argument for one that is not available.
void require(Target);
// nullopt for another name.
std::optional<Target> target_named(const std::string&);

} // namespace bough::fast
