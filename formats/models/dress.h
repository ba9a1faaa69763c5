// dress.h: a tree with the leaves and the bark of its species, as a mesh with materials (own_mesh.h).
//
// Bark, fruit: build_skin's. Each leaf, or each leaf of a clump, is its species' blade (lib/growth/blade.h) at its place, of its body's area: as a
// mesh, or as a card whose picture's alpha cuts it out. A clump as cards is some sprays of leaves, one at least. A spray shows six leaves. Where all
// of a tree's clumps together would be more than `sprays` of them, each stands for more leaves and is larger, of one size all over the crown. A clump
// three times as long as wide, a willow's strand, is three leaves in place of each spray (one where `sprays` is said), so that it is in leaf along
// all of its length.
// Where the twigs of the species hang, sprays hang in strands, a row of up to four one below another.
// Its alpha's cutoff is such that thin leaves do not vanish from afar. Petals stay kites. Leaves are moved by their own bodies alone.
#pragma once
#include "formats/exports/own_mesh.h"
#include "lib/growth/species.h"

namespace bough {

enum class LeafDetail : std::uint8_t { kite, card, mesh };

struct DressOptions {
    LeafDetail detail = LeafDetail::card;
    int textures = 512;            // [pixels] sides of pictures; 0: none, parts have one colour each
    int sides = 12;                // SkinOptions
    std::int64_t sprays = 0;       // of all clumps together, as cards; 0: as many as bodies, 5500 at least
    std::int64_t clump_leaves = 0; // of all clumps together, else; 0: clump.h's
};

// The tree's own colours; of the species the forms of leaf and bark. O(bodies + pixels). Throws std::length_error as build_skin does.
OwnMesh dress(const Tree&, const Species&, const DressOptions&);

} // namespace bough
