// skin_joint.h: which node a skin's bone is. assimp names it, and two armatures in one FBX or COLLADA file often have
// bones of the same names (two trees of one generator): of these it is the one that leaves the mesh nearest to where it stands.
#pragma once
#include "lib/base/math.h"
#include "node_role.h"
#include <string_view>
#include <unordered_map>
#include <vector>

namespace bough {

// Nodes in the order of their indices, each name's.
class NodesByName {
public:
    void add(std::string_view name); // the next node's; the text must outlive this
    std::int32_t first(std::string_view name) const;
    std::int32_t next(std::int32_t node) const { return next_[std::size_t(node)]; } // of the same name; -1: none

private:
    struct Ends {
        std::int32_t first, last;
    };
    std::unordered_map<std::string_view, Ends> of_;
    std::vector<std::int32_t> next_;
};

// world: of each node; offset: mesh to bone where both were bound; mesh: where the mesh's node stands. Of equally near
// nodes the first that no skin had before. -1: no node of that name. O(nodes of the name).
std::int32_t joint_of(const NodesByName&, std::string_view name, const std::vector<Eigen::Matrix4d>& world,
                      const std::vector<NodeRole>& role, const Eigen::Matrix4d& offset, const Eigen::Matrix4d& mesh);

} // namespace bough
