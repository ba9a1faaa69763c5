// simulation.h: what treesim and treeprofile share: one run as frames.
#pragma once
#include "lib/lanes/plan_lanes.h"
#include "lib/simulation/run.h"
#include "lib/study/solvers.h"
#include "setting.h"

namespace bough {

double step_length(const RunOptions&); // [s]

// plan_run and start_run with their errors as the tool's.
template <class T> Plan<T> planned(const Setting&, const Wishes&, const RunOptions&);
template <class T> Plan<T> planned(Setting&&, const Wishes&, const RunOptions&);
template <class T> Run<T> started(Plan<T> plan, const Setting&, const RunOptions&);

// Takes the steps of one frame. A state that became non-finite throws PromiseError with frame, stage and body.
template <class T>
void advance_frame(Run<T>&, const Tree&, std::int64_t frame, int substeps, StageClock* clock = nullptr);

// Throws that PromiseError where theta or theta_dot is non-finite.
template <class T> void require_finite(const Plan<T>&, State<T>&, const Tree&, std::int64_t frame);

// The frame's number, time and arrays, as far as `fields` asks for them. Throws PromiseError where a pose is non-finite.
template <class T>
void fill_frame(const State<T>&, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame&);

} // namespace bough
