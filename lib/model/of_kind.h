// of_kind.h: what a list of one value for each kind says of a body.
#pragma once
#include "kind.h"

namespace bough {

// Of: has branch, leaf, petal and fruit. For clump and tuft it gives the value of a leaf, whoever asks: loads, wood, fracture. No checked tree has
// these kinds: check() refuses them, and a body that stands for several leaves is a leaf or a petal. Only the air sees it as a clump (kind.h).
template <class Of> const auto& of_kind(const Of& of, Kind kind) {
    switch (kind) {
    case Kind::leaf:
    case Kind::clump:
    case Kind::tuft:
        return of.leaf;
    case Kind::petal:
        return of.petal;
    case Kind::fruit:
        return of.fruit;
    case Kind::branch:
        break;
    }
    return of.branch;
}

} // namespace bough
