#include "meshopt.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <array>
#include <meshoptimizer.h>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

// [bytes] that a compressed byte can stand for at most: half a byte tells sixteen times sixteen equal ones of vertices,
// one byte three indices of four bytes.
constexpr std::size_t most_of_byte = 64;
constexpr std::size_t most_of_ends = 64 * 256; // [bytes] of elements that the codecs keep beside

struct Packed {
    std::string place; // in messages
    std::string_view bytes;
    std::size_t count = 0, stride = 0;
};

// Sizes [bytes] of elements, as the codecs ask for them.
bool allowed(std::string_view what, std::size_t stride) {
    if (what == "ATTRIBUTES") return stride > 0 && stride <= 256 && stride % 4 == 0;
    if (what == "TRIANGLES" || what == "INDICES") return stride == 2 || stride == 4;
    if (what == "OCTAHEDRAL") return stride == 4 || stride == 8;
    if (what == "QUATERNION") return stride == 8;
    return stride % 4 == 0; // EXPONENTIAL
}

void check_stride(const Packed& packed, const std::string& what) {
    if (!allowed(what, packed.stride))
        throw std::out_of_range(packed.place + ": byteStride is " + std::to_string(packed.stride) + ", which " + what +
                                " does not allow");
}

using Filter = void (*)(void*, std::size_t, std::size_t);

// Null for none. Throws for one that is not known.
Filter filter_of(const std::string& name, const std::string& place) {
    constexpr std::array<std::pair<std::string_view, Filter>, 4> filters{{{"NONE", nullptr},
                                                                          {"OCTAHEDRAL", meshopt_decodeFilterOct},
                                                                          {"QUATERNION", meshopt_decodeFilterQuat},
                                                                          {"EXPONENTIAL", meshopt_decodeFilterExp}}};
    for (const auto& [known, filter] : filters)
        if (name == known) return filter;
    throw std::out_of_range(place + ": filter is " + in_ascii_quotes(name) +
                            ", expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

std::string decoded(const Packed& packed, const std::string& mode) {
    const std::size_t size = packed.count * packed.stride;
    std::string out(size, '\0');
    const auto* const from = reinterpret_cast<const unsigned char*>(packed.bytes.data());
    int failed = 0;
    if (mode == "ATTRIBUTES")
        failed = meshopt_decodeVertexBuffer(out.data(), packed.count, packed.stride, from, packed.bytes.size());
    else if (mode == "TRIANGLES")
        failed = meshopt_decodeIndexBuffer(out.data(), packed.count, packed.stride, from, packed.bytes.size());
    else
        failed = meshopt_decodeIndexSequence(out.data(), packed.count, packed.stride, from, packed.bytes.size());
    if (failed != 0)
        throw std::out_of_range(packed.place + ": " + counted(packed.bytes.size(), "byte", "bytes") +
                                " are no array of " + counted(packed.count, "element", "elements") + " compressed as " +
                                mode + "; the file is damaged or of a newer version");
    return out;
}

std::string decoded_view(const GltfDocument& document, const Json& view, const Json& extension,
                         const std::string& place) {
    const std::size_t offset = whole_number(extension, "byteOffset", place, 0),
                      length = whole_number(extension, "byteLength", place);
    if (whole_number(extension, "buffer", place) != 0)
        throw std::out_of_range(place + " names bytes that the file does not hold");
    Packed packed{place, std::string_view(document.binary).substr(offset, length),
                  whole_number(extension, "count", place), whole_number(extension, "byteStride", place)};
    const std::string mode = extension.at("mode").get<std::string>(),
                      filter_name = extension.value("filter", std::string("NONE"));
    if (mode != "ATTRIBUTES" && mode != "TRIANGLES" && mode != "INDICES")
        throw std::out_of_range(place + ": mode is " + in_ascii_quotes(mode) +
                                ", expected ATTRIBUTES, TRIANGLES or INDICES");
    check_stride(packed, mode);
    if (mode == "TRIANGLES" && packed.count % 3 != 0)
        throw std::out_of_range(place + ": count is " + std::to_string(packed.count) + ", expected three a triangle");
    const std::size_t stated = whole_number(view, "byteLength", place);
    if (packed.count != stated / packed.stride || stated % packed.stride != 0) // the product may be too large
        throw std::out_of_range(place + " has " + counted(packed.count, "element", "elements") + " of " +
                                counted(packed.stride, "byte", "bytes") + ", but its view " + std::to_string(stated) +
                                " bytes");
    if (stated > most_of_ends && stated - most_of_ends > most_of_byte * packed.bytes.size())
        throw std::out_of_range(place + ": " + counted(packed.bytes.size(), "byte", "bytes") + " cannot hold " +
                                std::to_string(stated));
    const Filter filter = filter_of(filter_name, place);
    if (filter) {
        if (mode != "ATTRIBUTES") throw std::out_of_range(place + ": a filter is of ATTRIBUTES alone");
        check_stride(packed, filter_name);
    }
    std::string bytes = decoded(packed, mode);
    if (filter) filter(bytes.data(), packed.count, packed.stride);
    return bytes;
}

} // namespace

void decode_meshopt(GltfDocument& document) {
    for (std::size_t v = 0; v < entries_of(document.json, "bufferViews"); ++v) {
        Json& view = document.json["bufferViews"][v];
        if (!view.contains("extensions")) continue;
        const std::string place = "view " + std::to_string(v);
        if (view["extensions"].contains("KHR_meshopt_compression"))
            throw std::out_of_range(place + " is compressed by KHR_meshopt_compression, which is not read here; "
                                            "expected EXT_meshopt_compression (gltfpack -ce ext)");
        if (!view["extensions"].contains("EXT_meshopt_compression")) continue;
        const Json extension = view["extensions"]["EXT_meshopt_compression"];
        const std::string bytes = decoded_view(document, view, extension, place + " (EXT_meshopt_compression)");
        document.binary.resize((document.binary.size() + 3) / 4 * 4);
        view["buffer"] = 0;
        view["byteOffset"] = document.binary.size();
        view["extensions"].erase("EXT_meshopt_compression");
        document.binary += bytes;
    }
}

} // namespace bough
