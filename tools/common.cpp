#include "common.h"
#include "file_names.h"

namespace bough {

Form chosen_form(const CommonOptions& common) {
    if (common.format == "json") return Form::json;
    if (common.format == "safetensors") return Form::safetensors;
    for (const char* other : {".glb", ".gltf", ".fbx", ".obj", ".dae", ".ply", ".stl", ".abc", ".usd", ".bvh", ".blend",
                              ".csv", ".jsonl", ".xml"})
        if (ending(common.output) == other)
            throw UsageError("-o is '" + common.output +
                             "', but this tool writes a document there: .json or .safetensors");
    return ending(common.output) == ".safetensors" ? Form::safetensors : form_of_name(common.output);
}

std::string with_command_line(const std::string& before, const CommonOptions& common) {
    if (!common.source) return before;
    return before.empty() ? common.command_line : before + "\n" + common.command_line;
}

} // namespace bough
