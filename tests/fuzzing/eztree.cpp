#include "formats/parameters/eztree.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        std::vector<std::string> notes;
        if (is_eztree(content)) read_eztree(content, "file", notes);
    });
    return 0;
}
