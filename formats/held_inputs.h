// held_inputs.h: a result that is made of one file must not be made of two: a file that is opened several times may be replaced in between.
#pragma once
#include "file_version.h"
#include <memory>
#include <string>

namespace bough {

// From here on a path that is opened as an input again must lead to the same file, unchanged. Called again, it forgets the paths before. A tool calls
// it for each result; off until then, as a caller of the library may write a file anew between two calls. O(1).
void hold_inputs(bool on = true);

// For who opens an input, a regular file. Throws InputError for a path that led to another file, or another version of it. O(log paths).
void require_held(const std::string& path, const FileVersion& opened);

// A pipe with a name ("/dev/fd/63" of a shell's <(...)) brings what it has once: it is kept for who opens that path again. Nothing of a path that is
// not held, and while inputs are not. O(log paths).
std::shared_ptr<const std::string> held_pipe(const std::string& path);
void hold_pipe(const std::string& path, const std::string& content);

} // namespace bough
