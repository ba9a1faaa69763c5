#include "formats/documents/scene.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        const Wind wind = read_wind(content, "file");
        const std::string text = "{\"format\": \"bough-wind\", \"version\": 1, " + wind_text(wind).substr(1);
        if (wind_text(read_wind(text, "again")) != wind_text(wind))
            fuzzing::fail("what was written reads as something else");
    });
    return 0;
}
