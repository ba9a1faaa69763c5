#include "line_ends.h"
#include <algorithm>

namespace bough {

std::optional<std::string> with_line_feeds(std::string_view content) {
    constexpr std::size_t head = 65536;
    const std::size_t feed = content.find('\n');
    if (feed != std::string_view::npos && feed + 1 < content.size()) return {};
    if (content.substr(0, head).find('\0') != std::string_view::npos) return {};
    const std::size_t first = content.find('\r');
    if (first == std::string_view::npos || first + 1 == feed) return {}; // one line that ends with CRLF
    std::string copy(content);
    std::replace(copy.begin(), copy.end(), '\r', '\n');
    return copy;
}

} // namespace bough
