// line_ends.h: text of old Mac programs, whose lines end with CR alone, for readers that end lines at LF.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace bough {

// A copy with LF for each CR where the content is text (no NUL in its first 64 KB) with CR and without LF, but for one at
// its end; else nothing, as most often after the first line. O(size up to the first LF).
std::optional<std::string> with_line_feeds(std::string_view content);

} // namespace bough
