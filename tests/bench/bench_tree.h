// bench_tree.h: the tree that is measured on, made by the library: bodies with leaves and fruit, the same for all benchmarks of a program.
#pragma once
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"

namespace bench {

inline const bough::Tree& tree() {
    static const bough::Tree grown = bough::segment(
        bough::grow_bodies(bough::default_growth(), 1, {true, false, true}, 10000), bough::wood_presets().front(), {});
    return grown;
}

} // namespace bench
