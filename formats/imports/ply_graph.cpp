// ply_graph.cpp: a tree's skeleton in a PLY file: points with a radius, where there is one, and edges, as AdTree and
// others write them. Edges are a list of indices (two or a whole line of them) or two numbers; points that are repeated
// for each branch become one. Metres and Z up, as laser scans have it, are what the format's users mean; it states
// neither, so both are guessed.
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "line_graph.h"
#include "ply_elements.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

using Names = std::initializer_list<const char*>;

bool is_one_of(const std::string& name, Names names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return lower_case(name) == n; });
}

// The property with the first of these names that there is, -1: none.
int find(const PlyElement& element, Names names) {
    for (const char* name : names)
        for (std::size_t k = 0; k < element.property.size(); ++k)
            if (!element.property[k].list && lower_case(element.property[k].name) == name) return int(k);
    return -1;
}

bool is_vertex(const PlyElement& e) {
    return is_one_of(e.name, {"vertex", "vertices", "point", "points", "node", "nodes"});
}
bool is_edge(const PlyElement& e) {
    return is_one_of(e.name, {"edge", "edges", "line", "lines", "polyline", "polylines", "segment", "segments"});
}
bool is_face(const PlyElement& e) {
    return is_one_of(e.name, {"face", "faces", "tristrips"});
}

struct VertexColumns {
    int x = -1, y = -1, z = -1, radius = -1;
    double factor = 1;
};

VertexColumns columns_of(const PlyElement& e, const std::string& name, ImportNotes& notes) {
    VertexColumns c{find(e, {"x"}), find(e, {"y"}), find(e, {"z"}),
                    find(e, {"radius", "radii", "rad", "vertex_radius", "node_radius", "thickness_radius"}), 1};
    if (c.x < 0 || c.y < 0 || c.z < 0)
        throw InputError(name, "has vertices without x, y or z, expected a position for each");
    if (c.radius < 0 && find(e, {"g"}) < 0) c.radius = find(e, {"r"}); // beside g it is the colour red
    if (c.radius >= 0) return c;
    c.radius = find(e, {"diameter", "diam", "width", "thickness"});
    c.factor = 0.5;
    if (c.radius >= 0)
        notes.lines.push_back("radius taken as half of the vertices' " +
                              in_ascii_quotes(e.property[std::size_t(c.radius)].name));
    return c;
}

struct EdgeColumns {
    int list = -1, from = -1, to = -1;
};

EdgeColumns edge_columns(const PlyElement& e, const std::string& name) {
    EdgeColumns c;
    for (std::size_t k = 0; k < e.property.size() && c.list < 0; ++k)
        if (e.property[k].list && e.property[k].type < PlyType::f32) c.list = int(k);
    constexpr std::array<std::array<const char*, 2>, 10> pairs{{{"vertex1", "vertex2"},
                                                                {"vertex_1", "vertex_2"},
                                                                {"vertex0", "vertex1"},
                                                                {"v1", "v2"},
                                                                {"v0", "v1"},
                                                                {"start", "end"},
                                                                {"source", "target"},
                                                                {"from", "to"},
                                                                {"a", "b"},
                                                                {"i", "j"}}};
    for (const auto& pair : pairs) {
        if (c.list >= 0 || (c.from = find(e, {pair[0]})) < 0) continue;
        if ((c.to = find(e, {pair[1]})) >= 0) return c;
    }
    if (c.list < 0)
        throw InputError(name, "has element " + in_ascii_quotes(e.name) +
                                   " without a list of vertices or a pair such as vertex1 and vertex2");
    return c;
}

class GraphReader {
public:
    GraphReader(std::string_view content, const std::string& name, ImportNotes& notes)
        : header_(read_ply_header(content, name)), name_(name) {
        for (const PlyElement& e : header_.element) {
            if (is_vertex(e) && !vertex_) vertex_ = &e;
            if (is_edge(e) && !edge_) edge_ = &e;
            if (is_face(e) && !face_) face_ = &e;
        }
        if (!vertex_ || vertex_->count == 0) throw InputError(name, "holds no vertex, expected points and edges");
        // Some write edges as faces of two corners.
        lines_are_faces_ = !edge_ || edge_->count == 0;
        if (lines_are_faces_) edge_ = face_;
        if (!edge_ || edge_->count == 0) refuse_without_edges();
        vertex_at_ = columns_of(*vertex_, name, notes);
        edge_at_ = edge_columns(*edge_, name);
        graph.point.reserve(vertex_->count); // the header has been held against the file's size
        if (vertex_at_.radius >= 0) graph.radius.reserve(vertex_->count);
        graph.edge.reserve(edge_->count);
        each_ply_entry(
            content, header_, name, [this](const PlyElement& e) { return &e == vertex_ || &e == edge_; },
            [this](const PlyElement& e, const PlyEntry& entry) {
                &e == vertex_ ? add_vertex(entry) : add_edge(entry);
            });
        for (const auto& e : graph.edge)
            for (const std::int32_t i : e)
                if (std::size_t(i) >= graph.point.size())
                    throw InputError(name, "an edge names vertex " + std::to_string(i) + ", expected 0 to " +
                                               std::to_string(graph.point.size() - 1));
        if (!lines_are_faces_ && face_ && face_->count > 0)
            notes.lines.push_back(counted(face_->count, "face", "faces") + " not read beside the edges");
    }
    LineGraph graph;

private:
    [[noreturn]] void refuse_without_edges() const {
        if (face_ && face_->count > 0) refuse_mesh();
        throw InputError(name_, "is a cloud of " + counted(vertex_->count, "point", "points") +
                                    " without edges, which is no skeleton; reconstruct the tree first (AdTree "
                                    "-s, TreeQSM, raycloudtools) and give its skeleton");
    }
    [[noreturn]] void refuse_mesh() const {
        throw InputError(name_, "is a mesh of " + counted(face_->count, "face", "faces") +
                                    " without edges, which is no skeleton; give the tree's skeleton (element edge)");
    }

    static double value(const PlyEntry& entry, int property) {
        return entry.values[entry.first[std::size_t(property)]];
    }

    void add_vertex(const PlyEntry& entry) {
        const Vec3 p(value(entry, vertex_at_.x), value(entry, vertex_at_.y), value(entry, vertex_at_.z));
        if (!p.allFinite()) throw InputError(entry.place(), "vertex " + std::to_string(entry.index) + " is not finite");
        graph.point.push_back(p);
        if (vertex_at_.radius < 0) return;
        const double r = vertex_at_.factor * value(entry, vertex_at_.radius);
        graph.radius.push_back(std::isfinite(r) ? r : 0);
    }

    std::int32_t vertex(const PlyEntry& entry, double index) const {
        if (!(index >= 0 && index < double(vertex_->count)) || index != std::floor(index))
            throw InputError(entry.place(), entry.element->name + " " + std::to_string(entry.index) + " names vertex " +
                                                shown(index) + ", expected 0 to " + std::to_string(vertex_->count - 1));
        return std::int32_t(index);
    }

    void add_edge(const PlyEntry& entry) {
        if (edge_at_.list < 0) {
            graph.edge.push_back(
                {vertex(entry, value(entry, edge_at_.from)), vertex(entry, value(entry, edge_at_.to))});
            return;
        }
        const std::size_t first = entry.first[std::size_t(edge_at_.list)];
        const std::size_t end = entry.first[std::size_t(edge_at_.list) + 1];
        if (lines_are_faces_ && end - first > 2) refuse_mesh();
        for (std::size_t k = first; k + 1 < end; ++k)
            graph.edge.push_back({vertex(entry, entry.values[k]), vertex(entry, entry.values[k + 1])});
    }

    PlyHeader header_;
    const std::string& name_;
    const PlyElement *vertex_ = nullptr, *edge_ = nullptr, *face_ = nullptr;
    bool lines_are_faces_ = false;
    VertexColumns vertex_at_;
    EdgeColumns edge_at_;
};

bool recognizes_ply(std::string_view content) {
    return content.starts_with("ply\n") || content.starts_with("ply\r");
}

Splines read_ply(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    LineGraph graph = GraphReader(content, options.name, notes).graph;
    options.let_go();
    ImportedTree tree = tree_of_lines(std::move(graph), options.up, options.name, notes);
    tree.source = "PLY skeleton " + options.name;
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat ply_format{"PLY skeleton", recognizes_ply, read_ply};

} // namespace bough
