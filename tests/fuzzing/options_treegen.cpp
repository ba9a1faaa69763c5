#define main treegen_main
#include "tools/treegen.cpp"
#undef main
#include "options.h"

int bough::fuzzing::treegen_words(int argc, char** argv) {
    Options o;
    return read_words({{"", info, [&o](OptionList& list) { declare(list, o); }, [&o] { refuse_contradictions(o); }}},
                      argc, argv, o.common);
}
