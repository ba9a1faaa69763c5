// bough.h: the library's one header: grow a tree, cut it into bodies, run it.
//
//   grow        growth/grow.h            a tree's splines by Weber and Penn's parameters
//   segment     growth/segment.h         splines into rigid bodies with their wood's mass, stiffness and damping
//   append      model/append.h           several trees in one
//   Scene       model/scene.h            what trees stand where and what acts on them
//   Simulation  simulation/simulation.h  one run of it, step by step
//   pick        simulation/pick.h        which body a ray meets
//   RunError    simulation/run_error.h   how wrong it is
//   close_loop  simulation/loop.h        one period of a motion that repeats
// bough/files.h adds species by name and documents by file name. It belongs to a library beside this one (bough::files).
//
// Comments point at other headers, as (pose.h) does. Those that do not stand here are in bough's sources, each with its law's derivation. No program
// needs them. Numbers such as (10) and § are those of the paper "Real-time Interactive Tree Animation".
#pragma once
#include "growth/grow.h"
#include "growth/segment.h"
#include "model/append.h"
#include "model/scene.h"
#include "model/wood.h"
#include "simulation/loop.h"
#include "simulation/pick.h"
#include "simulation/run_error.h"
#include "simulation/simulation.h"
