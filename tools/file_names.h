// file_names.h: names of files as options give them; - is stdin or stdout.
#pragma once
#include <string>
#include <vector>

namespace bough {

bool same_file(const std::string& one, const std::string& other); // two names of one file; - is none

// Throws UsageError where an output is one of the inputs, another kind of file that would be lost. Empty names and - are
// none.
struct NamedFile {
    std::string option, file; // "--skin", "oak.glb"
};
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// The ending of a file's name in lower case, ".glb", or "".
std::string ending(const std::string& path);

// An argument as a shell takes it, on one line: quoted where it has to be.
std::string in_shell(const std::string& argument);

} // namespace bough
