// shown_frames.h: the file that a run's frames go to, and the tree that they are of.
#pragma once
#include "shown_model.h"

namespace bough {

struct ShownFrames {
    std::unique_ptr<const Tree> own; // of a mesh that changes on the way: balls with it, and what breaks apart from it
    std::unique_ptr<FrameSink> sink; // none with --no-output
};

// Of a run at its first frame. broken: the joints that will break in it, rising, where a mesh has to know. Keeps references to the setting, the run's
// tree and the options' notes. Throws UsageError, OutputError.
ShownFrames shown_frames(TreesimOptions&, const Setting&, const Simulation&, const std::string& format,
                         const std::vector<std::uint32_t>& broken, std::int64_t first, std::int64_t last, ShownModel);

} // namespace bough
