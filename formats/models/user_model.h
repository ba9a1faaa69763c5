// user_model.h: a model of the user's own with its armature, as the glTF that it is or becomes, to be moved by a tree.
//
// A .glb or .gltf stays as it is, its buffers and images in one file (gltf_document.h). FBX and COLLADA are turned into
// glTF by assimp, in a child process: nodes, meshes of faces (corners split by normal), skins, materials' colours, textures
// by name or embedded; the topmost node brings the file's unit and axes to metres and Y up, and vertices that no bone
// moves get one that stands still.
#pragma once
#include "armature.h"
#include <memory>

namespace bough {

struct GltfDocument;

struct UserModel {
    std::string name; // in messages
    std::shared_ptr<GltfDocument> document;
    Armature armature;               // [m], Y up
    std::vector<std::int32_t> joint; // of each bone: its node in the document
    Vec3 moved = Vec3::Zero();       // [m] by which an import of the file moves it to the origin (placed_import.h)
};

// Of a file without bones, or whose bones move no faces: lines and curves, of which an import may still make a tree.
struct NoSkinnedMesh : InputError {
    using InputError::InputError;
};

// Throws InputError, NoSkinnedMesh.
UserModel read_user_model(const std::string& path, ImportNotes&);

// assimp_glb.cpp: FBX or COLLADA as a .glb. Throws InputError, NoSkinnedMesh.
std::string glb_by_assimp(std::string_view content, AssimpKind, const ImportOptions&);
// What is said where assimp fails, which often gives no reason (an empty text, unnamed_failure), and what to do.
std::string not_turned(const std::string& why);

} // namespace bough
