// reduced_skin.h: a skin with fewer vertices: wood simplified, leaves thinned out.
//
// A piece is a leaf or petal, of a clump one of its leaves or sprays, as far as its triangles hang together, of at most 64 vertices. The
// simplifier would take leaves away until none are left; so of the pieces of a part some are left out, evenly in their order, and the others grow
// about where they are attached, up to twofold in length, so that their area together stays. All else is wood, which is simplified (simplified.h), to
// half of the vertices or the share that it had. Where the simplifier leaves more, as many pieces of wood as then fit are simplified, of the largest
// area, and the others are left out. A piece is what hangs together: a branch, as a rule. Vertices keep their UV, normals, and what moves them.
#pragma once
#include "lib/growth/skin.h"

namespace bough {

struct ReducedSkin {
    Skin skin;
    std::vector<std::int32_t> vertex;           // of each of its vertices the given skin's, rising
    double error = 0;                           // [m] of the simplifier
    std::size_t pieces = 0, kept = 0;           // leaves
    std::size_t wood_pieces = 0, wood_kept = 0; // 0, 0: all are kept, and were not counted
    double growth = 1;                          // [1] of the kept leaves' lengths, at most
};

// At most `most` vertices: the skin itself where it has no more. It ends above where the simplifier does with the largest piece of wood alone. Of a
// tree's skin in the drawn pose, whose parts have vertices of their own. O(triangles log triangles), some times.
ReducedSkin reduced_skin(const Skin&, const Tree&, std::size_t most);

} // namespace bough
