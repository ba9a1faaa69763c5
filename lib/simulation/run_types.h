// run_types.h: what a simulation is asked for, and what it reports.
#pragma once
#include "../base/math.h"
#include "../plan/step_flags.h"
#include "method.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct SimulationOptions {
    double step = 1.0 / 30; // [s] length of a step, above 0; set_step() changes it
    Precision precision = Precision::double_;
    Method method = Method::coupled;
    // [rad/s] trees that have been slower than this for a while are left out of steps until something moves them; 0: never
    double sleep = 0;
    // The most threads a step takes, the caller's included; 0: one a core of the process. Small work takes fewer ("Threads")
    int threads = 0;
    bool velocities = false; // velocities() and angular_velocities() will be read; else they are empty
    bool torques = false;    // the same for torques()
    bool stresses = false;   // the same for stresses()
    bool pulls = false;      // pull() will be called; without this, the step has no place for it
    // set_ground() will be called. Nothing sleeps then, and the analytic method takes the plain path
    bool grounds = false;
    // Take the plain path, one number at a time: rounding does not depend on the machine's SIMD; several times slower
    bool portable = false;
};

// How a tree's ground has moved from where the tree was drawn: a point drawn at X is now at pivot + position + rotation (X - pivot). The pivot is the
// tree's own place (Placement::position).
struct GroundMotion {
    Vec3 position = Vec3::Zero(); // [m]
    Quat rotation = Quat::Identity();
    Vec3 velocity = Vec3::Zero(), angular_velocity = Vec3::Zero(); // [m/s] of the pivot, [rad/s], world
};

struct StepReport {
    std::string non_finite; // "": finite. Else stage and body: "stage resolvent (theta), body 17 (branch 3)"
    // Bodies whose motion the steps could not follow, in this call (lib/study/README.md, "What is not promised"). None of this is an error.
    std::uint64_t fast_turns = 0;                // turned by more than a radian
    std::uint64_t guarded = 0;                   // were kept from gaining energy
    std::uint64_t limited = 0;                   // ended at a joint's limit, which the scene asks for
    std::size_t broke = 0, hits = 0, landed = 0; // how many of events() are called so

    bool finite() const { return non_finite.empty(); }
};

struct StageCalls {
    const char* stage; // "composite", "lanes", "state_update" ...
    std::uint64_t calls;
};

// A run's account of itself. It counts from time 0, or from where the run was restored.
struct RunAccount {
    std::size_t bodies = 0; // whose joints move: the trees' without those that are held
    std::string solver;     // "coupled", "analytic"
    std::string simd;       // what lanes are compiled for: "baseline", "avx2", "avx512"; "none" on the plain path
    std::string awake;      // why nothing sleeps: "not asked for", "/wind/turbulence" ...; "" where trees may
    double sleep = 0;       // [rad/s] below which they do
    // All there are, in the order in which they run (explain() says which the scene needs)
    std::vector<StageCalls> stages;
    StepFlags flags;
    // What broke off and what flew.
    std::array<std::uint64_t, 4> broke{}; // joints, by Kind of what they carried
    std::uint64_t hits = 0, landed = 0;   // of free bodies with anything; of leaves and petals on the ground
    double imbalance = 0; // [N s] of momentum, of ContactModel::penalty: the sum of what each contact made
    std::size_t state_bytes = 0, free_bytes = 0; // [B] of the trees' state, and of what is free
};

} // namespace bough
