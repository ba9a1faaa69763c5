// frame_sink.h: where treesim's frames go: a motion document, or an OBJ sequence.
#pragma once
#include "common.h"
#include "lib/model/motion.h"
#include "lib/model/tree.h"
#include <memory>

namespace bough {

class FrameSink {
public:
    virtual ~FrameSink() = default;
    virtual void write(const MotionFrame&) = 0; // throws OutputError
    virtual void finish() = 0;                  // everything written so far is a valid output; throws OutputError
};

// `format`: jsonl, json or safetensors.
std::unique_ptr<FrameSink> motion_sink(const std::string& file, const std::string& format, const MotionHeader&);

// One OBJ a frame, each whole or absent, and one mtl. Keeps references to the tree.
std::unique_ptr<FrameSink> obj_sink(const std::string& pattern, const Tree&, int sides);

} // namespace bough
