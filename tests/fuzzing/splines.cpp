#include "formats/documents/splines.h"
#include "fuzzing.h"
#include "lib/growth/segment.h"
#include <stdexcept>

using namespace bough;

namespace {

// What treeconvert makes of them, of at most so many bodies.
void segment_some(const Splines& splines) {
    SegmentOptions options;
    options.max_bodies = 200;
    try {
        segment(splines, Material(), options);
    } catch (const std::invalid_argument&) {
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzzing::document(
        data, size,
        [](std::string_view content, const std::string& name) {
            Splines splines = read_splines(content, name);
            if (name == "file") segment_some(splines);
            return splines;
        },
        [](Output& to, const Splines& value, Form form) { write_splines(to, value, form); });
}
