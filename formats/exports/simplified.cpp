#include "simplified.h"
#include <algorithm>
#include <meshoptimizer.h>

namespace bough {
namespace {

constexpr double most_sloppy = 0.01; // of the mesh's size: beyond, a tree is none any more

std::vector<std::int32_t> used_by(const std::vector<unsigned>& index, std::size_t vertices) {
    std::vector<bool> used(vertices, false);
    for (const unsigned v : index) used[v] = true;
    std::vector<std::int32_t> list;
    for (std::size_t v = 0; v < vertices; ++v)
        if (used[v]) list.push_back(std::int32_t(v));
    return list;
}

} // namespace

Simplified simplified(const std::vector<Vec3>& position, const std::vector<std::array<std::int32_t, 3>>& triangle,
                      std::size_t most, bool whole) {
    std::vector<unsigned> all;
    all.reserve(3 * triangle.size());
    for (const auto& corners : triangle)
        for (const std::int32_t v : corners) all.push_back(unsigned(v));
    Simplified best;
    best.vertex = used_by(all, position.size());
    std::vector<unsigned> index = all;
    if (best.vertex.size() > most) {
        // About the middle, so that floats keep the shape.
        const Vec3 middle = position[std::size_t(best.vertex.front())];
        std::vector<float> at;
        at.reserve(3 * position.size());
        for (const Vec3& p : position)
            for (int k = 0; k < 3; ++k) at.push_back(float(p[k] - middle[k]));
        constexpr std::size_t stride = 3 * sizeof(float);
        constexpr float any_error = 1e6f;
        const float scale = meshopt_simplifyScale(at.data(), position.size(), stride);
        bool sloppy = false; // what keeps to no edge, where what does leaves too many
        const auto reach = [&](std::size_t triangles) {
            std::vector<unsigned> fewer(all.size());
            float error = 0;
            const std::size_t left =
                sloppy ? meshopt_simplifySloppy(fewer.data(), all.data(), all.size(), at.data(), position.size(),
                                                stride, 3 * triangles, any_error, &error)
                       : meshopt_simplify(fewer.data(), all.data(), all.size(), at.data(), position.size(), stride,
                                          3 * triangles, any_error, 0, &error);
            fewer.resize(left);
            std::vector<std::int32_t> used = used_by(fewer, position.size());
            const bool fits = used.size() <= most;
            if (fits || best.vertex.size() > most) {
                index = std::move(fewer);
                best.vertex = std::move(used);
                best.error = double(error) * double(scale);
            }
            return fits;
        };
        // The most triangles that fit, to 1 %.
        std::size_t low = 0, high = triangle.size();
        sloppy = !reach(0) && !whole;
        const Simplified kept = best;
        const std::vector<unsigned> of_kept = index;
        if (best.vertex.size() <= most || (sloppy && reach(0)))
            while (high - low > 1 + triangle.size() / 100) {
                const std::size_t middle_count = low + (high - low) / 2;
                (reach(middle_count) ? low : high) = middle_count;
            }
        if (sloppy && !(best.error <= most_sloppy * double(scale))) best = kept, index = of_kept;
    }
    for (std::size_t t = 0; t + 2 < index.size(); t += 3)
        best.triangle.push_back({std::int32_t(index[t]), std::int32_t(index[t + 1]), std::int32_t(index[t + 2])});
    return best;
}

} // namespace bough
