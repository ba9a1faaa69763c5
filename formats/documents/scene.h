// scene.h: the scene document, "bough-scene" (formats/documents/README.md), and the wind alone as `--wind FILE`.
#pragma once
#include "formats/open.h"
#include "lib/model/material_change.h"
#include "lib/model/scene.h"

namespace bough {

// What the document holds: the scene, and what it changes of its trees' materials when they are read.
struct SceneDocument {
    Scene scene;
    MaterialChange material;
};

// A field to be replaced in the document before it is read.
struct SceneOverride {
    std::string given;             // as people wrote it, for messages: "--set wind.velocity=[8,0,0]"
    std::vector<std::string> path; // {"wind", "velocity"}; elements of lists by number
    std::string value;             // JSON, or else text
};
// "wind.velocity=[8,0,0]". Throws std::invalid_argument with what is wrong.
SceneOverride parse_override(const std::string& option, const std::string& text);

// Where a scene's tree is read from. Throws InputError where that is out of the scene's folder (inside.h).
std::string tree_file(const std::string& scene_file, const Placement&);
// The tree of this file with its wood changed. Throws InputError where what the wood was is not known.
Tree with_material(Tree, const MaterialChange&, const std::string& file);

bool is_scene(std::string_view content);
// Paths in it as written, relative to the scene. Overrides one after another: objects and lists on the way to a field are made where
// they are absent, a list's next element too; a wind that is a preset becomes its fields. What is wrong with the result, and comes of an override, is
// told with that override in the file's place.
SceneDocument read_scene_document(std::string_view content, const std::string& name,
                                  const std::vector<SceneOverride>& = {});
// The same with a document that was read before.
SceneDocument changed(const SceneDocument&, const std::vector<SceneOverride>&);
Wind read_wind(std::string_view content,
               const std::string& name); // {"format": "bough-wind", "version": 1, fields of the scene's "wind"}
std::string wind_text(const Wind&);      // as the value of a scene's "wind", JSON
// Throws OutputError for a tree that has no file, and for two trees of one file.
void write_scene(Output&, const Scene&, Form, const MaterialChange& = {});

} // namespace bough
