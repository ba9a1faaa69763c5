// sized_sink.h: frames in front of another sink, whose size is told before it is made.
#pragma once
#include "frame_sink.h"
#include <functional>
#include <string>

namespace bough {

constexpr double large_output = 2e9; // [B]

// Returns what holds the motion in less than `format` (of treesim's) does, empty if nothing does. short_numbers: JSON's are those of floats, or
// rounded.
// several_fields: a frame holds more than one.
std::string smaller_output(const std::string& format, bool short_numbers, bool several_fields);

// Hands all on. Where `frames` frames will be more than `large` bytes in all, `say` is told so once two are written: how large it gets, a frame's
// share, and `smaller`. A frame's share is what the second one added: with the first come heads, which may hold
// something of each frame, and images. say is called by the thread that writes.
std::unique_ptr<FrameSink> sized_sink(std::unique_ptr<FrameSink>, std::string smaller, std::int64_t frames,
                                      std::function<void(const std::string&)> say, double large = large_output);

} // namespace bough
