#include "own_mesh.h"
#include "formats/free_memory.h"
#include <limits>
#include <stdexcept>

namespace bough {

std::size_t vertices_of(const OwnMesh& mesh, const OwnPart& part) {
    std::size_t count = part.standing.position.size();
    for (const OwnPlace& place : part.placed) count += mesh.shape[std::size_t(place.shape)].position.size();
    return count;
}

std::size_t triangles_of(const OwnMesh& mesh, const OwnPart& part) {
    std::size_t count = part.standing.triangle.size();
    for (const OwnPlace& place : part.placed) count += mesh.shape[std::size_t(place.shape)].triangle.size();
    return count;
}

Skin skin_of(const OwnMesh& mesh) {
    std::size_t vertices = 0, triangles = 0;
    for (const OwnPart& part : mesh.part) vertices += vertices_of(mesh, part), triangles += triangles_of(mesh, part);
    if (vertices > std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw std::length_error("a mesh of " + std::to_string(vertices) + " vertices, more than an index holds");
    constexpr std::size_t vertex_bytes = 90;
    if (const std::size_t left = free_memory().value_or(SIZE_MAX); left / vertex_bytes < vertices)
        throw std::length_error("a mesh of " + std::to_string(vertices) + " vertices takes " +
                                std::to_string(vertices * vertex_bytes >> 20) + " MB, and " +
                                std::to_string(left >> 20) + " MB are free");
    Skin skin;
    skin.position.reserve(vertices);
    skin.normal.reserve(vertices);
    skin.texture.reserve(vertices);
    skin.joint.reserve(vertices);
    skin.weight.reserve(vertices);
    skin.triangle.reserve(triangles);
    for (const OwnPart& part : mesh.part) {
        const std::size_t first = skin.triangle.size();
        std::int32_t base = std::int32_t(skin.position.size());
        each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
            skin.position.push_back(position_of(from, v, place).cast<double>());
            skin.normal.push_back(normal_of(from, v, place).cast<double>());
            if (from.uv.empty())
                skin.texture.push_back({0, 0});
            else
                skin.texture.push_back({from.uv[0][v][0], 1 - from.uv[0][v][1]});
            const OwnShare share = share_of(part, from, v, place);
            skin.joint.push_back({share.first, share.second, share.first, share.first});
            skin.weight.push_back({1 - share.weight, share.weight, 0, 0});
        });
        const auto add = [&](const OwnSurface& from) {
            for (const auto& [a, b, c] : from.triangle) skin.triangle.push_back({base + a, base + b, base + c});
            base += std::int32_t(from.position.size());
        };
        add(part.standing);
        for (const OwnPlace& place : part.placed) add(mesh.shape[std::size_t(place.shape)]);
        skin.part.push_back({part.name, part.color, first, skin.triangle.size() - first});
    }
    return skin;
}

} // namespace bough
