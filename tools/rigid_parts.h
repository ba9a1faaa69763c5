// rigid_parts.h: runs of a part of a tree: what a scene's /simulate and a tree's own /rigid hold is joined to what it hangs on (lib/stages/reduce.h)
// before anything is planned, and comes back in the frames.
#pragma once
#include "lib/reference/rigid_error.h"
#include "simulation.h"

namespace bough {

// Setting::tree and scene become those of the reduced tree where joints are held, and Setting::whole keeps what they were; where none is, nothing
// changes. Throws InputError: a selector that names no body, nothing left that moves, free bodies beside rigid ones.
void join_rigid(Setting&, const std::string& input);

// A frame of the run becomes one of the whole tree; nothing to do where nothing is held.
template <class T> void show_whole(const Setting&, const Plan<T>&, const State<T>&, MotionFrame&);

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
