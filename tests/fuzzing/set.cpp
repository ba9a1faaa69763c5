// --set PATH=VALUE, a line each, upon a scene that has most of what there is to be replaced.
#include "formats/documents/scene.h"
#include "fuzzing.h"
#include <stdexcept>

using namespace bough;

namespace {

const SceneDocument& park() {
    static const SceneDocument scene = read_scene_document(read_input(BOUGH_DATA_DIR "/scenes/park.json"), "park.json");
    return scene;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const SceneDocument& scene = park();
    fuzzing::is_read(fuzzing::content_of(data, size), [&](std::string_view content) {
        std::vector<SceneOverride> overrides;
        for (std::size_t from = 0; from < content.size();) {
            const std::size_t end = std::min(content.find('\n', from), content.size());
            try {
                overrides.push_back(parse_override("--set", std::string(content.substr(from, end - from))));
            } catch (const std::invalid_argument&) {
            }
            from = end + 1;
        }
        changed(scene, overrides);
    });
    return 0;
}
