#include "gltf_uri.h"
#include "formats/error.h"
#include "formats/inside.h"
#include "formats/open.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace bough {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string unescaped(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
        text += escape ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return text;
}

std::string from_base64(std::string_view text) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value;
    value.fill(-1);
    for (std::size_t k = 0; k < alphabet.size(); ++k)
        value[static_cast<unsigned char>(alphabet[k])] = static_cast<int>(k);
    value['-'] = 62, value['_'] = 63;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=' || is_blank(c)) continue;
        const int v = value[static_cast<unsigned char>(c)];
        if (v < 0)
            throw std::runtime_error("a data: URI holds " + bough::in_ascii_quotes(std::string_view(&c, 1)) +
                                     ", expected base64");
        bits = bits << 6 | static_cast<std::uint32_t>(v);
        if (++count % 4 == 1) continue;
        const int left = (4 - count % 4) % 4 * 2; // bits of the next byte
        bytes += static_cast<char>(bits >> (count % 4 == 0 ? 0 : left) & 255);
    }
    return bytes;
}

} // namespace

std::string place_of_uri(const std::string& uri, const std::string& folder) {
    if (uri.starts_with("data:")) return "";
    const std::string file = folder + "/" + unescaped(uri);
    if (folder.empty() || !within_reach(file, folder)) return uri;
    std::error_code error;
    return std::filesystem::weakly_canonical(file, error).string();
}

bool leads_out(const std::string& uri, const std::string& folder) {
    const std::string scheme = lower_case(uri.substr(0, uri.find(':') + 1));
    if (scheme == "data:") return false;
    if (uri.find("://") != std::string::npos || scheme == "file:" || scheme == "http:" || scheme == "https:")
        return true;
    std::string path = unescaped(uri);
    std::replace(path.begin(), path.end(), '\\', '/'); // as Windows takes it
    const bool drive = path.size() > 2 && path[1] == ':' && path[2] == '/';
    const bool control = std::any_of(path.begin(), path.end(), [](unsigned char c) { return c < 0x20; });
    if (drive || control || path.starts_with("/")) return true;
    return !within_reach(folder + (folder.empty() ? "" : "/") + path, folder.empty() ? "." : folder);
}

std::string bytes_of_uri(const std::string& uri, const std::string& folder) {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos) throw std::runtime_error("a data: URI has no data");
        const std::string_view head = std::string_view(uri).substr(0, comma),
                               data = std::string_view(uri).substr(comma + 1);
        return head.ends_with(";base64") ? from_base64(data) : unescaped(data);
    }
    if (uri.find("://") != std::string::npos || uri.starts_with("/"))
        throw std::runtime_error(bough::in_ascii_quotes(uri) +
                                 " is not beside the file, expected a relative path or a data: URI");
    if (folder.empty())
        throw std::runtime_error(bough::in_ascii_quotes(uri) +
                                 " cannot be looked for: the file was read from a pipe or from memory");
    const std::string file = folder + "/" + unescaped(uri);
    if (file.find('\0') != std::string::npos)
        throw std::runtime_error(bough::in_ascii_quotes(uri) + " has a NUL, expected the name of a file");
    if (!within_reach(file, folder)) throw std::runtime_error(bough::in_ascii_quotes(uri) + " " + out_of_reach);
    if (!opens_at_once(file)) throw std::runtime_error(bough::in_ascii_quotes(uri) + " " + no_regular_file);
    try {
        std::string bytes = read_input(file);
        note_named_file(file);
        return bytes;
    } catch (const InputError&) {
        throw std::runtime_error(bough::in_ascii_quotes(uri) + " is not beside the file, or cannot be read");
    }
}

} // namespace bough
