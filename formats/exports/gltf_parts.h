// gltf_parts.h: what the writers of a .glb share (private to gltf*.cpp, and vat_mesh.cpp): the JSON chunk as growing text, and the binary
// chunk as a list of what will be written, so that no array is held for it.
#pragma once
#include "gltf.h"
#include <functional>
#include <limits>

namespace bough {

enum class GltfType : int { u8 = 5121, s16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };
enum class GltfTarget : int { none = 0, vertices = 34962, indices = 34963 };

// Numbers gathered in a block and handed on when it is full.
class GltfBytes {
public:
    explicit GltfBytes(Output& output) : output_(output) { block_.reserve(block_size); }
    template <class Number> void add(Number value) {
        static_assert(std::is_arithmetic_v<Number>);
        block_.append(reinterpret_cast<const char*>(&value), sizeof value);
        if (block_.size() >= block_size) hand_on();
    }
    template <class... Numbers> void add_all(Numbers... values) { (add(values), ...); }
    void hand_on();
    std::uint64_t written() const { return written_ + block_.size(); }

private:
    static constexpr std::size_t block_size = std::size_t(1) << 16;
    Output& output_;
    std::string block_;
    std::uint64_t written_ = 0;
};

// Views and accessors numbered as they are added; views are laid out in that order, each from a multiple of 4.
class GltfFile {
public:
    using Write = std::function<void(GltfBytes&)>;
    // `write` adds exactly `bytes` bytes. stride 0: none stated.
    int add_view(std::uint64_t bytes, GltfTarget, int stride, Write write);
    // bounds: "" or ", \"min\": [...], \"max\": [...]".
    int add_accessor(int view, std::uint64_t offset, GltfType, std::uint64_t count, const char* type,
                     const std::string& bounds = "");
    // `rest`: what the JSON holds beside accessors, views and the buffer, without the outer braces.
    void write(Output&, const std::string& rest);
    std::uint64_t bytes(const std::string& rest) const; // of all of it

private:
    std::string json(const std::string& rest) const;

    struct View {
        std::uint64_t bytes;
        Write write;
    };
    std::vector<View> views_;
    int accessor_count_ = 0;
    std::uint64_t bytes_ = 0;
    std::string view_text_, accessor_text_;
};

// "asset"; source: of its extras, left out when empty.
std::string gltf_asset(const std::string& generator, const std::string& source);
// "[1, 2.5, 3]" with the shortest decimals that give the same number.
template <class Numbers> std::string gltf_list(const Numbers& numbers);
std::string gltf_bounds(const Eigen::Vector3f& low, const Eigen::Vector3f& high);

// ---- gltf_mesh.cpp ---- a primitive for each part of the skin, and "materials", as JSON; positions are written less `origin`.
// targets: of each part, what gltf_targets gives, or "".
std::vector<std::string> gltf_primitives(GltfFile&, const Skin&, const JointGroups&, const Vec3& origin,
                                         const std::vector<std::string>& targets);
// Vertices that a part's triangles use: the whole stretch from the first to the last of them.
struct VertexStretch {
    std::int32_t first = std::numeric_limits<std::int32_t>::max(), last = 0;
    std::uint64_t count() const { return std::uint64_t(last - first) + 1; }
};
VertexStretch vertices_of(const Skin&, const SkinPart&);
std::string gltf_materials(const Skin&);
std::string gltf_material(const std::string& part, const Vec3& srgb);

// ---- gltf_own.cpp ---- a mesh that came with the tree: its element of "meshes", and "materials" with all that they use.
std::string gltf_own_mesh(GltfFile&, const OwnMesh&, const JointGroups&, const Vec3& origin);
std::string gltf_own_materials(GltfFile&, const OwnMesh&);

// ---- gltf_leaves.cpp ---- leaves and petals as instances under the joints that bear them.
struct GltfLeaves {
    std::string materials, meshes, nodes; // elements of these arrays, each after a comma
    std::vector<std::string> children;    // of each group: the numbers of its nodes, with commas
};
// Nodes, meshes and materials are numbered from those given. A leaf's frame is scaled by (width, thickness, length).
GltfLeaves gltf_leaves(GltfFile&, const Tree&, const JointGroups&, const GroupFrames& drawn, int first_node,
                       int first_mesh, int first_material);

// ---- gltf_rods.cpp ---- each group's "extras", after a comma: what wood it holds, as own_rods.h has it.
std::vector<std::string> gltf_rods(const Tree&, const JointGroups&, const GroupFrames& drawn);

// ---- gltf_rustle.cpp ---- morph targets of the part that holds the clumps' leaves, after a comma; what their mesh says of them.
std::string gltf_targets(GltfFile&, const Skin&, const SkinPart&, const Rustle&);
std::string gltf_target_weights();

// ---- gltf_animation.cpp ---- the JSON of "animations", "" where there are no frames; joint j is node first_node + j.
// Places are written less `origin`. weights: of the morph targets of node weights_node, frame after frame; empty: none.
std::string gltf_animation(GltfFile&, const JointKeys&, const std::vector<RootPath>&, const Vec3& origin, double fps,
                           int first_node, const std::vector<float>& weights, int weights_node);

} // namespace bough
