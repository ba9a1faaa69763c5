// inside.h: what files may reach that name other files. A scene or model that came from somewhere opens nothing but what came with it.
#pragma once
#include <set>
#include <string>

namespace bough {

// Whether `path`, which a file in `folder` names (a relative one from the working folder), is in that folder or below it: also when links are
// followed. What is not there yet counts as where it would be. A name that leads out by itself is refused before any file is asked. With
// may_reach_outside() always true.
bool within_reach(const std::string& path, const std::string& folder);

// What is said where it is not: "leads out of the folder of the file that names it; --outside lets it".
extern const char* const out_of_reach;

// Whether opening `path`, which a file names, waits for nobody: it is no pipe, socket or device. What is not there and a folder are left to
// the reader, which says so.
bool opens_at_once(const std::string& path);

// What is said where it would wait.
extern const char* const no_regular_file;

// The buffers and images that this process read since a file named them. No output may replace them. Any thread may add to them.
std::set<std::string> named_files_read();
void note_named_file(const std::string& path);

// Of this process, false unless the user says so (--outside). Set before anything is read.
bool& may_reach_outside();

} // namespace bough
