// stage.h: the parts of a step that are counted, timed and reported, in the order in which they run.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace bough {

enum class Stage : std::uint8_t {
    wind_field,
    external_forces,
    composite,
    drag,
    root_motion,
    fictitious,
    spring,
    articulated,
    midpoint,
    body_loads,
    attachments,
    resolvent,
    lanes,
    state_update,
    free_flight,
    contacts,
    fracture,
    walkers // the last
};
constexpr std::size_t stage_count = std::size_t(Stage::walkers) + 1;
const char* stage_name(Stage);

// The seconds per stage. A step fills them in when it is given a clock; without one it reads no time.
struct StageClock {
    std::array<double, stage_count> seconds{};
};

// Runs one stage, counts it in `state`, and times it if there is a clock.
template <class StateType, class Body> void run_stage(Stage stage, StateType& state, StageClock* clock, Body&& body) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = clock ? Time::now() : Time::time_point{};
    body();
    ++state.calls[std::size_t(stage)];
    if (clock) clock->seconds[std::size_t(stage)] += std::chrono::duration<double>(Time::now() - start).count();
}

} // namespace bough
