#include "reader_options.h"
#include "formats/inside.h"
#include "formats/models/reader_limits.h"

namespace bough {

void add_reader_options(OptionList& list) {
    ReaderChoice& choice = reader_choice();
    list.add("--reader-memory", choice.megabytes,
             "Memory that reading an FBX, COLLADA or OBJ model may take [MB] (1000 and 64 for each of the file's, "
             "at most three quarters of what is free)")
        .takes("MB")
        .check(whole_number(1, std::int64_t(1) << 40));
    list.add("--reader-seconds", choice.seconds,
             "Processor time that it may take [s] (120 and 1 for each MB of the file)")
        .takes("S")
        .check(whole_number(1, std::int64_t(1) << 30));
    list.add_flag(
        "--outside", may_reach_outside(),
        "Files that an input names (a scene's trees, a model's buffers and textures) may stand outside its folder");
}

} // namespace bough
