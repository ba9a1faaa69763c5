// rigid_parts.h: what holding joints costs in accuracy and saves in time (treesim --report-rigid).
#pragma once
#include "lib/study/rigid_error.h"
#include "simulation.h"

namespace bough {

// --report-rigid: the whole tree beside the run, with all its joints.
template <class T> class RigidReport {
public:
    // At the start of a run. Keeps a reference to the setting's whole tree. Throws UsageError where nothing is held.
    RigidReport(const Setting&, const RunOptions&);
    // After each frame of the run, whose poses are up to date: takes the whole tree there, and compares.
    void follow(const Plan<T>&, const State<T>&, std::int64_t frame);
    std::string line(double run_ms, std::int64_t frames) const; // run_ms: of all the run's frames

private:
    Setting setting_; // of the whole tree
    const Whole& whole_;
    RunOptions options_;
    Run<T> run_;
    RigidComparison comparison_;
    std::vector<Vector3<float>> there_, here_;
    double ms_ = 0;
};

} // namespace bough
