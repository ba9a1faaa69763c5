#include "formats/documents/scene.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzzing::document(
        data, size,
        [](std::string_view content, const std::string& name) { return read_scene_document(content, name); },
        [](Output& to, const SceneDocument& value, Form form) { write_scene(to, value.scene, form, value.material); });
}
