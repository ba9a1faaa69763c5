// vat.h: a moving mesh as OpenVAT (github.com/sharpen3d/openvat): a mesh at rest, and a texture that says where each of its vertices is in each
// frame.
// Readers are shaders, for Unity, Unreal, Godot and three.js among others.
//
//   NAME.glb               the mesh at rest, one node, Y up [m]; TEXCOORD_1 of a vertex is the middle of its pixel of frame 0
//   NAME_vat.exr           half floats: of each vertex a column, of each frame a row from the top down; below them as many rows of normals
//   NAME_vat.png, NAME_vnrm.png   or these, 16 bits: places and normals apart
//   NAME-remap_info.json   {"os-remap": {"Min": [x, y, z], "Max": [x, y, z], "Frames": N},
//                           "animations": {"Sway": {"startFrame": 1, "endFrame": N, "framerate": fps, "looping": false}}}
// Red, green and blue are (offset from rest - Min) / (Max - Min) [m] and n / 2 + 1/2, in Blender's axes: glTF's (x, y, z) is (b.x, b.z, -b.y). Min
// is rounded down to 0.1, Max up, and they are at least 0.1 apart. A texture holds one row of vertices (Godot's reader asks for that).
// UV sets of the mesh's own behind its first move up by one.
// Cost: O(vertices) a frame; memory 18 bytes a vertex and frame.
// Errors  std::length_error for more vertices or frames than a texture holds; OutputError.
#pragma once
#include "formats/output_folder.h"
#include "lib/growth/skin.h"
#include "own_mesh.h"
#include "reduced_skin.h"

namespace bough {

constexpr std::size_t vat_side = 8192; // [pixels] of a texture, at most

struct VatOptions {
    double fps = 30;
    bool looping = false; // the frame behind the last is the first
    bool png = false;     // two PNG in place of one EXR
    std::string generator, source;
    // Frames that a texture holds.
    std::size_t most_frames() const { return png ? vat_side : vat_side / 2; }
};

// The files' names, in the order in which they are written.
std::vector<std::string> vat_files(const std::string& name, bool png);

// How the skin that was reduced looks. own: what it was made of, whose materials, colours and UV sets are shown; null: none.
struct VatLook {
    const Skin* skin;
    const OwnMesh* own;
};

class VatWriter {
public:
    // The reduced skin's vertices are the columns. Keeps references to all but the options.
    VatWriter(OutputFolder&, const std::string& name, const ReducedSkin&, const VatLook&, const VatOptions&);
    // The next frame: of all vertices of the reduced skin.
    void write(const std::vector<Vec3>& position, const std::vector<Vec3>& normal);
    // All of the files. Once; the caller finishes the folder.
    void finish();

private:
    void write_images(const Eigen::Array3d& low, const Eigen::Array3d& high);

    const std::string name_;
    const ReducedSkin& mesh_;
    const VatLook look_;
    const VatOptions options_;
    std::vector<Output*> file_; // of vat_files()
    std::size_t frames_ = 0;
    std::vector<Eigen::Vector3f> offset_; // frame after frame, Blender's axes
    std::vector<std::array<std::uint16_t, 3>> normal_;
};

} // namespace bough
