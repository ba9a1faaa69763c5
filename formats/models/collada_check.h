// collada_check.h: what assimp takes on trust in a COLLADA file, to crash on it or to drop a mesh without a word; called in the child process that
// reads it.
//
// Of each <source>: its <float_array> has as many numbers as its count says, all finite. Of each <mesh> and <skin>: the indices of <p> and <v> are
// below the count of the source that their <input> names (a joint may be -1, the shape as it was bound), <vcount> takes as many as there are, and
// positions exist.
// No <node> holds itself, nor a million others, by <instance_node>. Elements with a prefix are left to assimp.
// Cost    O(bytes), memory some times the content.
// Errors  std::runtime_error: `geometry "Oak-mesh": ...`; broken XML is assimp's to tell of.
#pragma once
#include <string_view>

namespace bough {

void check_collada(std::string_view content);

} // namespace bough
