#include "envelope_mesh.h"
#include "assimp_mesh.h"
#include "formats/imports/imported_tree.h"
#include "formats/plain_text.h"
#include "model_kind.h"
#include "reader_limits.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr const char* readable = "expected a closed triangle mesh as OBJ, FBX, glTF (.gltf, .glb) or COLLADA (.dae)";

struct Refused {
    std::string_view begins;
    const char* is;
};
constexpr std::array<Refused, 11> refused{{
    {"ply", "a PLY model"},
    {"solid", "an STL model"},
    {"xof ", "a DirectX model"},
    {"BLENDER", "a Blender scene"},
    {"PXR-USDC", "a USD file"},
    {"#usda", "a USD file"},
    {"Ogawa", "an Alembic cache"},
    {"PK\x03\x04", "a ZIP or USDZ archive"},
    {"\x1F\x8B", "compressed by gzip"},
    {"\xFF\xFE", "UTF-16 text (save it as UTF-8)"},
    {"\xFE\xFF", "UTF-16 text (save it as UTF-8)"},
}};

// A line that begins with `v` and a number, before any byte that text does not hold.
bool has_vertex_line(std::string_view content) {
    for (std::size_t from = 0; from < content.size();) {
        const std::size_t end = std::min(content.find('\n', from), content.size());
        std::string_view line = content.substr(from, end - from);
        if (line.find('\0') != std::string_view::npos) return false;
        std::size_t at = 0;
        if (next_token(line, at) == "v" && parse_number(next_token(line, at))) return true;
        from = end + 1;
    }
    return false;
}

AssimpKind kind_of(std::string_view content, const std::string& name) {
    if (content.empty()) throw InputError(name, std::string("is empty, ") + readable);
    if (const std::optional<AssimpKind> kind = model_kind(content)) return *kind;
    content = without_bom(content);
    for (const Refused& r : refused)
        if (content.starts_with(r.begins))
            throw InputError(name, std::string("is ") + r.is + ", " + readable + "; export it as one of these");
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) throw InputError(name, std::string("is blank, ") + readable);
    const std::string_view head = content.substr(first, 4096);
    if (head[0] != '<' && head[0] != '{' && has_vertex_line(content)) return AssimpKind::obj;
    throw InputError(name, std::string("is of an unknown format, ") + readable);
}

double guessed_unit(const EnvelopeMesh& mesh, ImportNotes& notes) {
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& p : mesh.vertex) low = std::min(low, p.y()), high = std::max(high, p.y());
    const double unit = likely_unit(high - low);
    notes.lines.push_back("unit: the file states none; taken as " +
                          std::string(unit == 1      ? "m"
                                      : unit == 0.01 ? "cm"
                                                     : "mm") +
                          ", because the envelope is " + shown(high - low) + " units high (--units overrides)");
    return unit;
}

// By assimp, in a child.
AssimpMesh mesh_of_child(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    const ChildResult child = run_forked([&] { return packed(read_by_assimp(content, kind, options.up != 0)); },
                                         reader_limits(content.size()));
    if (!child.failure.empty())
        throw InputError(options.name, "assimp could not read it: " + child.failure + "; " + readable);
    return unpacked(child.bytes);
}

} // namespace

EnvelopeMesh read_envelope_mesh(std::string_view content, const std::string& path, const ImportOptions& options,
                                ImportNotes& notes) {
    const AssimpKind kind = kind_of(content, options.name);
    const bool gltf = kind == AssimpKind::gltf || kind == AssimpKind::glb;
    AssimpMesh found;
    EnvelopeMesh mesh;
    if (gltf) {
        mesh = triangles_of_gltf(content, folder_of(path), options.name);
        found.unit = 1;
    } else {
        found = mesh_of_child(content, kind, options);
        mesh = {std::move(found.vertex), std::move(found.triangle)};
    }
    if (mesh.triangle.empty()) throw InputError(options.name, std::string("has no faces, ") + readable);
    for (const Vec3& p : mesh.vertex)
        if (!p.allFinite())
            throw InputError(options.name, std::string("has a position that is not finite, ") + readable);
    Mat3 axes = found.axes;
    if (options.up == 'y') axes = Mat3::Identity();
    if (options.up == 'z') axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    for (Vec3& p : mesh.vertex) p = axes * p;
    if (kind == AssimpKind::obj && options.up == 0)
        notes.lines.push_back("up axis: the file states none; taken as Y (--up overrides)");
    const double unit = options.unit ? *options.unit : found.unit > 0 ? found.unit : guessed_unit(mesh, notes);
    const double applied = options.unit && kind == AssimpKind::dae ? collada_unit(content) : 1;
    for (Vec3& p : mesh.vertex) p *= unit / applied;
    return mesh;
}

} // namespace bough
