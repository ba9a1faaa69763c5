#include "gltf_document.h"
#include "formats/error.h"
#include "formats/free_memory.h"
#include "formats/json_shape.h"
#include "formats/plain_text.h"
#include "gltf_shape.h"
#include "gltf_uri.h"
#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <new>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t most_names = 4096;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

std::uint32_t word(std::string_view content, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(content[at + k]);
    return value;
}

void add_word(std::string& bytes, std::uint64_t value) {
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 255);
}

struct Chunks {
    std::string_view json, binary;
    bool has_binary = false;
};

Chunks chunks_of(std::string_view content, const std::string& name) {
    if (!content.starts_with("glTF")) return {without_bom(content), {}};
    if (content.size() < 20) throw InputError(name, "is cut off within its header, expected a .glb");
    if (word(content, 4) != 2)
        throw InputError(name, "is glTF " + std::to_string(word(content, 4)) + ".0, expected 2.0; export it as 2.0");
    Chunks found;
    for (std::size_t at = 12; at + 8 <= content.size();) {
        const std::size_t size = word(content, at), type = word(content, at + 4);
        if (size > content.size() - at - 8)
            throw InputError(name, "is cut off: a chunk of " + std::to_string(size) + " bytes has " +
                                       std::to_string(content.size() - at - 8));
        const std::string_view chunk = content.substr(at + 8, size);
        if (type == json_chunk && found.json.empty()) found.json = chunk;
        if (type == binary_chunk && !found.has_binary) found.binary = chunk, found.has_binary = true;
        at += 8 + size;
    }
    if (found.json.empty()) throw InputError(name, "has no JSON chunk, expected a .glb");
    return found;
}

// [bytes] a byte of JSON may take at most, on the way to what is made of it: "0," is a value of 16 in arrays that grow by doubling, read twice.
constexpr std::size_t most_of_json_byte = 64;

Json parsed(std::string_view text, const std::string& name) {
    // Json's destructor takes memory of its own, and ends the program where there is none: so it is asked for beforehand. Untouched, it costs
    // nothing.
    ::operator delete(::operator new(most_of_json_byte* text.size()));
    const JsonShape shape = json_shape(text);
    if (shape.depth > deepest_json)
        throw InputError(name, std::string("JSON ") + nested_too_deep + ", expected glTF 2.0");
    if (shape.names > most_names) // an ordered object looks each new one up among all before
        throw InputError(name,
                         "JSON has an object of " + std::to_string(shape.names) + " names, expected at most 4096");
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        const std::size_t at = std::min(error.byte, text.size());
        throw InputError(file_line(name, line_of(text, at)), "JSON is broken, expected glTF 2.0");
    } catch (const Json::out_of_range&) {
        throw InputError(name, "JSON holds a number too large for double precision, expected glTF 2.0");
    }
}

std::size_t whole_value(const Json& value, const std::string& what) {
    const bool whole = value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
    if (!whole)
        throw std::out_of_range(what + " is " +
                                value.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 40) +
                                ", expected a whole number");
    return value.get<std::size_t>();
}

// Where the buffers come to lie: those with bytes in the new buffer 0, the others behind it.
struct Layout {
    std::vector<std::size_t> buffer, offset, size;
};

// A small file can name many large ones: what they take together has to be free once more, for what is made of it.
void require_room(const GltfDocument& document, std::size_t more) {
    constexpr std::size_t always = std::size_t(64) << 20; // asked for each small one it would take longer than reading
    const std::size_t bytes = document.binary.size() + more;
    if (bytes < always) return;
    if (const std::size_t left = free_memory().value_or(SIZE_MAX); left < bytes)
        throw std::runtime_error("does not fit into memory: its buffers and images take " +
                                 std::to_string(bytes >> 20) + " MB or more, and " + std::to_string(left >> 20) +
                                 " MB are free; expected less");
}

// [bytes] of each file that buffers name, as far as the longest of them reaches.
std::map<std::string, std::size_t> longest_buffers(const Json& buffers, const std::string& folder) {
    std::map<std::string, std::size_t> longest;
    for (const Json& buffer : buffers) {
        if (!buffer.contains("uri")) continue;
        std::size_t& length = longest[place_of_uri(buffer["uri"].get<std::string>(), folder)];
        length = std::max(length, whole_number(buffer, "byteLength", "buffer"));
    }
    return longest;
}

Layout merge_buffers(GltfDocument& document, const Chunks& chunks, const std::string& folder) {
    Json& json = document.json;
    Layout layout;
    Json kept = Json::array({Json{{"byteLength", 0}}});
    const Json buffers = json.value("buffers", Json::array());
    const std::map<std::string, std::size_t> longest = longest_buffers(buffers, folder);
    struct Held {
        std::size_t offset, size;
    };
    std::map<std::string, Held> held; // by file: buffers of one file share its bytes
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const Json& buffer = buffers[i];
        const std::size_t length = whole_number(buffer, "byteLength", "buffer " + std::to_string(i));
        std::string bytes, place;
        if (buffer.contains("uri")) {
            place = place_of_uri(buffer["uri"].get<std::string>(), folder);
            if (const auto same = held.find(place); same != held.end() && same->second.size >= length) {
                layout.buffer.push_back(0);
                layout.offset.push_back(same->second.offset);
                layout.size.push_back(length);
                continue;
            }
            bytes = bytes_of_uri(buffer["uri"].get<std::string>(), folder);
        } else if (i == 0 && chunks.has_binary) {
            bytes = chunks.binary;
        } else { // a fallback: no bytes
            layout.buffer.push_back(kept.size());
            layout.offset.push_back(0);
            layout.size.push_back(length);
            kept.push_back(buffer);
            continue;
        }
        if (bytes.size() < length)
            throw std::out_of_range("buffer " + std::to_string(i) + " has " + std::to_string(bytes.size()) +
                                    " bytes, expected " + std::to_string(length));
        document.binary.resize((document.binary.size() + 3) / 4 * 4);
        layout.buffer.push_back(0);
        layout.offset.push_back(document.binary.size());
        layout.size.push_back(length);
        const std::size_t kept_bytes = place.empty() ? length : std::min(bytes.size(), longest.at(place));
        require_room(document, kept_bytes);
        document.binary.append(bytes, 0, kept_bytes);
        if (!place.empty()) held[place] = {layout.offset.back(), kept_bytes};
        if (layout.offset.back() == 0) kept[0] = buffer; // its name and extras
    }
    kept[0].erase("uri");
    json["buffers"] = std::move(kept);
    return layout;
}

// `place`: what a message calls the view.
void move_view(Json& view, const Layout& layout, const std::string& place) {
    const std::size_t buffer = index_of(view, "buffer", place, layout.buffer.size()),
                      offset = whole_number(view, "byteOffset", place, 0),
                      length = whole_number(view, "byteLength", place);
    if (offset > layout.size[buffer] || length > layout.size[buffer] - offset)
        throw std::out_of_range(place + " has " + std::to_string(length) + " bytes from byte " +
                                std::to_string(offset) + " on, of a buffer of " + std::to_string(layout.size[buffer]));
    view["buffer"] = layout.buffer[buffer];
    if (layout.offset[buffer] > 0) view["byteOffset"] = offset + layout.offset[buffer];
}

void move_views(Json& json, const Layout& layout) {
    for (std::size_t v = 0; v < entries_of(json, "bufferViews"); ++v) {
        Json& view = json["bufferViews"][v];
        const std::string place = "view " + std::to_string(v);
        move_view(view, layout, place);
        if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression"))
            move_view(view["extensions"]["EXT_meshopt_compression"], layout, place + " (EXT_meshopt_compression)");
    }
}

// Appends bytes to the binary chunk from a multiple of 4; returns their view's index.
std::size_t add_view(GltfDocument& document, std::string_view bytes) {
    std::string& binary = document.binary;
    binary.resize((binary.size() + 3) / 4 * 4);
    for (const char* list : {"bufferViews", "buffers"})
        if (!document.json.contains(list)) document.json[list] = Json::array();
    if (document.json["buffers"].empty()) document.json["buffers"].push_back(Json::object());
    Json& views = document.json["bufferViews"];
    views.push_back(Json{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    binary += bytes;
    return views.size() - 1;
}

// An older version has other kinds of values, so that it is looked at first.
void refuse_other_version(const Json& json, const std::string& name) {
    if (!json.is_object() || !json.contains("asset") || !json["asset"].is_object()) return;
    const Json& asset = json["asset"];
    if (!asset.contains("version") || !asset["version"].is_string()) return;
    const std::string version = asset["version"].get<std::string>();
    if (!version.starts_with("2."))
        throw InputError(name, "asset version is " + bough::in_ascii_quotes(version) + " (glTF 2.0)");
}

// A white pixel as PNG, in place of an image that is named in no output.
constexpr std::string_view white_pixel(
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x8\0\0\0\0\x3a\x7e\x9b\x55\0\0\0\nIDAT\x78\xda\x63\xf8\xf"
    "\0\1\1\1\0\x1c\xb0\x8c\x99\0\0\0\0IEND\xae\x42\x60\x82",
    67);

void embed_images(GltfDocument& document, const std::string& name, const std::string& folder, ImportNotes& notes) {
    if (!document.json.contains("images")) return;
    std::map<std::string, std::size_t> views; // by file: images of one file share its view
    std::map<std::string, const char*> types;
    for (std::size_t i = 0; i < document.json["images"].size(); ++i) {
        const Json image = document.json["images"][i];
        if (!image.contains("uri")) continue;
        const std::string uri = image["uri"].get<std::string>();
        if (uri.starts_with("data:")) continue;
        const std::string place = place_of_uri(uri, folder);
        if (const auto same = views.find(place); same != views.end()) {
            Json& embedded = document.json["images"][i];
            embedded.erase("uri");
            embedded["mimeType"] = types[place];
            embedded["bufferView"] = same->second;
            continue;
        }
        std::string bytes, why = "is of no kind that a .glb can hold";
        try {
            bytes = bytes_of_uri(uri, folder);
        } catch (const std::exception& error) {
            why = error.what();
        }
        const bool refused = bytes.empty() && leads_out(uri, folder);
        if (refused) bytes = white_pixel;
        const char* const type = image_type(bytes);
        const std::string file = lower_case(uri), stated = image.value("mimeType", std::string());
        if (!type && !bytes.empty() &&
            (stated == "image/png" || stated == "image/jpeg" || file.ends_with(".png") || file.ends_with(".jpg") ||
             file.ends_with(".jpeg")))
            throw ImageError(name, "image " + bough::in_ascii_quotes(uri) +
                                       " is no image that can be read, expected PNG or JPEG");
        if (!type) {
            notes.lines.push_back("image " + bough::in_ascii_quotes(uri) +
                                  " not put into the file, its name stays: " + why);
            continue;
        }
        if (refused) notes.lines.push_back("image " + bough::in_ascii_quotes(uri) + " is white: " + why);
        require_room(document, bytes.size());
        const std::size_t view = add_view(document, bytes);
        if (!refused) views[place] = view, types[place] = type;
        Json& embedded = document.json["images"][i];
        embedded.erase("uri");
        embedded["mimeType"] = type;
        embedded["bufferView"] = view;
    }
}

} // namespace

std::size_t whole_number(const Json& object, const char* key, const std::string& place) {
    return whole_value(object.at(key), place + ": " + key);
}

std::size_t whole_number(const Json& object, const char* key, const std::string& place, std::size_t otherwise) {
    return object.contains(key) ? whole_number(object, key, place) : otherwise;
}

std::size_t checked_index(const Json& value, const std::string& what, std::size_t end) {
    const std::size_t index = whole_value(value, what);
    if (index >= end)
        throw std::out_of_range(what + " is " + std::to_string(index) +
                                (end > 0 ? ", expected less than " + std::to_string(end) : ", but there is none"));
    return index;
}

std::size_t index_of(const Json& object, const char* key, const std::string& place, std::size_t end) {
    return checked_index(object.at(key), place + ": " + key, end);
}

std::size_t entries_of(const Json& document, const char* list) {
    return document.contains(list) ? document[list].size() : 0;
}

const char* image_type(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xFF\xD8")) return "image/jpeg";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
    if (bytes.starts_with("\xABKTX 20")) return "image/ktx2";
    return nullptr;
}

GltfDocument read_gltf(std::string_view content, const std::string& name, const std::string& folder, GltfImages images,
                       ImportNotes& notes) {
    const Chunks chunks = chunks_of(content, name);
    GltfDocument document;
    document.json = parsed(chunks.json, name);
    document.text = chunks.json.size();
    refuse_other_version(document.json, name);
    require_gltf_shape(document.json, name);
    try {
        move_views(document.json, merge_buffers(document, chunks, folder));
        if (images == GltfImages::embed) embed_images(document, name, folder, notes);
    } catch (const std::bad_alloc&) {
        throw; // not the file's fault
    } catch (const ImageError&) {
        throw;
    } catch (const Json::exception& error) {
        throw InputError(name, "is no glTF 2.0: " + std::string(error.what()));
    } catch (const std::exception& error) {
        throw InputError(name, std::string(error.what()) + " (glTF 2.0)");
    }
    return document;
}

std::size_t add_shorts(GltfDocument& document, const std::vector<std::uint16_t>& numbers, const char* type) {
    const std::string_view kind = type;
    const std::size_t width = kind == "SCALAR" ? 1 : kind == "VEC3" ? 3 : 4;
    std::string bytes;
    bytes.reserve(2 * numbers.size());
    for (const std::uint16_t number : numbers) {
        bytes += static_cast<char>(number & 255);
        bytes += static_cast<char>(number >> 8);
    }
    Json accessor{{"bufferView", add_view(document, bytes)},
                  {"componentType", 5123},
                  {"count", numbers.size() / width},
                  {"type", type}};
    Json& accessors = document.json["accessors"];
    if (!accessors.is_array()) accessors = Json::array();
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
}

std::size_t add_floats(GltfDocument& document, const std::vector<float>& numbers, const char* type, bool with_bounds) {
    const std::string_view kind = type;
    const std::size_t width = kind == "SCALAR" ? 1 : kind == "VEC3" ? 3 : kind == "VEC4" ? 4 : 16;
    std::string bytes;
    bytes.reserve(4 * numbers.size());
    for (const float number : numbers) {
        std::uint32_t bits = 0;
        static_assert(sizeof bits == sizeof number);
        std::memcpy(&bits, &number, sizeof bits);
        add_word(bytes, bits);
    }
    Json accessor{{"bufferView", add_view(document, bytes)},
                  {"componentType", 5126},
                  {"count", numbers.size() / width},
                  {"type", type}};
    if (with_bounds) {
        const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end()); // of scalars
        accessor["min"] = Json::array({*low});
        accessor["max"] = Json::array({*high});
    }
    Json& accessors = document.json["accessors"];
    if (!accessors.is_array()) accessors = Json::array();
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
}

std::string glb_of(GltfDocument& document, const std::string& output_name) {
    Json& json = document.json;
    document.binary.resize((document.binary.size() + 3) / 4 * 4);
    const std::size_t binary_size = document.binary.size();
    if (binary_size == 0)
        json.erase("buffers");
    else
        json["buffers"][0]["byteLength"] = binary_size;
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t whole = 12 + 8 + text.size() + (binary_size > 0 ? 8 + binary_size : 0);
    if (whole > std::numeric_limits<std::uint32_t>::max())
        throw OutputError(output_name, "would have " + std::to_string(whole) +
                                           " bytes, more than the 4 GiB that a .glb can hold; take fewer frames");
    std::string glb = "glTF";
    glb.reserve(whole);
    add_word(glb, 2);
    add_word(glb, whole);
    add_word(glb, text.size());
    add_word(glb, json_chunk);
    glb += text;
    if (binary_size == 0) return glb;
    add_word(glb, binary_size);
    add_word(glb, binary_chunk);
    glb += document.binary;
    return glb;
}

} // namespace bough
