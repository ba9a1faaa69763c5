// simplified.h: fewer vertices of a mesh, by meshoptimizer's simplifier (edges that cost least by quadrics collapse).
//
// Where that leaves too many, as of many pieces, vertices that are near to each other become one of them, across pieces: while the error is 1 % of
// the mesh's size at most. (At 2 % a maple's trunk fell to pieces.)
// Its vertices are some of the mesh's own, as they are: positions, UV, colours, and what moves them. Seams of UV collapse along themselves.
#pragma once
#include "lib/base/math.h"
#include <array>
#include <vector>

namespace bough {

struct Simplified {
    std::vector<std::array<std::int32_t, 3>> triangle; // over the mesh's vertices, in its order of triangles
    std::vector<std::int32_t> vertex;                  // those that are used, rising
    double error = 0; // [m] that the simplifier counts: a root mean square, at its worst edge
};

// As many triangles as leave at most `most` vertices: all where they do. whole: pieces stay apart. Fewer are reached than a mesh's own pieces allow:
// where the simplifier ends above `most`, so many are given. O(triangles log triangles), some times. Throws std::length_error beyond 2^32 - 1
// vertices.
Simplified simplified(const std::vector<Vec3>& position, const std::vector<std::array<std::int32_t, 3>>& triangle,
                      std::size_t most, bool whole = false);

} // namespace bough
