// A check of what assimp takes on trust, BOUGH_FUZZED (fbx_check.h, collada_check.h): it passes a file, or refuses it in one line.
#include "formats/models/collada_check.h"
#include "formats/models/fbx_check.h"
#include "fuzzing.h"
#include <stdexcept>

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        try {
            BOUGH_FUZZED(content);
        } catch (const std::runtime_error& error) { // the child's, which its parent puts into an InputError
            throw InputError("file", error.what());
        }
    });
    return 0;
}
