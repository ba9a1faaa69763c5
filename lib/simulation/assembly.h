// assembly.h: what a run is of: a scene's trees joined into one, with what the scene makes of them put into them.
//
//   stand        one tree after another where the scene places it
//   change_wood  /wood and /load go from the scene into the tree
//   join_rigid   bodies that are held (/simulate, a tree's own /rigid) become one with what they hang on (reduce.h)
// in that order; then plan_run (run.h) compiles the result.
#pragma once
#include "../plan/reduce.h"
#include "scene_error.h"
#include <memory>

namespace bough {

// Which part of a scene's trees a run holds, and what it must know of the whole scene.
struct Part {
    std::int32_t part = 1, parts = 1;
    std::int64_t first_body = 0;         // in the whole scene's order
    double top = 0, reach = 0;           // Wishes
    std::vector<double> clocks{};        // likewise
    bool foliage = false, faces = false; // likewise
    double settling = 0;                 // [s] of the whole (settling_time)
    std::uint64_t whole = 0;             // of all trees and the whole scene, as fingerprint()
    // The ground of some tree moves, of this part or another: what a still ground allows is left out
    bool moved = false;
};

// The whole from which a run with held joints was reduced.
struct Whole {
    Tree tree; // all bodies, none held
    Scene scene;
    Reduced places; // where each body is on the tree that runs, which is not in here
};

struct Assembly {
    Tree tree;
    std::vector<TreeRange> ranges; // of the scene's trees in it
    Scene scene;
    std::string source; // command lines that made the trees
    Part part = {};
    std::vector<std::string> changes{};   // what of the scene is in the tree by now: a line each, for the plan's report
    std::shared_ptr<const Whole> whole{}; // where joints are held; tree, ranges and scene are then of what moves
};

// Takes the first tree, which is often the only one and large, as it is, and copies others behind it. O(bodies).
void stand(Assembly&, Tree, const Placement& at);

// Puts /wood and /load into the tree. Throws SceneError for a selector that names no body. O(bodies).
void change_wood(Assembly&);

// Joins held bodies to what they hang on; changes nothing where nothing is held. O(bodies). Throws SceneError for a selector that names no body, if
// nothing is left that moves, and for free bodies beside rigid ones.
void join_rigid(Assembly&);

// [s] Simulation::settling_time. A part of a scene gives the whole scene's. O(bodies).
double settling_time(const Assembly&);

// Does all of this for a scene that holds its trees (Placement::tree). Throws SceneError, also for what check() finds.
Assembly assemble(Scene);

// "/field: message", with the entry behind the field where there is one: of a SceneError.
std::string text_of(const Defect&);

} // namespace bough
