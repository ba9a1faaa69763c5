// envelope_mesh.h: triangles of a mesh file: Wavefront OBJ, FBX and COLLADA read by assimp, glTF 2.0 (.gltf, .glb) here.
//
// The content says which format a file has. Only these three reach assimp, each only its own reader, because assimp's
// readers of other formats crash on damaged files; and it runs in a child process (forked.h), so that a crash is an
// error like any other. Polygons are triangulated, nodes' transforms applied (a mesh under several nodes is there as
// often); points, lines, materials, bones and animation are left out.
// Unit and up axis: glTF is in metres, Y up; FBX says so in its settings (axes by their signs, unit in centimetres),
// COLLADA in its asset element; OBJ says nothing: Y up, and the unit of import's guess (m to 120 units of height,
// else cm to 12000, else mm). The options' unit and up axis override all of these.
#pragma once
#include "formats/imports/import.h"
#include "lib/growth/mesh_interior.h"

namespace bough {

struct EnvelopeMesh {
    std::vector<Vec3> vertex; // [m], Y up
    std::vector<Triangle> triangle;
};

// `content` is that of the file `path`, whose folder a .gltf's buffers are looked for in. Throws InputError (place
// options.name): unknown or refused format, with advice; what assimp says, or that it crashed; no triangles; a position
// that is not finite.
EnvelopeMesh read_envelope_mesh(std::string_view content, const std::string& path, const ImportOptions&, ImportNotes&);

// ---- gltf_triangles.cpp ---- of the default scene of a glTF file, as its nodes place them, triangles of any mode.
// `folder`: where its buffers stand. O(file). Throws InputError (place `name`) as read_gltf and joints_of (model_gltf.h) do.
EnvelopeMesh triangles_of_gltf(std::string_view content, const std::string& folder, const std::string& name);

} // namespace bough
