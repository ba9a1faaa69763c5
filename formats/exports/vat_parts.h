// vat_parts.h: the mesh at rest that goes with a vertex animation texture (private to vat*.cpp).
#pragma once
#include "vat.h"

namespace bough {

// A .glb of one node. height: of the texture [pixels].
void write_vat_mesh(Output&, const std::string& name, const ReducedSkin&, const VatLook&, std::size_t height,
                    const VatOptions&);

} // namespace bough
