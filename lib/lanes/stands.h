// stands.h: trees that share blocks of the layout (layout.h), and between which a scene may be cut without a sum's order changing.
//
// A stand is trees one after another (here a tree is a root's, a document may have several) until they have smallest_stand bodies; the next root
// begins the next. What begins at a stand's first body has the same stands, whatever was before it.
#pragma once
#include <cstddef>

namespace bough::fast {

constexpr std::size_t smallest_stand = 256;

} // namespace bough::fast
