// speedtree_mesh.h: what is to be seen of a SpeedTree file: the surfaces of its objects, the meshes that its leaf references place, and
// its materials. (Its skeleton is speedtree_xml.h.)
//
// A corner of a triangle is a point and a vertex record; within an object and a material corners of the same two are one vertex. Quads
// become two triangles. Positions are brought into the tree's world as they are read, those of the meshes stay in their own unit.
// UV: sets TexcoordU/V and any other pair of lists whose names hold "Texcoord" and end in U and V, in the file's order; V grows from the
// bottom of an image to its top: so read, images lie unmirrored on the bark that SpeedTree makes (tests/formats/models/speedtree_model.cpp).
// A vertex without a bone (BoneID -1) has that of most vertices of the piece of surface it is on, if they have one: a merged export
// tells its branches apart by that alone.
// Left out: AO, Blend, wind.
#pragma once
#include "lib/model/check_parts.h"
#include "speedtree_surface.h"
#include "speedtree_xml.h"
#include <Eigen/Geometry>
#include <array>

namespace bough::speedtree {

struct Map {
    std::string name;            // "Color", "Opacity", "Normal", "Gloss" ...
    std::string file;            // as the file names it; empty: none
    std::optional<Vec3> color;   // sRGB
    std::optional<double> value; // of one channel
    std::size_t line = 0;
};

struct MeshMaterial {
    std::int64_t id = 0;
    std::string name;
    bool two_sided = false;
    std::vector<Map> maps;
};

struct Shape { // a level of detail of a mesh
    std::int64_t mesh = 0, level = 0;
    std::vector<Surface> surface; // one a material; material -1: that of the reference
};

struct MeshFile {
    std::vector<MeshMaterial> materials;
    bool flip_opacity = false;
    std::vector<Surface> surface; // of objects, in order
    std::vector<Shape> shape;     // those with triangles
};

// `world`: the world [m] from the file's own unit and axes. `bones`: of parse(), for BoneID. Throws InputError FILE:LINE: indices,
// bones and materials out of range, points out of `within`, lists of unequal length, numbers that are not finite. O(size of the file); one object at
// a time is in memory as text.
// within: [m] where points of objects may be in the world. Those of meshes may be as far from their origin as `world` leaves below 1e15 m.
MeshFile parse_mesh(std::string_view content, const std::string& name, const std::vector<Bone>& bones,
                    const Eigen::Affine3d& world,
                    const Eigen::AlignedBox3d& within = {Vec3(Vec3::Constant(-largest_length)),
                                                         Vec3(Vec3::Constant(largest_length))});

// Whether an object of the file has triangles, by its text alone (meshes of leaves without any bark are no tree to be seen). O(bytes).
bool has_mesh(std::string_view content);

} // namespace bough::speedtree
