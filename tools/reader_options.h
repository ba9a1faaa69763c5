// reader_options.h: --reader-memory, --reader-seconds and --outside: what a file that is read may take (formats/models/reader_limits.h) and
// reach (formats/inside.h). They hold for the whole process.
#pragma once
#include "option_list.h"

namespace bough {

void add_reader_options(OptionList&);

} // namespace bough
