// stands.h: trees that share blocks of the layout (layout.h), and between which a scene may be cut without a sum's order changing.
//
// A stand is trees one after another until they have smallest_stand bodies; the next root begins the next stand. (A tree is here a root's; a document
// may have several.) The stands from a stand's first body on are the same, whatever was before it.
#pragma once
#include <cstddef>

namespace bough::fast {

constexpr std::size_t smallest_stand = 256;

} // namespace bough::fast
