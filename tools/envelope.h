// envelope.h: treegen --envelope: its options, and the tree that they grow (lib/growth/colonize.h).
#pragma once
#include "common.h"
#include "import_file.h"
#include "lib/model/splines.h"
#include "option_list.h"

namespace bough {

struct EnvelopeOptions {
    std::string envelope; // --envelope: sphere, cone, box or a mesh file; empty: not wanted
    std::string size, tropism;
    std::optional<double> crown_base, influence, kill, step, leader, tip_radius;
    std::optional<std::int64_t> attractors;
    std::vector<std::pair<std::string, bool>> given() const; // each option but --envelope, and whether it was given
};

void add_envelope_options(OptionList&, EnvelopeOptions&);

struct EnvelopeRun {
    std::uint64_t seed = 0;
    bool leaves = false, fruit = false;
};

// Throws UsageError for options that contradict each other or are out of range, InputError for the mesh file. What the
// user should know is added to the common options' notes.
Splines grow_in_envelope(const EnvelopeOptions&, const ImportChoice&, const EnvelopeRun&, CommonOptions&);

} // namespace bough
