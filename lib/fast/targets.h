// targets.h: which of the compiled SIMD targets a run uses: chosen when the program starts, by what the machine has.
#pragma once
#include "analytic_sweeps.h"
#include "coupled_sweeps.h"
#include "energy_sweep.h"
#include <array>
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
// nullopt for another name.
std::optional<Target> target_named(const std::string&);

// The target's code, which must be available.
template <class T> CoupledSweeps<T> coupled_sweeps_for(Target, bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep_for(Target, bool wind, bool field);
template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target, AnalyticLoads);

} // namespace bough::fast
