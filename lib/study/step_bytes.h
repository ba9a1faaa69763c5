// step_bytes.h: what a step over lanes (coupled_sweeps.h) moves between memory and a core, by counting: quantities that a sweep reads and
// writes (coupled_rows.h), times the layout's rows of 64 bytes, pads among them.
//
// Supposed: every table is larger than the caches, so that each sweep fetches anew what it reads, and what it writes goes out; what a block
// alone works in (`loaded`, constants between its two sweeps, and `solved` of a block of whole trees) stays in the core's cache. A line that is
// written through the caches is fetched first, so it moves in and out; one that is streamed past them moves out alone.
//   constants   in once, but for what gravity and wind alone read. Where instances share them (shared_constants.h) in once for all rows, if they
//               are together no more than 32 MB; else as if they were not shared
//   now         in once; theta and theta_dot a second time where the sweep outward has to wait for other blocks
//   next        in and out; out alone where it takes the place of what a row of a waiting block was solved to
//   solved      out (streamed), or in and out; in once more. None where the block is of whole trees
//   records     of each joint (outward, inward, accelerated): in and out
//   indices     of rows and of chains' lanes (fork_of_row; base, landing): in with each sweep that reads them; of shared constants, once
// A scheme of one pole, and every block is awake (sleep.h). Not counted: the energy guard's sweep, pulls, the wind's table, groups and blocks:
// nothing beside these, or not in every step.
#pragma once
#include "../coupled/coupled_tables.h"

namespace bough::fast {

struct Moved {
    std::uint64_t in = 0, out = 0; // [bytes]
};

// Of one step of all bodies.
struct StepBytes {
    Moved constants, now, next, solved, records, indices;
    std::uint64_t tables = 0; // [bytes] that all of these take: what would have to fit a cache
    Moved total() const;
};

// real: sizeof of the precision. streamed: `solved` goes past the caches. shared: rows of constants that there are where rows share them; 0: they do
// not.
StepBytes coupled_step_bytes(const Layout&, bool wind, bool gravity, std::size_t real, bool streamed,
                             std::uint64_t shared = 0);

// The analytic step's (analytic_rows.h), which changes the motion where it stands: `next` goes out and need not come in. The top is visited twice,
// every other block once; nothing waits.
StepBytes analytic_step_bytes(const Layout&, bool wind, bool pulls, bool gravity, std::size_t real, bool field = false,
                              std::uint64_t shared = 0);

} // namespace bough::fast
