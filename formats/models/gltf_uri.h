// gltf_uri.h: the bytes that a glTF file's URI names: a data: URI's own, or those of a file beside it.
#pragma once
#include <string>

namespace bough {

// The file that a URI names, with links followed, so that two spellings of one file are equal; "" for a data: URI. One
// that is not read, as it leads out of the folder, stays as it is spelt.
std::string place_of_uri(const std::string& uri, const std::string& folder);

// True for an address, and for a path that leads out of the folder (inside.h): what is not read, and is named in no output.
bool leads_out(const std::string& uri, const std::string& folder);

// A relative URI may have %XX escapes. Throws std::runtime_error: not there, no folder, a path or an address that is not relative, base64 that
// is none.
std::string bytes_of_uri(const std::string& uri, const std::string& folder);

} // namespace bough
