// motion_fields.h: what a motion document holds, for its reader and its writer (motion.h).
#pragma once
#include "document_parts.h"
#include "motion.h"

namespace bough {

constexpr DocumentType motion_type{"bough-motion", 1};

// One array of a frame, and which of MotionFields asks for it. One of the two pointers is set.
struct FrameArray {
    const char* name;
    bool MotionFields::*wanted;
    std::vector<Vec3> MotionFrame::*vectors;
    std::vector<Quat> MotionFrame::*rotations;
    std::size_t components() const { return vectors ? 3 : 4; }
    std::size_t size(const MotionFrame& frame) const {
        return vectors ? (frame.*vectors).size() : (frame.*rotations).size();
    }
};
extern const std::vector<FrameArray> frame_arrays;

std::vector<std::string> words_of(const MotionFields&); // {"pose", "velocity"}
// The header's fields; `words` stands for header.fields.
std::vector<Field> header_fields(MotionHeader&, std::vector<std::string>& words);
std::vector<Field> frame_fields(MotionFrame&);

} // namespace bough
