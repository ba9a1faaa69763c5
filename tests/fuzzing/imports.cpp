// A reader of another program's trees, BOUGH_FUZZED; without, all of them behind their door, which tells formats apart and refuses what is none.
#include "formats/imports/import.h"
#include "formats/models/model_kind.h"
#include "fuzzing.h"

using namespace bough;

namespace {

ImportOptions options() {
    ImportOptions options;
    options.name = "file"; // no folder: nothing beside it is looked for
    return options;
}

// assimp's readers run in a child and are assimp's to fuzz.
bool is_own(std::string_view content) {
    const std::optional<AssimpKind> kind = model_kind(content);
    return !kind || *kind == AssimpKind::gltf || *kind == AssimpKind::glb;
}

void read_file(std::string_view content) {
    ImportNotes notes;
#ifdef BOUGH_FUZZED
    if (BOUGH_FUZZED.recognizes(content)) BOUGH_FUZZED.read(content, options(), notes);
#else
    is_importable(content, "file");
    import_splines(content, options(), notes);
#endif
    for (const std::string& line : notes.lines) fuzzing::check_message(line, content);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view content = fuzzing::content_of(data, size);
    if (is_own(content)) fuzzing::is_read(content, read_file);
    return 0;
}
