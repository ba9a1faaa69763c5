// sized_sink.h: frames in front of another sink, whose size is told before it is made.
#pragma once
#include "frame_sink.h"
#include <functional>

namespace bough {

// Hands all on. Where `frames` frames as large as the first would be more than 2 GB in all, `say` is told so once that one is written: how
// large it gets, a frame's share, and what is smaller than `format` (of treesim's). say is called by the thread that writes.
std::unique_ptr<FrameSink> sized_sink(std::unique_ptr<FrameSink>, const std::string& format, std::int64_t frames,
                                      std::function<void(const std::string&)> say);

} // namespace bough
