// of_kind.h: what a list of one value for each kind says of a body. Bodies that stand for several leaves are as leaves.
#pragma once
#include "kind.h"

namespace bough {

// Of: has branch, leaf, petal and fruit.
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
