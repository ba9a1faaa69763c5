// file_names.h: names of files as options give them; - is stdin or stdout.
#pragma once
#include <string>
#include <vector>

namespace bough {

// Whether what is written to `output` would replace what `input` names, under whatever name: links are followed; - is stdin (a regular file
// may stand behind it) and stdout. A pattern of a sequence (x_%04d.obj) stands for all its files.
bool same_file(const std::string& input, const std::string& output);

// Whether the output ends up on a disk, stdout too where a shell leads it into a file. Pipes and devices are none.
bool is_kept(const std::string& output);

// Throws UsageError where an output is one of the inputs, another kind of file that would be lost. Empty names are none.
struct NamedFile {
    std::string option, file; // "--skin", "oak.glb"
};
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// The same of the buffers and images that a model names (formats/inside.h), once it has been read.
void refuse_overwriting_the_model(const std::vector<NamedFile>& written);

// The same of the images that are written into a folder beside the output of -o. `named`: what is read (- is stdin), and the other
// outputs that are files. Throws OutputError where an image, or its folder, cannot be written.
void refuse_overwriting_by_images(const std::vector<NamedFile>& named, const std::vector<std::string>& images);

// Before the work: throws UsageError where two outputs are one file, and OutputError where one cannot be written, as in a folder that is not
// there. Empty names are none; a pattern stands for all its files, and is tried with its number 0.
void require_outputs(const std::vector<NamedFile>& written);

// The ending of a file's name in lower case, ".glb", or "".
std::string ending(const std::string& path);

} // namespace bough
