#include "formats/documents/motion.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzzing::document(
        data, size, [](std::string_view content, const std::string& name) { return read_state(content, name); },
        [](Output& to, const SavedState& value, Form form) { write_state(to, value, form); });
}
