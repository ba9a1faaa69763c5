// joined_parts.h: documents of the parts of a scene (simulation/parts.h), put together into what the whole scene gives.
//
// Motions become one motion, frame by frame, so that no more than a frame of each (of JSON: the whole part) is in memory; in each, bodies
// stand in the scene's order. The parts may come in any order; all of them must be there, and belong together.
// Errors. InputError: what of a part does not belong to the others. SceneError: there are too many, or too few.
#pragma once
#include "motion.h"

namespace bough {

struct MotionPart {
    std::string name; // as errors have it
    MotionFrames frames;
    MotionFrame frame{}; // the present one
};

class JoinedMotion {
public:
    // One and more
    explicit JoinedMotion(std::vector<MotionPart>);
    const MotionHeader& header() const { return header_; } // its source: the parts', each once
    bool next(MotionFrame&);                               // false: there is none left

private:
    void read(MotionPart&, bool more, MotionFrame& whole);

    std::vector<MotionPart> parts_;
    MotionHeader header_;
    std::int64_t count_ = 0; // frames so far
};

struct StatePart {
    std::string name;
    SavedState state;
};
// In the scene's order; one and more.
std::vector<StatePart> in_order(std::vector<StatePart>);

} // namespace bough
