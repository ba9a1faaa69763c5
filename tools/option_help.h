// option_help.h: what a tool says of itself, in the forms that people and shells read. One table of options is the source of all: --help and
// --help-all (80 columns), the manual page, and completions for bash, zsh and fish.
#pragma once
#include <string>
#include <vector>

namespace bough {

struct OptionHelp {
    std::string group;               // "Wind"; options of one group stand together
    std::vector<std::string> names;  // "-o", "--output"; of an argument "INPUT"
    std::string takes;               // "FILE"; empty: a flag
    std::string text;                // what it does
    std::vector<std::string> values; // names that it takes, if these are all or the best known
    bool first = true;               // shown by --help, not by --help-all alone
};

// Of one command, which is a tool or one of its sub-commands.
struct HelpPage {
    std::string command;               // "treeprofile error"
    std::string about;                 // one sentence
    std::string usage;                 // as it is typed, a line each
    std::string details;               // paragraphs
    std::string examples;              // as they are typed, a line each
    std::vector<OptionHelp> options;   // in the order in which they are shown
    std::vector<std::string> commands; // sub-commands, if it has any
};

// Lines of at most 80 columns, but where a word of usage or examples is longer. `all`: with the options that --help leaves out.
std::string help_text(const HelpPage&, bool all);
// For man, in the macros of man(7). `version`: of the program, "0.1.0".
std::string manual_page(const HelpPage&, const std::string& version);
// For a shell, "bash", "zsh" or "fish": of a tool and its sub-commands, the tool's own page first.
std::string completion(const std::vector<HelpPage>&, const std::string& shell);

} // namespace bough
