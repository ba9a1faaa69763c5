#include "speedtree_leaves.h"
#include "lib/base/angles.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>
#include <unordered_map>

namespace bough::speedtree {
namespace {

Mat3 rotation(const Vec3& axis, double degrees) {
    if (degrees == 0) return Mat3::Identity();
    return Eigen::AngleAxisd(degrees * degree, axis.normalized()).toRotationMatrix();
}

// Axes from the directions of length and normal; x completes them to a right-handed frame.
Mat3 axes_from(const Vec3& length, const Vec3& normal) {
    Mat3 m;
    m.col(0) = normal.cross(length);
    m.col(1) = normal;
    m.col(2) = length;
    return m;
}

LeafShape default_shape() {
    return {axes_from(Vec3::UnitY(), Vec3::UnitZ()), 1, 0.5};
}

} // namespace

std::optional<LeafShape> shape_of(const Mesh& mesh) {
    const Vec3 reach = mesh.low.cwiseAbs().cwiseMax(mesh.high.cwiseAbs()), extent = mesh.high - mesh.low;
    // y first: leaf meshes grow along it where nothing else decides.
    int length = 1;
    for (const int k : {2, 0})
        if (reach[k] > reach[length] * (1 + 1e-6)) length = k;
    const std::array<int, 2> across = length == 0   ? std::array{1, 2}
                                      : length == 1 ? std::array{0, 2}
                                                    : std::array{0, 1};
    const bool first_is_wider = extent[across[0]] >= extent[across[1]];
    const int width = across[first_is_wider ? 0 : 1], normal = across[first_is_wider ? 1 : 0];
    if (!(reach[length] > 0) || !(extent[width] > 0)) return {};
    const double sign = mesh.high[length] >= -mesh.low[length] ? 1 : -1;
    return LeafShape{axes_from(sign * Vec3::Unit(length), Vec3::Unit(normal)), reach[length], extent[width], mesh.area,
                     mesh.pieces};
}

std::vector<ImportedLeaf> leaves_of(const File& file, const std::vector<std::int32_t>& branch_of, ImportNotes& notes) {
    std::unordered_map<std::int64_t, LeafShape> shapes;
    for (const Mesh& mesh : file.meshes)
        if (const auto shape = shape_of(mesh)) shapes.emplace(mesh.id, *shape);
    std::vector<ImportedLeaf> leaves;
    leaves.reserve(file.leaves.size());
    std::size_t shapeless = 0;
    for (std::size_t i = 0; i < file.leaves.size(); ++i) {
        const LeafReference& reference = file.leaves[i];
        const auto found = shapes.find(reference.mesh);
        shapeless += found == shapes.end();
        const LeafShape shape = found == shapes.end() ? default_shape() : found->second;
        ImportedLeaf leaf;
        leaf.branch = branch_of[i];
        leaf.position = reference.position;
        leaf.axes = rotation(reference.axis, reference.angle) * shape.axes;
        leaf.length = reference.scale * shape.length;
        leaf.width = reference.scale * shape.width;
        leaf.area = reference.scale * reference.scale * shape.area;
        leaf.pieces = shape.pieces;
        leaves.push_back(leaf);
    }
    if (file.leaves_without_size > 0)
        notes.lines.push_back(counted(file.leaves_without_size, "leaf", "leaves") + " of Scale 0 left out");
    if (shapeless > 0)
        notes.lines.push_back(counted(shapeless,
                                      "leaf without a mesh of any extent: taken as long as its Scale and half as wide",
                                      "leaves without a mesh of any extent: taken as long as their Scale and half as "
                                      "wide"));
    return leaves;
}

} // namespace bough::speedtree
