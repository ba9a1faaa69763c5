// fbx_check.h: what assimp takes on trust in a binary FBX file, to crash on it or to drop a mesh without a word; called in the child process that
// reads it.
//
// The records lie within the file and within one another. Of each Geometry: Vertices and what its layers hold are finite, PolygonVertexIndex names
// vertices that are there (its last corner of a polygon as -1 - index). Of each Deformer: Indexes names vertices that some Geometry has, Weights has
// as many numbers, they and the matrices are finite. FBX as text is left to assimp.
// Cost    O(bytes, unpacked), memory that of the largest array.
// Errors  std::runtime_error: `geometry "Oak": ...`.
#pragma once
#include <string_view>

namespace bough {

void check_fbx(std::string_view content);

} // namespace bough
