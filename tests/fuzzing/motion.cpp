#include "formats/documents/motion.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        const Motion motion = read_motion(content, "file");
        const std::string text = fuzzing::written([&](Output& to) {
            MotionWriter writer(to, motion.header, MotionForm::jsonl);
            for (const MotionFrame& frame : motion.frame) writer.write(frame);
            writer.finish();
        });
        const Motion again = read_motion(text, "again");
        if (again.frame.size() != motion.frame.size()) fuzzing::fail("frames are lost");
    });
    return 0;
}
