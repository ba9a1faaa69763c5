// scene.h: the scene document, "bough-scene" (formats/README.md), and the wind alone as `--wind FILE`.
#pragma once
#include "lib/model/scene.h"
#include "open.h"

namespace bough {

bool is_scene(std::string_view content);
Scene read_scene(std::string_view content, const std::string& name); // paths in it as written, relative to the scene
Wind read_wind(std::string_view content,
               const std::string& name); // {"format": "bough-wind", "version": 1, fields of the scene's "wind"}
void write_scene(Output&, const Scene&, Form);

} // namespace bough
