// driven_surface.h: the triangles of a glTF's meshes as one surface, with the matrices that move each vertex.
//
// A vertex p of a mesh [m, the mesh's own axes] stands in the scene's axes at
//     sum_k w_k M_k p / sum_k w_k,   M_k = G_n B,
// G_n the matrix of a node n. Of a mesh with a skin n is a joint and B its inverse bind matrix; joints and weights are those of all sets
// JOINTS_n, WEIGHTS_n. Of a mesh without one, and of a vertex without weights, n is the node that has the mesh and B is the identity.
// A part has one material. Parts stand in the order in which the scene, its nodes depth first, comes to their materials. In a part meshes and
// primitives stand by their numbers, each as often as nodes show it. Vertices that no triangle names are left out; the others keep their order.
// Normals are the file's; where it has none, a vertex has the sum of its triangles' areas. Morph targets are at rest.
#pragma once
#include "driven_look.h"

namespace bough {

struct DrivenSurface {
    struct Matrix {
        std::int32_t node = 0;
        std::int32_t set = 0; // alike for a skin's, which move vertices together
        Eigen::Affine3d bind = Eigen::Affine3d::Identity();
    };
    struct Share {
        std::int32_t matrix;
        float weight; // above 0
    };
    std::vector<Eigen::Vector3f> position, normal;     // in the mesh's axes; normals are not always unit
    std::vector<std::array<float, 2>> uv;              // of the base colour's image, v from the bottom up
    std::vector<std::array<std::int32_t, 3>> triangle; // counterclockwise seen from outside, in the mesh's axes
    std::vector<std::size_t> first_share = {0};        // of each vertex, and one more
    std::vector<Share> share;
    std::vector<Matrix> matrix;
    std::vector<SkinPart> part; // names and colours as `look` has them
    OwnMesh look;               // its parts are these, without surfaces
};

// Of the default scene. Decodes the document's compressed arrays in place. O(bytes of the file + nodes' vertices). Notes: what is not shown
// (colours of vertices, further texture coordinates, emission, morph targets, instances, animations), images that are no PNG or JPEG.
// Throws NoSkinnedMesh where there are no triangles. Throws InputError (place `name`): what check_arrays refuses (gltf_check.h), arrays of other
// lengths than the vertices, Draco's form, more than 2^31 - 1 vertices.
DrivenSurface surface_of(GltfDocument&, const std::string& name, std::vector<std::string>& notes);

} // namespace bough
