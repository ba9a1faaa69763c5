// node_role.h: what a node of a model file is for.
#pragma once
#include <cstdint>

namespace bough {

enum class NodeRole : std::uint8_t {
    open,   // a node without anything on it: a joint if the file does not say which are
    joint,  // the file says so (a skin's, COLLADA's JOINT)
    holder, // of a mesh, a camera, a light, an FBX Null: stands where it stands, is no joint
};

} // namespace bough
