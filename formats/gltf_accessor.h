// gltf_accessor.h: numbers of a glTF document's accessors (private to formats/).
#pragma once
#include "gltf_document.h"

namespace bough {

// The values of a SCALAR accessor: of any component type, normalized ones from -1 or 0 to 1, sparse ones put in their
// places, all 0 where it has no view. O(count). Throws std::out_of_range: another type, bytes that are not there, a view
// in a form that is not decoded here. Throws Json exceptions for types that are wrong.
std::vector<double> scalars_of(const GltfDocument&, std::size_t accessor);

} // namespace bough
