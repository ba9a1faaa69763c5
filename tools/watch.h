// watch.h: treesim --watch: the same run again whenever a file that it reads has changed.
//
// Files (INPUT, the trees of a scene, --wind FILE) are looked at every 200 ms: their time and size. What has changed is first let come to rest for as
// long, so that a file which an editor writes in parts, or removes and renames another to, is read whole. A run that fails says why, and
// leaves the output of the one before.
#pragma once
#include "treesim_options.h"
#include <functional>

namespace bough {

// run: makes the output, gives its frames. Each run is a line on stderr, unless --quiet. Ends by Interrupted; throws UsageError for an output that
// is one of the files read.
[[noreturn]] void watch(const TreesimOptions&, const std::function<std::int64_t()>& run);

} // namespace bough
