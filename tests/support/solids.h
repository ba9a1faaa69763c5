// solids.h: closed triangle meshes whose inside is known: an icosphere, a box, an upright prism over an L.
#pragma once
#include "lib/growth/mesh_interior.h"
#include <cstdint>
#include <map>
#include <string>

namespace bough::solids {

struct Solid {
    std::vector<Vec3> vertex;
    std::vector<Triangle> triangle;
};

// Corners on the unit sphere about the origin, 20 * 4^divisions triangles, facing out.
inline Solid icosphere(int divisions) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Solid s;
    for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{-1, g, 0},
                                                                    {1, g, 0},
                                                                    {-1, -g, 0},
                                                                    {1, -g, 0},
                                                                    {0, -1, g},
                                                                    {0, 1, g},
                                                                    {0, -1, -g},
                                                                    {0, 1, -g},
                                                                    {g, 0, -1},
                                                                    {g, 0, 1},
                                                                    {-g, 0, -1},
                                                                    {-g, 0, 1}})
        s.vertex.push_back(Vec3(x, y, z).normalized());
    s.triangle = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int i = 0; i < divisions; ++i) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
        const auto middle = [&](std::int32_t a, std::int32_t b) {
            const auto [at, fresh] =
                middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(s.vertex.size()));
            if (fresh)
                s.vertex.push_back(
                    Vec3(s.vertex[static_cast<std::size_t>(a)] + s.vertex[static_cast<std::size_t>(b)]).normalized());
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : s.triangle) {
            const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        s.triangle = finer;
    }
    return s;
}

// [0, 1]^3 by its 8 corners, facing out.
inline Solid unit_box() {
    Solid s;
    for (int i = 0; i < 8; ++i) s.vertex.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    s.triangle = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return s;
}

// L: x 0..4, y 2..8, z 0..2 without its notch x > 2 and y > 4. Facing out.
inline bool in_l(const Vec3& p) {
    return p.x() >= 0 && p.x() <= 4 && p.y() >= 2 && p.y() <= 8 && p.z() >= 0 && p.z() <= 2 &&
           !(p.x() > 2 && p.y() > 4);
}
inline Solid l_prism() {
    const std::vector<std::pair<double, double>> outline = {{0, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 8}, {0, 8}};
    Solid s;
    for (const double z : {0.0, 2.0})
        for (const auto& [x, y] : outline) s.vertex.emplace_back(x, y, z);
    for (const auto& [a, b, c] : std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
        s.triangle.push_back({a, c, b});
        s.triangle.push_back({a + 6, b + 6, c + 6});
    }
    for (std::int32_t i = 0; i < 6; ++i) {
        const std::int32_t j = (i + 1) % 6;
        s.triangle.push_back({i, j, j + 6});
        s.triangle.push_back({i, j + 6, i + 6});
    }
    return s;
}

inline Solid moved(Solid s, double scale, const Vec3& by) {
    for (Vec3& p : s.vertex) p = scale * p + by;
    return s;
}

inline Solid together(Solid a, const Solid& b) {
    const auto first = static_cast<std::int32_t>(a.vertex.size());
    a.vertex.insert(a.vertex.end(), b.vertex.begin(), b.vertex.end());
    for (const auto& [x, y, z] : b.triangle) a.triangle.push_back({x + first, y + first, z + first});
    return a;
}

inline Solid turned_over(Solid s) {
    for (Triangle& t : s.triangle) std::swap(t[1], t[2]);
    return s;
}

inline std::string obj_text(const Solid& s) {
    std::string text;
    for (const Vec3& p : s.vertex)
        text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    for (const auto& [a, b, c] : s.triangle)
        text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    return text;
}

} // namespace bough::solids
