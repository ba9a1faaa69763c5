// treeprofile: what a run costs, stage by stage, and whether it has become slower. The first word chooses the subcommand.
#include "exits.h"
#include "profile.h"
#include <filesystem>
#include <iostream>

namespace {

using namespace bough;

const ToolInfo info = {
    profile_name,
    "Measures what each stage of a simulation costs, how wrong it is and what that costs; `compare` finds what became\n"
    "slower.\n"
    "Usage: treeprofile [stages] TREE|SCENE [--report FILE.json|FILE.csv] [treesim's run options]\n"
    "       treeprofile error TREE|SCENE [--steps LIST] [--report FILE.json|.csv|.svg|.html] [treesim's run options]\n"
    "       treeprofile stability TREE|SCENE [--frames N] [--only TEXT] [--report FILE.json|.csv|.svg|.html]\n"
    "       treeprofile modes TREE|SCENE [--modes N] [--wind NAME] [--report FILE.json|.csv|.svg] [-o SWINGING.glb]\n"
    "       treeprofile scaling [--bodies LIST] [--shape LIST] [--threads LIST] [--wind NAME] [--report FILE]\n"
    "       treeprofile compare OLD.json NEW.json [--fail-above 1.1]",
    "stages is what runs unless another of these is the first word. Nothing is written while it measures. The first "
    "frame "
    "after\n"
    "the start is left out as a warm-up; of --repeat runs the fastest counts.\n"
    "error runs each solver at each number of steps a frame against a reference solution of the articulated dynamics.\n"
    "stability runs a grid of extreme cases and exits with 3 where a promised one does not hold.\n"
    "modes finds the lowest natural frequencies, their damping and who moves in them.\n"
    "scaling measures ns a body and frame over the number of bodies, beside what the machine can do at most.\n"
    "compare exits with 3 when the total, or a stage that had at least 5 % of it, costs more than --fail-above times\n"
    "what it did. Reports of different bodies, precision, solver, scheme or substeps are refused (2).\n"
    "Exit: 0 done, 1 usage, 2 bad input, 3 non-finite, slower or a promise broken, 4 output not written, 130 "
    "interrupted.",
    {}};

// A word that can only be meant as a subcommand's name: letters alone, and no file is called so.
bool is_no_file(const std::string& word) {
    std::error_code none;
    return !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos &&
           !std::filesystem::exists(word, none);
}

} // namespace

int main(int argc, char** argv) {
    CommonOptions common;
    const std::vector<Subcommand> subcommands = {profile_stages(common),    profile_error(common),
                                                 profile_stability(common), profile_modes(common),
                                                 profile_scaling(common),   profile_compare(common)};
    // A tree is never called like a subcommand by accident, because ./compare is another word.
    const std::string word = argc > 1 ? argv[1] : "";
    std::vector<char*> arguments(argv, argv + argc);
    const Subcommand* chosen = &subcommands.front(); // also without a word
    for (const Subcommand& subcommand : subcommands)
        if (word == subcommand.name) {
            chosen = &subcommand;
            arguments.erase(arguments.begin() + 1);
        }
    if (chosen == &subcommands.front() && word != chosen->name && is_no_file(word)) {
        std::string names;
        for (const Subcommand& subcommand : subcommands)
            names += (names.empty() ? "" : ", ") + std::string(subcommand.name);
        std::cerr << profile_name << ": '" << word << "' is neither a file nor one of " << names << "; see "
                  << profile_name << " --help\n";
        return exit_usage;
    }
    ToolInfo own = info;
    own.has_source = chosen->has_source;
    own.has_threads = chosen->has_threads;
    own.has_input = chosen->has_input;
    return run_tool(own, int(arguments.size()), arguments.data(), common, chosen->declare, chosen->work);
}
