#include "document_parts.h"
#include "formats/plain_text.h"
#include <algorithm>

namespace bough {
namespace {

// Walks JSON text, which need not be whole or right, to the string value whose keys from the outside in are `path`.
std::string find_text(std::string_view text, const std::vector<std::string_view>& path) {
    std::vector<std::string_view> keys(path.size());
    std::size_t depth = 0;
    for (std::size_t i = text.find_first_of("\"{}[]"); i < text.size(); i = text.find_first_of("\"{}[]", i + 1)) {
        if (text[i] == '{' || text[i] == '[') {
            if (depth++ < path.size()) keys[depth - 1] = {};
        } else if (text[i] == '}' || text[i] == ']') {
            if (depth > 0) --depth;
        } else {
            std::size_t end = i + 1;
            while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
            if (end >= text.size()) return "";
            const std::string_view token = text.substr(i + 1, end - i - 1);
            const std::size_t next = text.find_first_not_of(" \t\r\n", end + 1);
            const bool key = next != std::string_view::npos && text[next] == ':';
            if (key && depth >= 1 && depth <= path.size()) keys[depth - 1] = token;
            if (!key && depth == path.size() && keys == path) return std::string(token);
            if (!key && depth >= 1 && depth <= path.size()) keys[depth - 1] = {};
            i = end;
        }
    }
    return "";
}

} // namespace

bool looks_binary(std::string_view content) {
    const std::size_t start = text_start(content);
    const bool header = content.size() > 8 && content[8] == '{' && start < 8 && content[start] != '{';
    return header || content.substr(0, 8).find('\0') != std::string_view::npos;
}

std::string document_format(std::string_view content) {
    if (looks_binary(content)) {
        if (content.size() < 9) return "";
        // The data after the header is no text: look no further than the length says.
        std::size_t length = 0;
        for (std::size_t i = 8; i-- > 0;) length = length << 8 | static_cast<unsigned char>(content[i]);
        return find_text(content.substr(8, length), {"__metadata__", "format"});
    }
    const std::size_t start = text_start(content);
    if (start == content.size() || content[start] != '{') return "";
    return find_text(content.substr(start), {"format"});
}

} // namespace bough
