#include "skin_attributes.h"
#include <algorithm>

namespace bough {

SkinAttributes attributes_of(const Skin& skin, const OwnMesh* own) {
    SkinAttributes made;
    const auto has_vertices = [&](const OwnPart& part) { return vertices_of(*own, part) > 0; };
    if (!own || std::none_of(own->part.begin(), own->part.end(), has_vertices)) {
        made.uv.resize(1);
        for (const auto& [u, v] : skin.texture) made.uv[0].push_back({u, 1 - v});
        return made;
    }
    std::size_t sets = 1;
    bool colored = false;
    const auto look = [&](const OwnSurface& surface) {
        sets = std::max(sets, surface.uv.size());
        colored |= !surface.color.empty();
    };
    for (const OwnPart& part : own->part) look(part.standing);
    for (const OwnSurface& shape : own->shape) look(shape);
    made.uv.resize(sets);
    for (const OwnPart& part : own->part)
        each_vertex(*own, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace*) {
            for (std::size_t s = 0; s < sets; ++s)
                made.uv[s].push_back(s < from.uv.size() ? from.uv[s][v] : std::array<float, 2>{0, 0});
            if (colored) made.color.push_back(from.color.empty() ? std::array<float, 4>{1, 1, 1, 1} : from.color[v]);
        });
    return made;
}

} // namespace bough
