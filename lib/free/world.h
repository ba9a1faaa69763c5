// world.h: what is free in a scene: what breaks off its trees, balls, and walkers (§6, §8). world_step.h moves it.
//
// A scene without /fracture, /balls and /walkers has no World, and its step is advance() alone.
// A body that lies slow on the ground for half a second is at rest from then on. A leaf that comes to the ground lies down on it within some tenths
// of a second. The hash of a run with free bodies includes them. saved_world() and restore_world() hold them for a run that is cut. Nothing depends
// on threads.
#pragma once
#include "../model/motion.h"
#include "contact.h"
#include "fracture.h"
#include "walker.h"

namespace bough {

struct WorldCounts {
    std::array<std::uint64_t, 4> broke{}; // joints, by Kind of what they carried
    std::uint64_t hits = 0, landed = 0;
    ContactTests tests;
    double imbalance = 0;         // [N s] of the paper's pair: sum of |impulse on the free body + impulse on the tree|
    double impulse = 0;           // [N s] sum of the impulses on free bodies
    std::uint64_t pushed_out = 0; // contacts that overlapped
    double lifted = 0; // [J] of potential energy that pushing apart, and not ending behind what was met, gave
};

template <class T> struct World {
    const Tree* tree = nullptr;
    Contact contact;
    std::size_t balls = 0;             // the first of `free`
    std::vector<FreeBody> free;        // then what broke off, in that order
    std::vector<std::uint32_t> broken; // joints, in that order
    std::vector<Walk> walkers;
    std::vector<Breakable> breakable; // joints that may break yet
    Remaining remaining;              // with /fracture
    Subtrees subtrees;                // with /fracture, or where trees are pushed
    TreePoses<T> poses, before;       // at a step's end; where trees are met, at its start
    TreeResponse<T> response, rigid;  // where trees are pushed: with their springs, and without
    NearPairs<T> near;                // where many fly
    bool many = false;                // in this step
    WindTable<double> wind;
    MotionEvents events; // since the caller last cleared them
    WorldCounts counts;
    bool brute_force = false; // for tests: nothing is pruned

    bool on() const { return tree != nullptr; }
    std::size_t bytes() const;
};

// Makes the world; it is empty (on() false) where the scene has nothing free. The tree is kept by reference: joined, unscaled, as the plan was made
// from. Throws std::out_of_range for a selector of /fracture or /walkers that names no body, and std::domain_error for walkers on what may break.
// O(n).
template <class T> World<T> make_world(const Plan<T>&, const Tree&, const std::vector<TreeRange>&);

// Returns state_hash, continued over broken joints and free bodies.
template <class T> std::uint64_t state_hash(const Plan<T>&, const State<T>&, const World<T>&);

// Returns the first free body that is non-finite.
template <class T> std::optional<std::size_t> first_non_finite(const World<T>&);

// Puts the poses (and velocities, where the frame has them) of what fell in place of the tree's, and appends the balls', then the walkers'.
template <class T> void place_free_bodies(const World<T>&, MotionFrame&);

// Returns the balls of the scene, and behind them the walkers as the balls that they are shown as, where they begin.
std::vector<Ball> shown_balls(const Tree&, const Scene&, const std::vector<Walk>&);

// saved_world() returns all that a run needs to go on besides State. restore_world() puts it into a world, plan and state that were just made, before
// restart(). Throws std::invalid_argument for what does not fit them.
template <class T> std::vector<double> saved_world(const State<T>&, const World<T>&);
template <class T> void restore_world(Plan<T>&, State<T>&, World<T>&, const std::vector<double>&);

} // namespace bough
