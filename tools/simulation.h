// simulation.h: what treesim and treeprofile share: one run as frames.
#pragma once
#include "lib/free/world.h"
#include "lib/model/motion.h"
#include "lib/reference/advance.h"
#include "lib/stages/state.h"
#include "setting.h"

namespace bough {

// make_plan with its errors as the tool's. A setting that is handed over keeps of its tree what make_plan says, and memory low.
template <class T> Plan<T> plan_run(const Setting&, const Wishes&, const RunOptions&);
template <class T> Plan<T> plan_run(Setting&&, const Wishes&, const RunOptions&);

// A run: trees, and what is free (World::on).
template <class T> struct Run {
    Plan<T> plan;
    State<T> state;
    World<T> world;
};
// At the start. Keeps a reference to the setting's tree where the scene has something free.
template <class T> Run<T> start_run(Plan<T> plan, const Setting&, const RunOptions&);

// Takes the steps of one frame. A state that became non-finite throws PromiseError with frame, stage and body.
template <class T>
void advance_frame(Run<T>&, const Tree&, std::int64_t frame, int substeps, StageClock* clock = nullptr);

// Throws that PromiseError where theta or theta_dot is non-finite.
template <class T> void require_finite(const Plan<T>&, State<T>&, const Tree&, std::int64_t frame);

// The frame's arrays, as far as `fields` asks for them. Throws PromiseError where a pose is non-finite.
template <class T>
void fill_frame(const State<T>&, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame&);

std::string hash_text(std::uint64_t hash); // 16 hex digits

} // namespace bough
