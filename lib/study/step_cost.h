// step_cost.h: what a step over lanes computes and moves, counted (lanes/operations.h, step_bytes.h).
#pragma once
#include <cmath>
#include <cstdint>

namespace bough {

class Simulation;

// A body. NAN: not known, of a run on the plain path.
struct StepCost {
    double slots = NAN; // places in rows of lanes a body: 1 without pads
    double additions = NAN, multiplications = NAN, divisions = NAN, roots = NAN;
    // [B] each way
    double constants_in = NAN, now_in = NAN, next_in = NAN, next_out = NAN, solved_in = NAN, solved_out = NAN,
           records_in = NAN, records_out = NAN, indices_in = NAN;
    double tables = NAN; // [B] that these take
};

// Of a run of which nothing is free: it begins again, takes a step, and then up to `steps` that are counted, on this thread alone. Needs
// counts_steps().
StepCost step_cost(Simulation&, std::int64_t steps);
bool counts_steps(); // this build does (BOUGH_COUNTING)

} // namespace bough
