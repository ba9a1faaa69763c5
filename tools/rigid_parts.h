// rigid_parts.h: what holding joints costs in accuracy and saves in time (treesim --report rigid).
#pragma once
#include "lib/study/rigid_error.h"
#include "simulation.h"

namespace bough {

// --report rigid: the whole tree beside the run, with all its joints.
class RigidReport {
public:
    // At the start of a run. Throws UsageError where nothing is held.
    RigidReport(const Setting&, const RunOptions&, int threads);
    // After each frame of the run: takes the whole tree there, and compares.
    void follow(Simulation&, std::int64_t frame);
    Simulation& whole() { return run_; }
    std::string line(double run_ms, std::int64_t frames) const; // run_ms: of all the run's frames

private:
    std::shared_ptr<const Whole> whole_;
    RunOptions options_;
    Simulation run_; // of the whole tree
    RigidComparison comparison_;
    std::vector<Vector3<float>> there_, here_;
    double ms_ = 0;
};

} // namespace bough
