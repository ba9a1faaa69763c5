// common.h: the options that every tool has, and what follows from them alone.
#pragma once
#include "exits.h"
#include "formats/open.h"
#include <string>
#include <vector>

namespace bough {

struct CommonOptions {
    bool quiet = false;             // -q: no notes, no progress
    int threads = 0;                // --threads; as many as the machine has unless given
    std::string output = "-";       // -o
    std::string format;             // --format; empty: by the output's name
    bool source = true;             // --no-source: the output does not carry the command line
    std::string command_line;       // of this run, quoted for a shell
    std::vector<std::string> notes; // what the user should know once the run has succeeded
};

// The form of a document: --format, else the ending of the output's name. Throws UsageError for the ending of a mesh or
// motion, which the tool does not write there.
Form chosen_form(const CommonOptions&);

// `before` with this run's command line as one more line, or unchanged with --no-source.
std::string with_command_line(const std::string& before, const CommonOptions&);

} // namespace bough
