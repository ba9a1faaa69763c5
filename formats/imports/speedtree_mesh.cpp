#include "speedtree_mesh.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "speedtree_corners.h"
#include "speedtree_elements.h"
#include <algorithm>

namespace bough::speedtree {
namespace {

class MeshReader {
public:
    MeshReader(std::string_view content, const std::string& name, const std::vector<Bone>& bones,
               const Eigen::Affine3d& world, const Eigen::AlignedBox3d& within)
        : elements_(content, name), lines_(content), world_(world), within_(within) {
        for (std::size_t b = 0; b < bones.size(); ++b) bones_.emplace(bones[b].id, std::int32_t(b));
    }

    MeshFile read() {
        elements_.section("Materials", [this](const pugi::xml_node& node, const Fields& f) {
            file_.flip_opacity = f.integer(node, "FlipOpacity", 0) != 0;
        });
        elements_.each("Materials", "Material",
                       [this](const pugi::xml_node& node, const Fields& f) { read_material(node, f); });
        std::int32_t number = 0;
        elements_.each("Objects", "Object",
                       [&](const pugi::xml_node& node, const Fields& f) { read_object(node, number++, f); });
        elements_.each("Meshes", "Mesh", [this](const pugi::xml_node& node, const Fields& f) {
            for (const pugi::xml_node& lod : node.children("LOD")) read_lod(lod, f.integer(node, "ID"), f);
        });
        return std::move(file_);
    }

private:
    void read_material(const pugi::xml_node& node, const Fields& f) {
        MeshMaterial material;
        material.id = f.integer(node, "ID");
        material.name = valid_utf8(node.attribute("Name").value());
        material.two_sided = f.integer(node, "TwoSided", 0) != 0;
        for (const pugi::xml_node& map : node.children("Map")) {
            Map read;
            read.name = map.attribute("Name").value();
            read.line = lines_.line_of(f.offset(map));
            for (const pugi::xml_attribute& attribute : map.attributes())
                if (read.file.empty() && lower_case(attribute.name()).starts_with("file"))
                    read.file = trimmed(attribute.value());
            if (map.attribute("ColorR")) read.color = f.vector_of(map, "ColorR", "ColorG", "ColorB");
            if (map.attribute("Value")) read.value = f.number(map, "Value");
            material.maps.push_back(std::move(read));
        }
        if (!materials_.emplace(material.id, std::int32_t(file_.materials.size())).second)
            f.refuse(node, "ID " + std::to_string(material.id) + " is used twice, expected each once");
        file_.materials.push_back(std::move(material));
    }

    // -1 where the node or the file names none.
    std::int32_t material_of(const pugi::xml_node& node, const Fields& f) const {
        if (!node.attribute("Material") || materials_.empty()) return -1;
        const std::int64_t id = f.integer(node, "Material");
        const auto found = materials_.find(id);
        if (found == materials_.end() && id != -1)
            f.refuse(node, "Material " + std::to_string(id) + " does not exist, expected the ID of a Material");
        return found == materials_.end() ? -1 : found->second;
    }

    Corners read_triangles(const pugi::xml_node& node, std::size_t points, std::size_t records, const Fields& f) {
        Corners corners;
        corners.material = material_of(node, f);
        corners.point = f.indices(node, "PointIndices", points, "points");
        if (corners.point.size() % 3 != 0)
            f.refuse(node, "PointIndices holds " + counted(corners.point.size(), "index", "indices") +
                               ", expected three a triangle");
        if (node.child("VertexIndices")) {
            corners.record = f.indices(node, "VertexIndices", records, "vertices");
            f.expect_length(node, "VertexIndices", corners.record.size(), corners.point.size());
        } else if (records != points) {
            f.refuse(node, "has no VertexIndices, expected one for each corner, as there are " +
                               counted(points, "point", "points") + " and " + counted(records, "vertex", "vertices"));
        }
        return corners;
    }

    std::vector<Corners> all_triangles(const pugi::xml_node& node, std::size_t points, std::size_t records,
                                       const Fields& f) {
        std::vector<Corners> all;
        for (const pugi::xml_node& triangles : node.children("Triangles"))
            all.push_back(read_triangles(triangles, points, records, f));
        return all;
    }

    // The line is that of the largest coordinate's list.
    [[noreturn]] void refuse_far(const pugi::xml_node& list, const Vec3& file, const std::string& expected,
                                 const Fields& f) const {
        int axis = 0;
        file.cwiseAbs().maxCoeff(&axis);
        const std::string name(1, "XYZ"[axis]);
        f.refuse(list.name(), f.offset(list.child(name.c_str())),
                 name + " holds " + shown(file[axis]) + ", expected " + expected);
    }

    std::vector<Eigen::Vector3f> placed_points(const pugi::xml_node& list, const Vec3& origin, const Fields& f) const {
        std::vector<Eigen::Vector3f> points;
        for (const Vec3& p : f.points(list, "")) {
            const Vec3 at = world_ * Vec3(p + origin);
            if (!within_.contains(at))
                refuse_far(list, p,
                           "points near the skeleton: this one is at " + shown(at.x()) + ", " + shown(at.y()) + ", " +
                               shown(at.z()) + " m (x, y up, z)",
                           f);
            points.push_back(at.cast<float>());
        }
        return points;
    }

    // In the file's unit.
    std::vector<Eigen::Vector3f> mesh_points(const pugi::xml_node& list, const Fields& f) const {
        std::vector<Eigen::Vector3f> points;
        const double most = std::min(largest_length, largest_length / world_.linear().col(0).norm());
        for (const Vec3& p : f.points(list, "")) {
            if (!(p.cwiseAbs().maxCoeff() <= most)) refuse_far(list, p, "at most " + shown(most), f);
            points.push_back(p.cast<float>());
        }
        return points;
    }

    void read_object(const pugi::xml_node& node, std::int32_t number, const Fields& f) {
        if (!node.child("Triangles")) return;
        const Vec3 origin = f.vector(node, "Abs", Vec3::Zero());
        std::vector<Eigen::Vector3f> points;
        if (const pugi::xml_node list = node.child("Points")) points = placed_points(list, origin, f);
        Records records = read_records(node.child("Vertices"), points.size(), bones_, f);
        const std::vector<Corners> all = all_triangles(node, points.size(), records.count, f);
        fill_bones(points.size(), all, records);
        for (const Corners& corners : all) {
            if (corners.point.empty()) continue;
            file_.surface.push_back(surface_of(points, records, corners, world_.linear()));
            file_.surface.back().object = number;
        }
    }

    // Triangles and quads of one list of vertices; or, as objects have them, by material.
    void read_lod(const pugi::xml_node& lod, std::int64_t mesh, const Fields& f) {
        const pugi::xml_node vertices = lod.child("Vertices"), other = lod.child("Points");
        if (!vertices && !other) return;
        const std::vector<Eigen::Vector3f> points = mesh_points(other ? other : vertices, f);
        Shape shape;
        shape.mesh = mesh;
        shape.level = f.integer(lod, "Level", 0);
        const Records records = read_records(vertices, points.size(), {}, f);
        if (!other && records.count != points.size())
            f.refuse(vertices, "has " + counted(points.size(), "position", "positions") + ", expected " +
                                   std::to_string(records.count));
        std::vector<Corners> all = all_triangles(lod, points.size(), records.count, f);
        Corners plain;
        plain.point = f.indices(lod, "TriangleIndices", points.size(), "vertices");
        if (plain.point.size() % 3 != 0)
            f.refuse(lod, "TriangleIndices holds " + counted(plain.point.size(), "index", "indices") +
                              ", expected three a triangle");
        const std::vector<std::int32_t> quad = f.indices(lod, "QuadIndices", points.size(), "vertices");
        if (quad.size() % 4 != 0)
            f.refuse(lod, "QuadIndices holds " + counted(quad.size(), "index", "indices") + ", expected four a quad");
        for (std::size_t k = 0; k < quad.size(); k += 4)
            plain.point.insert(plain.point.end(),
                               {quad[k], quad[k + 1], quad[k + 2], quad[k], quad[k + 2], quad[k + 3]});
        if (!plain.point.empty()) all.push_back(std::move(plain));
        for (const Corners& corners : all)
            if (!corners.point.empty()) shape.surface.push_back(surface_of(points, records, corners, Mat3::Identity()));
        if (!shape.surface.empty()) file_.shape.push_back(std::move(shape));
    }

    const Elements elements_;
    LineCounter lines_;
    const Eigen::Affine3d world_;
    const Eigen::AlignedBox3d within_;
    IndexOf bones_, materials_;
    MeshFile file_;
};

} // namespace

MeshFile parse_mesh(std::string_view content, const std::string& name, const std::vector<Bone>& bones,
                    const Eigen::Affine3d& world, const Eigen::AlignedBox3d& within) {
    return MeshReader(content, name, bones, world, within).read();
}

bool has_mesh(std::string_view content) {
    const std::size_t objects = content.find("<Objects");
    if (objects == std::string_view::npos) return false;
    const std::size_t triangles = content.find("<PointIndices", objects);
    return triangles != std::string_view::npos && triangles < content.find("</Objects", objects);
}

} // namespace bough::speedtree
