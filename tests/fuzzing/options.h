// options.h: the command lines of the tools, read as they read them; what they would do then is left out. Each: its exit code.
#pragma once
#include "tools/tool.h"

namespace bough::fuzzing {

int read_words(const std::vector<Subcommand>&, int argc, char** argv, CommonOptions&); // options.cpp
int treegen_words(int argc, char** argv);
int treeconvert_words(int argc, char** argv);
int treesim_words(int argc, char** argv);
int treeprofile_words(int argc, char** argv);

} // namespace bough::fuzzing
