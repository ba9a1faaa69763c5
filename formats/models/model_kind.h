// model_kind.h: which kind of three-dimensional model a file's content is, by its head: of the kinds that may reach
// assimp, whose readers of others crash on damaged files.
#pragma once
#include <optional>
#include <string_view>

namespace bough {

enum class AssimpKind { obj, fbx, gltf, glb, dae };

// FBX (binary or text), glTF (.glb, .gltf) or COLLADA; none for all else, OBJ among it, which has no mark of its own.
std::optional<AssimpKind> model_kind(std::string_view content);
const char* model_kind_name(AssimpKind); // "FBX"

// COLLADA's unit in metres, 1 where none is stated.
double collada_unit(std::string_view content);

} // namespace bough
