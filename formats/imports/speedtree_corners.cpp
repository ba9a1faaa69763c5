#include "speedtree_corners.h"
#include "disjoint_sets.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <map>
#include <numeric>

namespace bough::speedtree {
namespace {

// The first list that is there says how many records there are.
std::size_t records_in(const pugi::xml_node& vertices, std::size_t points, const Fields& f) {
    if (!vertices) return points;
    if (vertices.attribute("Count")) return std::size_t(std::max<std::int64_t>(0, f.integer(vertices, "Count")));
    for (const char* list : {"NormalX", "TexcoordU", "VertexColorR"})
        if (vertices.child(list)) return f.floats(vertices, list).size();
    return vertices.child("BoneID") ? f.integers(vertices, "BoneID").size() : points;
}

std::vector<float> list_of(const pugi::xml_node& vertices, const std::string& name, std::size_t count,
                           const Fields& f) {
    if (!vertices.child(name.c_str())) return {};
    std::vector<float> values = f.floats(vertices, name.c_str());
    f.expect_length(vertices, name.c_str(), values.size(), count);
    return values;
}

void read_uv(const pugi::xml_node& vertices, const Fields& f, Records& records) {
    for (const pugi::xml_node& list : vertices.children()) {
        const std::string name = list.name();
        if (name.size() < 2 || name.back() != 'U' || lower_case(name).find("texcoord") == std::string::npos) continue;
        const std::string other = name.substr(0, name.size() - 1) + "V";
        if (!vertices.child(other.c_str())) continue;
        records.uv.push_back({list_of(vertices, name, records.count, f), list_of(vertices, other, records.count, f)});
    }
}

std::int32_t record_at(const Corners& corners, std::size_t k) {
    return corners.record.empty() ? corners.point[k] : corners.record[k];
}

} // namespace

Records read_records(const pugi::xml_node& vertices, std::size_t points, const IndexOf& bones, const Fields& f) {
    Records records;
    records.count = records_in(vertices, points, f);
    if (!vertices) return records;
    const char* const axis[] = {"X", "Y", "Z"};
    const char* const channel[] = {"R", "G", "B", "A"};
    for (int k = 0; k < 3; ++k) {
        records.normal[k] = list_of(vertices, std::string("Normal") + axis[k], records.count, f);
        records.tangent[k] = list_of(vertices, std::string("Tangent") + axis[k], records.count, f);
        records.binormal[k] = list_of(vertices, std::string("Binormal") + axis[k], records.count, f);
    }
    for (int k = 0; k < 4; ++k)
        records.color[k] = list_of(vertices, std::string("VertexColor") + channel[k], records.count, f);
    for (const auto* list : {records.normal, records.tangent, records.binormal, records.color})
        for (int k = 1; k < 3; ++k)
            if (list[k].empty() != list[0].empty())
                f.refuse(vertices,
                         "has some components of Normal, Tangent, Binormal or VertexColor and not the others");
    read_uv(vertices, f, records);
    if (!vertices.child("BoneID")) return records;
    const std::vector<std::int64_t> ids = f.integers(vertices, "BoneID");
    f.expect_length(vertices, "BoneID", ids.size(), records.count);
    records.bone.reserve(ids.size());
    for (const std::int64_t id : ids) {
        const auto found = bones.find(id);
        if (id != -1 && !bones.empty() && found == bones.end())
            f.refuse(vertices, "BoneID " + std::to_string(id) + " does not exist, expected the ID of a Bone or -1");
        records.bone.push_back(found == bones.end() ? -1 : found->second);
    }
    return records;
}

void fill_bones(std::size_t points, const std::vector<Corners>& all, Records& records) {
    const auto none = [](std::int32_t bone) { return bone < 0; };
    if (std::none_of(records.bone.begin(), records.bone.end(), none) ||
        std::all_of(records.bone.begin(), records.bone.end(), none))
        return;
    DisjointSets pieces(points);
    for (const Corners& corners : all)
        for (std::size_t k = 0; k + 2 < corners.point.size(); k += 3) {
            pieces.join(corners.point[k], corners.point[k + 1]);
            pieces.join(corners.point[k], corners.point[k + 2]);
        }
    std::unordered_map<std::int32_t, std::map<std::int32_t, std::size_t>> votes;
    for (const Corners& corners : all)
        for (std::size_t k = 0; k < corners.point.size(); ++k)
            if (const std::int32_t bone = records.bone[record_at(corners, k)]; bone >= 0)
                ++votes[pieces.find(corners.point[k])][bone];
    for (const Corners& corners : all)
        for (std::size_t k = 0; k < corners.point.size(); ++k) {
            std::int32_t& bone = records.bone[record_at(corners, k)];
            const auto found = bone < 0 ? votes.find(pieces.find(corners.point[k])) : votes.end();
            if (found == votes.end()) continue;
            const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
            bone = std::max_element(found->second.begin(), found->second.end(), fewer)->first;
        }
}

Surface surface_of(const std::vector<Eigen::Vector3f>& points, const Records& records, const Corners& corners,
                   const Mat3& linear) {
    Surface made;
    made.material = corners.material;
    made.uv.resize(records.uv.size());
    // Of a point's records most often one or two: a list a point, in the order of their vertices.
    std::vector<std::int32_t> first(points.size(), -1), next, record_of;
    const Eigen::Matrix3f turn = linear.inverse().transpose().cast<float>();
    const Eigen::Matrix3f along = linear.cast<float>();
    const bool mirrored = linear.determinant() < 0;
    const bool tangents = !records.normal[0].empty() && !records.tangent[0].empty() && !records.binormal[0].empty();
    const auto vector = [](const std::vector<float>(&list)[3], std::int32_t r) {
        return Eigen::Vector3f(list[0][r], list[1][r], list[2][r]);
    };
    const auto vertex_of = [&](std::size_t k) {
        const std::int32_t p = corners.point[k], r = record_at(corners, k);
        std::int32_t* at = &first[p];
        while (*at >= 0) {
            if (record_of[*at] == r) return *at;
            at = &next[*at];
        }
        const std::int32_t v = *at = std::int32_t(made.position.size());
        next.push_back(-1);
        record_of.push_back(r);
        made.position.push_back(points[p]);
        if (!records.normal[0].empty()) {
            const Eigen::Vector3f n = turn * vector(records.normal, r);
            made.normal.push_back(n.squaredNorm() > 0 ? Eigen::Vector3f(n.normalized())
                                                      : Eigen::Vector3f(Eigen::Vector3f::UnitY()));
        }
        if (tangents) {
            const Eigen::Vector3f t = along * vector(records.tangent, r), b = along * vector(records.binormal, r);
            const float way = made.normal.back().cross(t).dot(b) < 0 ? -1.0f : 1.0f;
            const Eigen::Vector3f unit = t.squaredNorm() > 0 ? Eigen::Vector3f(t.normalized())
                                                             : Eigen::Vector3f(made.normal.back().unitOrthogonal());
            made.tangent.push_back({unit.x(), unit.y(), unit.z(), way});
        }
        for (std::size_t s = 0; s < records.uv.size(); ++s)
            made.uv[s].push_back({records.uv[s][0][r], records.uv[s][1][r]});
        if (!records.color[0].empty())
            made.color.push_back({records.color[0][r], records.color[1][r], records.color[2][r],
                                  records.color[3].empty() ? 1.0f : records.color[3][r]});
        made.bone.push_back(records.bone.empty() ? -1 : records.bone[r]);
        return v;
    };
    made.triangle.reserve(corners.point.size() / 3);
    for (std::size_t k = 0; k + 2 < corners.point.size(); k += 3) {
        const std::int32_t a = vertex_of(k), b = vertex_of(k + 1), c = vertex_of(k + 2);
        made.triangle.push_back(mirrored ? std::array{a, c, b} : std::array{a, b, c});
    }
    return made;
}

} // namespace bough::speedtree
