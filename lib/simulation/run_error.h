// run_error.h: how wrong a run is at its step, seen while it goes on. A companion goes beside it at a quarter of the step, and the branches' tips of
// both are compared. The estimate is 0.9 to 1.8 times the true error; error_estimate.h tells what it is worth and where it is unknown.
#pragma once
#include <cstdint>
#include <memory>

namespace bough {

class Simulation;

// Over tips and samples.
struct TipError {
    static constexpr int finer = 4; // the companion's steps to one of the run's

    double rms = 0, worst = 0; // [m] of the run, estimated
    double deflection = 0;     // [m] RMS of the run's tips from its start pose
    double rough = 0;          // [m] RMS of the companion's fourth differences
    double rounding = 0;       // [m] the precision's epsilon at the tip farthest from the origin in the start pose
    std::int64_t samples = 0;  // steps, or frames, that were compared
    std::size_t tips = 0;
    bool finite = true; // the companion's state; ends the comparison where it is not
    bool known() const { return finite && rough <= (2 * rms > 100 * rounding ? 2 * rms : 100 * rounding); }
};

// Estimates the error of a simulation of the coupled method in which nothing is free. Reads the run and never changes it. Each step costs four more,
// and the memory is that of a second run.
class RunError {
public:
    // Begins with the run as it stands, at its start or on its way: the error is counted from there on. Throws SceneError. Keeps a reference to the
    // run, so it must end before the run is moved from.
    explicit RunError(Simulation&);
    RunError(RunError&&) noexcept;
    RunError& operator=(RunError&&) noexcept;
    ~RunError();

    // Tells the companion what was changed since the last step: wind, gravity, wood, ground, pulls, hands, the step. Called before the next step.
    void lead();
    // Called after each step, or each frame of several steps. Allocates nothing, except where hands came or went.
    void follow();
    TipError result() const;

private:
    struct Own;
    std::unique_ptr<Own> own_;
};

} // namespace bough
