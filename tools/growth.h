// growth.h: what treegen grows: its options for species, parameter files and volumes, and the tree that comes of them.
#pragma once
#include "common.h"
#include "envelope.h"
#include "import_file.h"
#include "lib/model/splines.h"
#include "option_list.h"

namespace bough {

struct GrowthOptions {
    std::string species, params, season;
    std::string radii; // carry, file; empty: not given
    EnvelopeOptions envelope;
    std::optional<std::int64_t> bodies;
    std::optional<std::uint64_t> seed;
    std::optional<double> age;
    bool leaves = false, petals = false, fruit = false, list_species = false;
};

void add_growth_options(OptionList&, GrowthOptions&);

// Throws UsageError where options contradict each other; with --import, of which only --leaves, --fruit and --radii go along.
void refuse_contradictions(const GrowthOptions&, bool import);

// Throws UsageError, or InputError for a file. What the user should know is added to the notes.
Splines grow_tree(const GrowthOptions&, const ImportChoice&, CommonOptions&);

} // namespace bough
