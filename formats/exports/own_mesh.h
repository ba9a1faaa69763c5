// own_mesh.h: a mesh that came with the tree, bound to the tree's bodies: what a .glb shows in place of a skin made of them.
//
// Standing vertices are moved by one body or two; what is placed is a shape of its own, drawn wherever it is placed, and moved by one, or bent.
// Places of one shape share its arrays until they are written, so that ten thousand twigs cost little more than one.
#pragma once
#include "lib/base/math.h"
#include "lib/growth/skin.h"
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace bough {

struct OwnSurface {
    std::vector<Eigen::Vector3f> position, normal;     // [m], unit; a shape's in its own frame
    std::vector<std::array<float, 4>> tangent;         // or empty: unit, and the sign of the binormal (glTF's TANGENT)
    std::vector<std::vector<std::array<float, 2>>> uv; // sets; v from the top of an image down, as glTF has it
    std::vector<std::array<float, 4>> color;           // or empty
    std::vector<std::array<std::int32_t, 3>> triangle;
};

struct OwnPlace {
    std::int32_t shape = 0, body = 0;
    Eigen::Matrix3f turn = Eigen::Matrix3f::Identity(); // and scale
    Eigen::Vector3f place = Eigen::Vector3f::Zero();    // [m] world, drawn
    // A twig is one body on a joint at its foot, which stands for a rod that bends all along (lib/model/stiffness.h). It is drawn as the rod: at a
    // share s of its length the way that the body goes is taken by w(s) = (6 s - 4 s^2 + s^3) / 3 over what bears it, the line of a beam under an
    // even load, so that its end is where the body has it.
    std::int32_t foot = -1; // the body that bears it; -1: it does not bend
    float length = 0;       // from the shape's origin to its farthest vertex, in its own frame
};

struct OwnPart { // of one material
    std::string name;
    Vec3 color = Vec3::Constant(0.8); // sRGB
    std::int32_t material = 0;
    OwnSurface standing; // [m] world, drawn
    std::vector<std::array<std::int32_t, 2>> body;
    std::vector<float> second; // weight of the second body; the first has the rest
    std::vector<OwnPlace> placed;
};

struct OwnImage {
    std::string name, type, bytes; // "image/png"
};

struct OwnMesh {
    std::vector<OwnPart> part; // none without triangles
    std::vector<OwnSurface> shape;
    std::vector<std::string> material; // a glTF material each, as JSON; texture i is image i
    std::vector<OwnImage> image;
};

std::size_t vertices_of(const OwnMesh&, const OwnPart&);
std::size_t triangles_of(const OwnMesh&, const OwnPart&);

// All of it as a skin, for writers of meshes frame by frame: the first set of UV, v counted from the bottom up. O(vertices), 90 bytes each.
// Throws std::length_error beyond 2^31 - 1 vertices, and for more than free memory holds.
Skin skin_of(const OwnMesh&);

// take(surface, vertex, place or null) for each vertex of a part, in the order in which they are written.
template <class Take> void each_vertex(const OwnMesh& mesh, const OwnPart& part, Take&& take) {
    for (std::size_t v = 0; v < part.standing.position.size(); ++v)
        take(part.standing, v, static_cast<const OwnPlace*>(nullptr));
    for (const OwnPlace& place : part.placed) {
        const OwnSurface& shape = mesh.shape[std::size_t(place.shape)];
        for (std::size_t v = 0; v < shape.position.size(); ++v) take(shape, v, &place);
    }
}
inline Eigen::Vector3f position_of(const OwnSurface& surface, std::size_t v, const OwnPlace* place) {
    if (!place) return surface.position[v];
    return place->turn * surface.position[v] + place->place;
}
// The bodies that move a vertex, and the second one's weight, 0..1; the first has the rest.
struct OwnShare {
    std::int32_t first, second;
    float weight;
};
inline OwnShare share_of(const OwnPart& part, const OwnSurface& surface, std::size_t v, const OwnPlace* place) {
    if (!place) return {part.body[v][0], part.body[v][1], part.second[v]};
    if (place->foot < 0) return {place->body, place->body, 0};
    const float s = std::min(surface.position[v].norm() / place->length, 1.f);
    return {place->body, place->foot, 1 - s * (6 - 4 * s + s * s) / 3};
}
// Where the surface has some.
inline std::array<float, 4> tangent_of(const OwnSurface& surface, std::size_t v, const OwnPlace* place) {
    const std::array<float, 4>& from = surface.tangent[v];
    if (!place) return from;
    const Eigen::Vector3f t = (place->turn * Eigen::Vector3f(from[0], from[1], from[2])).normalized();
    return {t.x(), t.y(), t.z(), from[3]};
}
// Placed shapes are scaled alike in all directions.
inline Eigen::Vector3f normal_of(const OwnSurface& surface, std::size_t v, const OwnPlace* place) {
    if (!place) return surface.normal[v];
    return (place->turn * surface.normal[v]).normalized();
}

} // namespace bough
