#include "formats/plain_text.h"
#include "model_scene.h"
#include "packed.h"
#include <algorithm>

namespace bough {

std::string bytes_of(const ModelScene& s) {
    std::string bytes, names;
    for (const std::string& name : s.name) names += valid_utf8(name) + '\n';
    pack(bytes, s.to_y_up.data(), 9);
    pack(bytes, &s.unit, 1);
    const std::int64_t counts[7] = {s.triangles,       s.skinned_meshes, s.animations,  s.mesh_encoded,
                                    s.open_are_joints, s.own_others,     s.other_scenes};
    pack(bytes, counts, 7);
    pack_all<std::int32_t, 1>(bytes, s.parent);
    pack_all<std::uint8_t, 1>(bytes, s.role);
    pack_all<std::int32_t, 1>(bytes, s.index);
    pack_all<double, 3>(bytes, s.place);
    pack_all<double, 9>(bytes, s.axes);
    pack_all<double, 3>(bytes, s.tip);
    pack_all<double, 3>(bytes, s.vertex);
    pack_all<std::int32_t, 1>(bytes, s.vertex_node);
    pack_all<double, 3>(bytes, s.vertex_by_node);
    pack_all<std::int32_t, 3>(bytes, s.face);
    pack_all<double, 3>(bytes, s.line_point);
    pack_all<double, 1>(bytes, s.line_radius);
    pack_all<std::int32_t, 2>(bytes, s.line);
    pack_all<double, 10>(bytes, s.own_rod);
    return bytes + names;
}

ModelScene model_scene_of(const std::string& bytes) {
    ModelScene s;
    std::size_t from = 0;
    unpack(bytes, from, s.to_y_up.data(), 9);
    unpack(bytes, from, &s.unit, 1);
    std::int64_t counts[7];
    unpack(bytes, from, counts, 7);
    s.triangles = counts[0], s.skinned_meshes = counts[1], s.animations = counts[2];
    s.mesh_encoded = counts[3] != 0, s.open_are_joints = counts[4] != 0, s.own_others = counts[5];
    s.other_scenes = counts[6];
    unpack_all<std::int32_t, 1>(bytes, from, s.parent);
    unpack_all<std::uint8_t, 1>(bytes, from, s.role);
    unpack_all<std::int32_t, 1>(bytes, from, s.index);
    unpack_all<double, 3>(bytes, from, s.place);
    unpack_all<double, 9>(bytes, from, s.axes);
    unpack_all<double, 3>(bytes, from, s.tip);
    unpack_all<double, 3>(bytes, from, s.vertex);
    unpack_all<std::int32_t, 1>(bytes, from, s.vertex_node);
    unpack_all<double, 3>(bytes, from, s.vertex_by_node);
    unpack_all<std::int32_t, 3>(bytes, from, s.face);
    unpack_all<double, 3>(bytes, from, s.line_point);
    unpack_all<double, 1>(bytes, from, s.line_radius);
    unpack_all<std::int32_t, 2>(bytes, from, s.line);
    unpack_all<double, 10>(bytes, from, s.own_rod);
    for (std::size_t i = 0; i < s.parent.size(); ++i) {
        const std::size_t end = std::min(bytes.find('\n', from), bytes.size());
        s.name.push_back(bytes.substr(from, end - from));
        from = std::min(end + 1, bytes.size());
    }
    return s;
}

} // namespace bough
