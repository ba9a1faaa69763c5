#define main treesim_main
#include "tools/treesim.cpp"
#undef main
#include "options.h"

int bough::fuzzing::treesim_words(int argc, char** argv) {
    TreesimOptions o;
    const auto checked = [&o] {
        o.report = chosen_reports(o.reports);
        chosen_fields(o);
        bough::refuse_contradictions(o, o.no_output ? "" : chosen_format(o.common));
        chosen_scene(o.run);
    };
    const auto join_checked = [&o] { chosen_format(o.common); };
    return read_words({{"", treesim_info, [&o](OptionList& list) { declare(list, o); }, checked},
                       {"join", join_info, [&o](OptionList& list) { declare_join(list, o); }, join_checked}},
                      argc, argv, o.common);
}
