// timed_steps.h: a simulation's steps by the clock, as treeprofile measures them: the steps alone, without events, reports and the search for what is
// non-finite.
#pragma once
#include "../plan/stage.h"
#include <string>

namespace bough {

class Simulation;

void begin_again(Simulation&); // as at its start, with nothing changed. Where nothing is free, no plan is made
// Takes a step. Returns its time [s], and adds that of its stages to the clock's.
double timed_step(Simulation&, StageClock* = nullptr);
std::string non_finite(Simulation&); // StepReport::non_finite, as the run stands

} // namespace bough
