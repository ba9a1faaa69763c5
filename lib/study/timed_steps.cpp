#include "timed_steps.h"
#include "../simulation/any_run.h"

namespace bough {

void begin_again(Simulation& simulation) {
    run_of(simulation).begin_again();
}

double timed_step(Simulation& simulation, StageClock* clock) {
    using Time = std::chrono::steady_clock;
    AnyRun& run = run_of(simulation);
    const Time::time_point start = Time::now();
    run.advance(clock);
    return std::chrono::duration<double>(Time::now() - start).count();
}

std::string non_finite(Simulation& simulation) {
    return run_of(simulation).non_finite();
}

} // namespace bough
