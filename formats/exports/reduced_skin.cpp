#include "reduced_skin.h"
#include "formats/imports/disjoint_sets.h"
#include "lib/model/drawn_pose.h"
#include "simplified.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace bough {
namespace {

constexpr std::size_t most_of_piece = 64;
constexpr double most_growth = 2;

using Triangle = std::array<std::int32_t, 3>;

struct Piece {
    std::vector<std::int32_t> vertex, triangle; // rising
    double area = 0;
};

double area_of(const Skin& skin, const Triangle& t) {
    const Vec3 &a = skin.position[std::size_t(t[0])], &b = skin.position[std::size_t(t[1])],
               &c = skin.position[std::size_t(t[2])];
    return 0.5 * (b - a).cross(c - a).norm();
}

// What hangs together: by triangles, and by corners at one place, which seams of UV part.
class Touching {
public:
    explicit Touching(const Skin& skin) : skin_(skin), sets_(skin.position.size()) {}
    void join(std::int32_t a, std::int32_t b) { sets_.join(a, b); }
    void join(const Triangle& t) {
        for (const std::int32_t v : t) {
            const Vec3& p = skin_.position[std::size_t(v)];
            sets_.join(t[0], v);
            sets_.join(at_.try_emplace({p.x(), p.y(), p.z()}, v).first->second, v);
        }
    }
    std::int32_t find(std::int32_t v) { return sets_.find(v); }

private:
    const Skin& skin_;
    DisjointSets sets_;
    std::map<std::array<double, 3>, std::int32_t> at_;
};

// Leaves of a part; what of its triangles is none goes to `rest`.
std::vector<Piece> pieces_of(const Skin& skin, const SkinPart& part, const Tree& tree,
                             std::vector<std::int32_t>& rest) {
    const std::size_t end = part.first_index + part.index_count;
    Touching sets(skin);
    std::map<std::int32_t, std::int32_t> of_leaf; // of a body that is one leaf, its first vertex
    for (std::size_t t = part.first_index; t < end; ++t) {
        sets.join(skin.triangle[t]);
        for (const std::int32_t v : skin.triangle[t]) {
            const std::int32_t body = skin.joint[std::size_t(v)][0];
            if (is_flat(tree.kind[std::size_t(body)]) && !is_clump(tree, std::size_t(body)))
                sets.join(of_leaf.try_emplace(body, v).first->second, v);
        }
    }
    // A kite's two faces lie a leaf's thickness apart.
    for (const std::int32_t first : skin.clump_leaf)
        for (std::int32_t k = 1; k < std::int32_t(leaf_vertices); ++k) sets.join(first, first + k);
    std::map<std::int32_t, Piece> found; // by the first vertex
    for (std::size_t t = part.first_index; t < end; ++t) {
        Piece& piece = found[sets.find(skin.triangle[t][0])];
        piece.triangle.push_back(std::int32_t(t));
        piece.area += area_of(skin, skin.triangle[t]);
        piece.vertex.insert(piece.vertex.end(), skin.triangle[t].begin(), skin.triangle[t].end());
    }
    std::vector<Piece> pieces;
    for (auto& [key, piece] : found) {
        std::vector<std::int32_t>& of = piece.vertex;
        std::sort(of.begin(), of.end());
        of.erase(std::unique(of.begin(), of.end()), of.end());
        const std::int32_t body = skin.joint[std::size_t(of.front())][0];
        const bool leaf = of.size() <= most_of_piece && is_flat(tree.kind[std::size_t(body)]) &&
                          std::all_of(of.begin(), of.end(), [&](std::int32_t v) {
                              return skin.joint[std::size_t(v)][0] == body && skin.weight[std::size_t(v)][0] == 1;
                          });
        if (leaf)
            pieces.push_back(std::move(piece));
        else
            rest.insert(rest.end(), piece.triangle.begin(), piece.triangle.end());
    }
    return pieces;
}

struct Wood {
    Simplified mesh;
    std::size_t pieces = 0, kept = 0; // as of ReducedSkin
};

// The triangles, by the pieces that they hang together in, the largest area first.
std::vector<std::vector<Triangle>> by_size(const Skin& skin, const std::vector<Triangle>& triangle) {
    Touching sets(skin);
    for (const Triangle& t : triangle) sets.join(t);
    std::map<std::int32_t, std::pair<double, std::vector<Triangle>>> found;
    for (const Triangle& t : triangle) {
        auto& [area, of] = found[sets.find(t[0])];
        area += area_of(skin, t);
        of.push_back(t);
    }
    std::vector<std::pair<double, std::vector<Triangle>>> sorted;
    for (auto& [key, piece] : found) sorted.push_back(std::move(piece));
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::vector<Triangle>> pieces;
    for (auto& [area, of] : sorted) pieces.push_back(std::move(of));
    return pieces;
}

// At most so many vertices, where the largest piece can.
Wood fewer_wood(const Skin& skin, const std::vector<Triangle>& triangle, std::size_t most) {
    Wood wood{simplified(skin.position, triangle, most)};
    if (wood.mesh.vertex.size() <= most) return wood;
    const std::vector<std::vector<Triangle>> pieces = by_size(skin, triangle);
    const auto largest = [&](std::size_t count) {
        std::vector<Triangle> kept;
        for (std::size_t k = 0; k < count; ++k) kept.insert(kept.end(), pieces[k].begin(), pieces[k].end());
        return Wood{simplified(skin.position, kept, most, true), pieces.size(), count};
    };
    std::size_t low = 1, high = pieces.size();
    wood = largest(1);
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        Wood tried = largest(middle);
        const bool fits = tried.mesh.vertex.size() <= most;
        if (fits) wood = std::move(tried);
        (fits ? low : high) = middle;
    }
    return wood;
}

// Of each part's pieces those that are kept: with each vertex `share` of one is earned.
std::vector<const Piece*> thinned(const std::vector<Piece>& pieces, double share) {
    std::vector<const Piece*> kept;
    double credit = 0;
    for (const Piece& piece : pieces) {
        credit += share * double(piece.vertex.size());
        if (credit < double(piece.vertex.size()) * (1 - 1e-12)) continue;
        credit -= double(piece.vertex.size());
        kept.push_back(&piece);
    }
    return kept;
}

// About the vertex nearest to the joint of the body that moves it.
void grow(std::vector<Vec3>& position, const Piece& piece, const Vec3& joint, double factor) {
    const auto nearer = [&](std::int32_t a, std::int32_t b) {
        return (position[std::size_t(a)] - joint).squaredNorm() < (position[std::size_t(b)] - joint).squaredNorm();
    };
    const Vec3 foot = position[std::size_t(*std::min_element(piece.vertex.begin(), piece.vertex.end(), nearer))];
    for (const std::int32_t v : piece.vertex)
        position[std::size_t(v)] = foot + factor * (position[std::size_t(v)] - foot);
}

template <class T> std::vector<T> picked(const std::vector<T>& from, const std::vector<std::int32_t>& index) {
    std::vector<T> made;
    made.reserve(index.size());
    for (const std::int32_t i : index) made.push_back(from[std::size_t(i)]);
    return made;
}

// The vertices that the parts' triangles use, and these over them.
void keep(ReducedSkin& made, const Skin& from, const std::vector<std::vector<Triangle>>& triangle) {
    std::vector<std::int32_t> now(from.position.size(), -1);
    for (const auto& part : triangle)
        for (const Triangle& t : part)
            for (const std::int32_t v : t) now[std::size_t(v)] = 0;
    for (std::size_t v = 0; v < now.size(); ++v)
        if (now[v] == 0) {
            now[v] = std::int32_t(made.vertex.size());
            made.vertex.push_back(std::int32_t(v));
        }
    Skin& skin = made.skin;
    skin.position = picked(skin.position, made.vertex);
    skin.normal = picked(from.normal, made.vertex);
    skin.texture = picked(from.texture, made.vertex);
    skin.joint = picked(from.joint, made.vertex);
    skin.weight = picked(from.weight, made.vertex);
    for (const std::int32_t v : from.clump_leaf)
        if (now[std::size_t(v)] >= 0) skin.clump_leaf.push_back(now[std::size_t(v)]);
    for (std::size_t m = 0; m < triangle.size(); ++m) {
        skin.part.push_back({from.part[m].name, from.part[m].color, skin.triangle.size(), triangle[m].size()});
        for (const auto& [a, b, c] : triangle[m])
            skin.triangle.push_back({now[std::size_t(a)], now[std::size_t(b)], now[std::size_t(c)]});
    }
}

} // namespace

ReducedSkin reduced_skin(const Skin& skin, const Tree& tree, std::size_t most) {
    ReducedSkin made;
    const std::size_t all = skin.position.size();
    if (all <= most) {
        made.skin = skin;
        made.vertex.resize(all);
        std::iota(made.vertex.begin(), made.vertex.end(), 0);
        return made;
    }
    std::vector<std::vector<Piece>> pieces;
    std::vector<std::int32_t> rest;
    std::vector<std::int32_t> part_of(all, 0);
    std::size_t loose = 0;
    for (std::size_t m = 0; m < skin.part.size(); ++m) {
        pieces.push_back(pieces_of(skin, skin.part[m], tree, rest));
        for (const Piece& piece : pieces.back()) loose += piece.vertex.size();
        for (std::size_t t = 0; t < skin.part[m].index_count; ++t)
            for (const std::int32_t v : skin.triangle[skin.part[m].first_index + t])
                part_of[std::size_t(v)] = std::int32_t(m);
    }
    std::sort(rest.begin(), rest.end());
    // Leaves can be fewer at little loss: half of the vertices, or their share, is the wood's.
    const std::size_t wished = std::max((all - loose) * most / all, most / 2);
    const Wood fewer = fewer_wood(skin, picked(skin.triangle, rest), wished);
    const Simplified& wood = fewer.mesh;
    made.error = wood.error;
    made.wood_pieces = fewer.pieces;
    made.wood_kept = fewer.kept;
    std::vector<std::vector<Triangle>> triangle(skin.part.size());
    for (const Triangle& t : wood.triangle) triangle[std::size_t(part_of[std::size_t(t[0])])].push_back(t);

    made.skin.position = skin.position;
    const double room = double(most) - double(wood.vertex.size());
    const double share = loose > 0 ? std::clamp(room / double(loose), 0.0, 1.0) : 0;
    const DrawnPose pose = drawn_pose(tree);
    for (std::size_t m = 0; m < pieces.size(); ++m) {
        const std::vector<const Piece*> kept = thinned(pieces[m], share);
        made.pieces += pieces[m].size();
        made.kept += kept.size();
        double whole = 0, left = 0;
        for (const Piece& piece : pieces[m]) whole += piece.area;
        for (const Piece* piece : kept) left += piece->area;
        const double factor = left > 0 ? std::min(most_growth, std::sqrt(whole / left)) : 1;
        made.growth = std::max(made.growth, factor);
        for (const Piece* piece : kept) {
            grow(made.skin.position, *piece, pose.x_w[std::size_t(skin.joint[std::size_t(piece->vertex.front())][0])],
                 factor);
            for (const std::int32_t t : piece->triangle) triangle[m].push_back(skin.triangle[std::size_t(t)]);
        }
    }
    keep(made, skin, triangle);
    return made;
}

} // namespace bough
