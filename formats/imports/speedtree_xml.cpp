#include "speedtree_xml.h"
#include "formats/plain_text.h"
#include "imported_tree.h"
#include "mesh_measure.h"
#include "speedtree_elements.h"
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace bough::speedtree {
namespace {

using Index = std::unordered_map<std::int64_t, std::int32_t>;

// Where an element stands in the file, and the parent it names.
struct Link {
    std::size_t offset;
    std::int64_t parent;
};

Link link_of(const pugi::xml_node& node, const Fields& f) {
    return {f.offset(node), f.integer(node, "ParentID", -1)};
}

// Turns ParentIDs into indices and refuses missing parents and cycles. -1 is a root.
template <class T>
void link_parents(std::vector<T>& items, const std::vector<Link>& links, const Index& index, const char* element,
                  const Fields& f) {
    std::vector<std::int32_t> parent(items.size(), -1);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::int64_t id = links[i].parent;
        if (id == -1) continue;
        const auto found = index.find(id);
        if (found == index.end())
            f.refuse(element, links[i].offset,
                     "ParentID " + std::to_string(id) + " does not exist, expected the ID of another or -1");
        items[i].parent = parent[i] = found->second;
    }
    const std::int32_t cycle = parents_first(parent).cycle;
    if (cycle >= 0) f.refuse(element, links[cycle].offset, "is its own ancestor, expected a tree");
}

void add_id(Index& index, std::int64_t id, std::size_t at, const pugi::xml_node& node, const Fields& f) {
    if (!index.emplace(id, std::int32_t(at)).second)
        f.refuse(node, "ID " + std::to_string(id) + " is used twice, expected each once");
}

void expect_count(const pugi::xml_node& node, std::size_t found, const Fields& f) {
    const std::int64_t count = f.integer(node, "Count", std::int64_t(found));
    if (count != std::int64_t(found))
        f.refuse(node, "says Count " + std::to_string(count) + " but holds " + std::to_string(found));
}

Bone parse_bone(const pugi::xml_node& node, const Fields& f) {
    Bone bone;
    bone.id = f.integer(node, "ID");
    bone.start = f.vector(node, "Start");
    bone.has_end = node.attribute("EndX") || node.attribute("EndY") || node.attribute("EndZ");
    if (bone.has_end) bone.end = f.vector(node, "End");
    bone.radius = f.number(node, "Radius", 0);
    if (bone.radius < 0) f.refuse(node, "Radius is " + shown(bone.radius) + ", expected 0 or more");
    bone.generator = node.attribute("Generator").value();
    return bone;
}

Index parse_bones(const Elements& elements, const Fields& f, File& file) {
    Index index;
    std::vector<Link> links;
    elements.each("Bones", "Bone", [&](const pugi::xml_node& node, const Fields& of_node) {
        file.bones.push_back(parse_bone(node, of_node));
        add_id(index, file.bones.back().id, links.size(), node, of_node);
        links.push_back(link_of(node, of_node));
    });
    elements.section("Bones", [&](const pugi::xml_node& bones, const Fields& of_bones) {
        expect_count(bones, links.size(), of_bones);
    });
    link_parents(file.bones, links, index, "Bone", f);
    return index;
}

void parse_spine(const pugi::xml_node& node, const Vec3& origin, const Fields& f, Object& object) {
    object.spine = f.points(node, "");
    expect_count(node, object.spine.size(), f);
    for (Vec3& p : object.spine) p += origin;
    object.spine_radius = f.numbers(node, "Radius");
    if (!node.child("Radius")) object.spine_radius.assign(object.spine.size(), 0);
    f.expect_length(node, "Radius", object.spine_radius.size(), object.spine.size());
    for (const double r : object.spine_radius)
        if (r < 0) f.refuse(node, "Radius holds " + shown(r) + ", expected 0 or more");
}

// At most 64 points, evenly picked: enough for a median.
void parse_surface(const pugi::xml_node& node, const Vec3& origin, const Fields& f, Object& object) {
    const std::vector<Vec3> points = f.points(node, "");
    const std::size_t stride = 1 + points.size() / 64;
    for (std::size_t i = 0; i < points.size(); i += stride) object.surface.push_back(points[i] + origin);
}

void parse_leaves(const pugi::xml_node& node, std::int32_t object, const Index& bones, const Fields& f, File& file) {
    const std::vector<Vec3> position = f.points(node, ""), axis = f.points(node, "RotAxis");
    const std::vector<double> angle = f.numbers(node, "RotAngle"), scale = f.numbers(node, "Scale");
    const std::vector<std::int64_t> mesh = f.integers(node, "MeshID"), bone = f.integers(node, "BoneID"),
                                    lod = f.integers(node, "MeshLOD");
    const std::int64_t material = f.integer(node, "Material", no_material);
    const std::size_t n = position.size(), offset = f.offset(node);
    expect_count(node, n, f);
    f.expect_length(node, "RotAxisX", axis.size(), n);
    f.expect_length(node, "RotAngle", angle.size(), n);
    f.expect_length(node, "Scale", scale.size(), n);
    if (node.child("MeshID")) f.expect_length(node, "MeshID", mesh.size(), n);
    if (node.child("MeshLOD")) f.expect_length(node, "MeshLOD", lod.size(), n);
    if (node.child("BoneID")) f.expect_length(node, "BoneID", bone.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
        LeafReference leaf;
        leaf.object = object;
        leaf.position = position[i];
        leaf.axis = axis[i];
        leaf.angle = angle[i];
        leaf.scale = scale[i];
        if (!mesh.empty()) leaf.mesh = mesh[i];
        if (!lod.empty()) leaf.lod = lod[i];
        leaf.material = material;
        leaf.offset = offset;
        if (scale[i] < 0) f.refuse(node, "Scale holds " + shown(scale[i]) + ", expected 0 or more");
        if (scale[i] == 0) {
            ++file.leaves_without_size;
            continue;
        }
        if (axis[i].squaredNorm() <= 0 && angle[i] != 0)
            f.refuse(node, "turns leaf " + std::to_string(i) + " about an axis of no length");
        if (!bone.empty() && bone[i] != -1 && !file.bones.empty()) {
            const auto found = bones.find(bone[i]);
            if (found == bones.end())
                f.refuse(node,
                         "BoneID " + std::to_string(bone[i]) + " does not exist, expected the ID of a Bone or -1");
            leaf.bone = found->second;
        }
        file.leaves.push_back(leaf);
    }
}

void parse_objects(const Elements& elements, const Index& bones, const Fields& f, File& file) {
    Index index;
    std::vector<Link> links;
    elements.each("Objects", "Object", [&](const pugi::xml_node& node, const Fields& of_node) {
        Object object;
        object.id = of_node.integer(node, "ID");
        object.name = node.attribute("Name").value();
        const Vec3 origin = of_node.vector(node, "Abs", Vec3::Zero());
        if (const pugi::xml_node spine = node.child("Spine")) parse_spine(spine, origin, of_node, object);
        const pugi::xml_node points = node.child("Points");
        if (points && !object.spine.empty() && file.bones.empty()) parse_surface(points, origin, of_node, object);
        for (const pugi::xml_node& leaves : node.children("LeafReferences"))
            parse_leaves(leaves, std::int32_t(links.size()), bones, of_node, file);
        add_id(index, object.id, links.size(), node, of_node);
        file.objects.push_back(std::move(object));
        links.push_back(link_of(node, of_node));
    });
    link_parents(file.objects, links, index, "Object", f);
}

// Quads as two; by material where there are no lists of all.
std::vector<std::array<std::int32_t, 3>> triangles_of(const pugi::xml_node& lod, std::size_t points, const Fields& f) {
    std::vector<std::array<std::int32_t, 3>> triangle;
    const auto add = [&](const std::vector<std::int32_t>& corner) {
        for (std::size_t k = 0; k + 2 < corner.size(); k += 3)
            triangle.push_back({corner[k], corner[k + 1], corner[k + 2]});
    };
    add(f.indices(lod, "TriangleIndices", points, "vertices"));
    const std::vector<std::int32_t> quad = f.indices(lod, "QuadIndices", points, "vertices");
    for (std::size_t k = 0; k + 3 < quad.size(); k += 4) {
        triangle.push_back({quad[k], quad[k + 1], quad[k + 2]});
        triangle.push_back({quad[k], quad[k + 2], quad[k + 3]});
    }
    for (const pugi::xml_node& list : lod.children("Triangles"))
        if (!lod.child("Points")) add(f.indices(list, "PointIndices", points, "points"));
    return triangle;
}

void parse_meshes(const Elements& elements, File& file) {
    elements.each("Meshes", "Mesh", [&](const pugi::xml_node& node, const Fields& f) {
        Mesh mesh;
        mesh.id = f.integer(node, "ID");
        for (const pugi::xml_node& lod : node.children("LOD")) {
            const pugi::xml_node vertices = lod.child("Vertices");
            if (!vertices) continue;
            const std::vector<Vec3> points = f.points(vertices, "");
            if (points.empty()) continue;
            mesh.low = mesh.high = points.front();
            for (const Vec3& p : points) {
                mesh.low = mesh.low.cwiseMin(p);
                mesh.high = mesh.high.cwiseMax(p);
            }
            const MeshMeasure found = measured(points, triangles_of(lod, points.size(), f));
            mesh.area = found.area;
            mesh.pieces = found.pieces;
            break;
        }
        file.meshes.push_back(mesh);
    });
}

// A file without any Mesh leaves them to the program that shows it.
void check_mesh_ids(const File& file, const Fields& f) {
    if (file.meshes.empty()) return;
    std::unordered_set<std::int64_t> ids{-1};
    for (const Mesh& mesh : file.meshes) ids.insert(mesh.id);
    for (const LeafReference& leaf : file.leaves)
        if (!ids.contains(leaf.mesh))
            f.refuse("LeafReferences", leaf.offset,
                     "MeshID " + std::to_string(leaf.mesh) + " does not exist, expected the ID of a Mesh or -1");
}

std::optional<double> stated_unit(const pugi::xml_node& root, const Fields& f) {
    const pugi::xml_attribute units = root.attribute("units");
    if (!units) return {};
    const std::string u = lower_case(trimmed(units.value()));
    const auto is = [&u](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(),
                           [&u](const char* n) { return u == n || u == n + std::string("s"); });
    };
    if (is({"m", "meter", "metre"})) return 1;
    if (is({"cm", "centimeter", "centimetre"})) return 0.01;
    if (is({"mm", "millimeter", "millimetre"})) return 0.001;
    if (is({"in", "inch"}) || u == "inches") return 0.0254;
    if (is({"ft", "foot"}) || u == "feet") return 0.3048;
    f.refuse(root, "units is " + in_ascii_quotes(units.value()) + ", expected m, cm, mm, in or ft");
}

char stated_up(const pugi::xml_node& root, const Fields& f) {
    const pugi::xml_attribute up = root.attribute("upAxis");
    if (!up) return 0;
    const std::string axis = lower_case(trimmed(up.value()));
    for (const char c : {'y', 'z'}) {
        const std::string letter(1, c);
        for (const std::string& name :
             {letter, "+" + letter, letter + "-up", letter + "_up", letter + "up", letter + " up"})
            if (axis == name) return c;
    }
    f.refuse(root, "upAxis is " + in_ascii_quotes(up.value()) + ", expected Y or Z");
}

std::string stated_version(const pugi::xml_node& root) {
    const std::string major = root.attribute("VersionMajor").value(), minor = root.attribute("VersionMinor").value();
    return major.empty() ? std::string(root.attribute("version").value()) : major + "." + (minor.empty() ? "0" : minor);
}

} // namespace

bool File::has_spines() const {
    return std::any_of(objects.begin(), objects.end(), [](const Object& o) { return !o.spine.empty(); });
}

File parse(std::string_view content, const std::string& name) {
    const Elements elements(content, name);
    const Fields f(content, name);
    File file;
    elements.root([&](const pugi::xml_node& root, const Fields& of_root) {
        file.unit = stated_unit(root, of_root);
        file.up = stated_up(root, of_root);
        file.version = stated_version(root);
        file.source = root.attribute("Source").value();
    });
    const Index bones = parse_bones(elements, f, file);
    parse_objects(elements, bones, f, file);
    parse_meshes(elements, file);
    check_mesh_ids(file, f);
    return file;
}

} // namespace bough::speedtree
