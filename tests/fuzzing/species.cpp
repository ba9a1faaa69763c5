#include "formats/documents/species.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) { read_species(content, "file"); });
    return 0;
}
