// What `treeprofile compare` reads.
#include "formats/reports/report.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        const Report report = read_report(content, "file");
        const auto written = [](const Report& r) {
            return fuzzing::written([&](Output& to) { write_report_json(to, r); });
        };
        if (const std::string text = written(report); written(read_report(text, "again")) != text)
            fuzzing::fail("what was written reads as something else");
    });
    return 0;
}
