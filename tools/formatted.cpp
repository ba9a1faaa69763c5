#include "formatted.h"
#include <cstdarg>
#include <cstdio>

namespace bough {

std::string formatted(const char* format, ...) {
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    std::string text(length > 0 ? std::size_t(length) : 0, '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    return text;
}

std::string bytes_text(double bytes) {
    if (bytes >= 1e9) return formatted("%.1f GB", bytes / 1e9);
    if (bytes >= 1e6) return formatted("%.0f MB", bytes / 1e6);
    return formatted("%.0f kB", bytes / 1e3);
}

} // namespace bough
