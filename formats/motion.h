// motion.h: the motion document, "bough-motion" (formats/README.md), as JSON lines, JSON or safetensors.
#pragma once
#include "lib/model/motion.h"
#include "open.h"
#include <memory>

namespace bough {

enum class MotionForm { jsonl, json, safetensors };

// Writes a motion frame by frame. JSON and JSON lines stream; safetensors keeps its arrays in temporary files until
// finish(), because its header holds the number of frames. After finish() the output holds every frame written.
class MotionWriter {
public:
    MotionWriter(Output&, const MotionHeader&, MotionForm);
    ~MotionWriter();
    void write(const MotionFrame&);
    void finish();

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

bool is_motion(std::string_view content);
Motion read_motion(std::string_view content, const std::string& name);

bool is_state(std::string_view content);
SavedState read_state(std::string_view content, const std::string& name);
void write_state(Output&, const SavedState&, Form);

} // namespace bough
