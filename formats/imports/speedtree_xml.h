// speedtree_xml.h: SpeedTree raw XML as plain arrays, nothing interpreted: positions are as in the file (spines and
// surface points already moved by their object's Abs), in its unit and axes.
#pragma once
#include "lib/base/math.h"
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bough::speedtree {

struct Object {
    std::int64_t id = 0;
    std::int32_t parent = -1; // index, -1: none (no ParentID, or -1)
    std::string name;
    std::vector<Vec3> spine;          // empty: the object has no Spine
    std::vector<double> spine_radius; // in a scale of its own, 0: the file gives none
    std::vector<Vec3> surface;        // some points of the bark, only read where the file has no bones
    std::size_t line = 0;
};

struct Bone {
    std::int64_t id = 0;
    std::int32_t parent = -1; // index, -1: root
    Vec3 start = Vec3::Zero(), end = Vec3::Zero();
    double radius = 0;    // at the start; 0: the file gives none
    double tip = 0;       // radius where a branch ends with it; 0: as the taper goes on
    bool has_end = false; // from the file, later completed
    std::string generator;
    std::size_t line = 0;
};

constexpr std::int64_t no_material = std::numeric_limits<std::int64_t>::min();

struct LeafReference {
    std::int32_t object = -1;            // that holds it
    std::int32_t bone = -1;              // index, -1: none
    std::int64_t mesh = -1;              // ID, -1: none
    std::int64_t lod = 0;                // Level of that mesh
    std::int64_t material = no_material; // ID, of a mesh that names none itself
    Vec3 position = Vec3::Zero(), axis = Vec3::Zero();
    double angle = 0; // [deg] about axis
    double scale = 1;
    std::size_t offset = 0; // of its LeafReferences in the file
};

struct Mesh {
    std::int64_t id = 0;
    // Of its first level of detail that has vertices: bounds, and what its triangles are (mesh_measure.h).
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    double area = 0;
    std::int32_t pieces = 0;
};

struct File {
    std::vector<Object> objects;
    std::vector<Bone> bones;
    std::vector<LeafReference> leaves;
    std::size_t leaves_without_size = 0; // of Scale 0, not among them
    std::vector<Mesh> meshes;
    std::optional<double> unit; // [m] attribute `units` of the root, if present
    char up = 0;                // attribute `upAxis`, if present
    std::string version, source;
    bool has_spines() const;
};

// Throws InputError FILE:LINE for broken XML, for a missing or wrong number, lists of unequal length or another length
// than their Count, ids that are used twice or do not exist, and cycles of parents. O(size of the file).
File parse(std::string_view content, const std::string& name);

} // namespace bough::speedtree
