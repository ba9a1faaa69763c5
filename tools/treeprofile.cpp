// treeprofile: what a run costs, stage by stage, how wrong it is, and whether it has become slower. The first word chooses the sub-command.
#include "profile.h"

int main(int argc, char** argv) {
    using namespace bough;
    CommonOptions common;
    return run_tool({profile_stages(common), profile_error(common), profile_stability(common), profile_modes(common),
                     profile_scaling(common), profile_compare(common)},
                    argc, argv, common);
}
