// motion_fields.h: what a motion document holds, for its reader and its writer (motion.h).
#pragma once
#include "document_parts.h"
#include "motion.h"
#include <array>

namespace bough {

constexpr DocumentType motion_type{"bough-motion", 1};

// One array of a frame, and which of MotionFields asks for it. One of the three pointers is set.
struct FrameArray {
    const char* name;
    bool MotionFields::*wanted;
    std::vector<Vec3> MotionFrame::*vectors;
    std::vector<Quat> MotionFrame::*rotations;
    std::vector<double> MotionFrame::*numbers;
    std::size_t components() const { return vectors ? 3 : rotations ? 4 : 1; }
    std::size_t size(const MotionFrame& frame) const {
        return vectors ? (frame.*vectors).size() : rotations ? (frame.*rotations).size() : (frame.*numbers).size();
    }
    // Of safetensors: frames, bodies, and what one body has, where that is several numbers.
    std::vector<std::int64_t> shape(std::int64_t frames, std::int64_t bodies) const {
        std::vector<std::int64_t> all{frames, bodies, std::int64_t(components())};
        if (numbers) all.pop_back();
        return all;
    }
};
extern const std::vector<FrameArray> frame_arrays;

std::vector<std::string> words_of(const MotionFields&); // {"pose", "velocity"}
// What an event may be; in the binary form its number here. And the arrays over events that are integers there, in the file's order.
inline const std::vector<std::string> event_words{"broke", "hit", "landed", "leapt"};
constexpr std::array<const char*, 4> event_integers{"event_frame", "event", "event_body", "event_on"};

// The header's fields; `words` stands for header.fields.
std::vector<Field> header_fields(MotionHeader&, std::vector<std::string>& words);
std::vector<Field> frame_fields(MotionFrame&);

} // namespace bough
