#include "gltf_accessor.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

struct Component {
    std::size_t type, bytes;
    double most; // that a normalized one stands for 1 at
    bool sign;   // two's complement
    const char* name;
};
constexpr std::size_t u8 = 5121, u16 = 5123, u32 = 5125, f32 = 5126;
constexpr std::array<Component, 6> components{{{5120, 1, 127, true, "bytes"},
                                               {u8, 1, 255, false, "unsigned bytes"},
                                               {5122, 2, 32767, true, "shorts"},
                                               {u16, 2, 65535, false, "unsigned shorts"},
                                               {u32, 4, 4294967295.0, false, "unsigned ints"},
                                               {f32, 4, 1, false, "floats"}}};

const Component& component_of(const Json& of, const std::string& place) {
    const std::size_t type = whole_number(of, "componentType", place);
    for (const Component& component : components)
        if (component.type == type) return component;
    throw std::out_of_range(place + ": componentType is " + std::to_string(type) +
                            ", expected 5120 to 5123, 5125 or 5126");
}

// 0: of no type that is read here.
std::size_t width_of(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 5> widths{
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
    const auto found = std::find_if(widths.begin(), widths.end(), [&](const auto& w) { return w.first == type; });
    return found == widths.end() ? 0 : found->second;
}

bool allows(GltfNumbers numbers, const Component& component, bool normalized) {
    const bool small = component.type == u8 || component.type == u16;
    switch (numbers) {
    case GltfNumbers::any:
        return true;
    case GltfNumbers::floats:
        return component.type == f32;
    case GltfNumbers::indices:
        return (small || component.type == u32) && !normalized;
    case GltfNumbers::joints:
        return small && !normalized;
    case GltfNumbers::weights:
        return component.type == f32 || (small && normalized);
    }
    return false;
}

const char* name_of(GltfNumbers numbers) {
    switch (numbers) {
    case GltfNumbers::any:
        return "any numbers";
    case GltfNumbers::floats:
        return "floats";
    case GltfNumbers::indices:
        return "unsigned bytes, shorts or ints";
    case GltfNumbers::joints:
        return "unsigned bytes or shorts";
    case GltfNumbers::weights:
        return "floats or normalized unsigned bytes or shorts";
    }
    return "";
}

// Where elements lie in the binary chunk.
struct Elements {
    std::size_t count = 0, width = 0, start = 0, stride = 0; // the last two in bytes
    const Component* component = nullptr;
};

// `place` and what is checked of `of`: an accessor, or a part of a sparse one.
Elements elements_in(const GltfDocument& document, const Json& of, std::size_t count, std::size_t width,
                     const Component& component, const std::string& place) {
    const std::size_t views = entries_of(document.json, "bufferViews"),
                      number = index_of(of, "bufferView", place, views);
    const Json& view = document.json["bufferViews"][number];
    if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression"))
        throw std::out_of_range(place + " is compressed (EXT_meshopt_compression), expected plain numbers");
    const std::string in_view = place + ", view " + std::to_string(number);
    const std::size_t size = width * component.bytes, offset = whole_number(of, "byteOffset", place, 0),
                      length = whole_number(view, "byteLength", in_view),
                      start = whole_number(view, "byteOffset", in_view, 0),
                      stated = whole_number(view, "byteStride", in_view, 0), stride = stated > 0 ? stated : size;
    if (stride < size)
        throw std::out_of_range(in_view + ": byteStride is " + std::to_string(stride) + ", expected at least the " +
                                counted(size, "byte", "bytes") + " of an element");
    const bool fits = offset <= length && // by division: the products may be too large for any number
                      (count == 0 || (size <= length - offset && count - 1 <= (length - offset - size) / stride));
    if (!fits)
        throw std::out_of_range(place + " ends beyond its view: " + counted(count, "element", "elements") + " of " +
                                counted(size, "byte", "bytes") + ", " + std::to_string(stride) + " apart, from byte " +
                                std::to_string(offset) + " of " + std::to_string(length));
    if (whole_number(view, "buffer", in_view) != 0 || start > document.binary.size() ||
        length > document.binary.size() - start)
        throw std::out_of_range(in_view + " names bytes that the file does not hold");
    return {count, width, start + offset, stride, &component};
}

std::vector<double> read(const GltfDocument& document, const Elements& elements) {
    const Component& component = *elements.component;
    std::vector<double> values;
    values.reserve(elements.count * elements.width);
    for (std::size_t i = 0; i < elements.count; ++i)
        for (std::size_t w = 0; w < elements.width; ++w) {
            const char* const bytes =
                document.binary.data() + elements.start + i * elements.stride + w * component.bytes;
            std::uint32_t bits = 0;
            for (std::size_t k = component.bytes; k-- > 0;) bits = bits << 8 | static_cast<unsigned char>(bytes[k]);
            if (component.type == f32)
                values.push_back(double(std::bit_cast<float>(bits)));
            else if (component.sign && bits >> (8 * component.bytes - 1) != 0)
                values.push_back(double(bits) - double(std::uint64_t(1) << (8 * component.bytes)));
            else
                values.push_back(double(bits));
        }
    return values;
}

struct AccessorArray {
    Elements all;             // without a view: no component
    Elements places, changes; // of a sparse one
    const Component* component = nullptr;
    bool normalized = false;
};

AccessorArray checked(const GltfDocument& document, const Json& named, const GltfUse& use) {
    const std::size_t index = checked_index(named, use.place, entries_of(document.json, "accessors"));
    const Json& accessor = document.json["accessors"][index];
    const std::string place = use.place + " (accessor " + std::to_string(index) + ")";
    AccessorArray array;
    array.component = &component_of(accessor, place);
    array.normalized = accessor.value("normalized", false);
    const std::string type = accessor.at("type").get<std::string>();
    if (type != use.type || !allows(use.numbers, *array.component, array.normalized))
        throw std::out_of_range(place + " is " + bough::in_ascii_quotes(type) + " of " +
                                (array.normalized ? "normalized " : "") + array.component->name + ", expected " +
                                use.type + " of " + name_of(use.numbers));
    const std::size_t count = whole_number(accessor, "count", place), width = width_of(type);
    if (accessor.contains("bufferView"))
        array.all = elements_in(document, accessor, count, width, *array.component, place);
    else if (count <= document.binary.size()) // nothing but zeros: not to be asked for without end
        array.all.count = count, array.all.width = width;
    else
        throw std::out_of_range(place + " names " + std::to_string(count) + " zeros, more than the file has bytes");
    if (!accessor.contains("sparse")) return array;
    const Json& sparse = accessor["sparse"];
    const Json& places = sparse.at("indices");
    const std::size_t changed = whole_number(sparse, "count", place + ", sparse");
    const Component& of_places = component_of(places, place + ", the array of sparse indices");
    if (!allows(GltfNumbers::indices, of_places, false))
        throw std::out_of_range(place + ": its sparse indices are " + of_places.name + ", expected " +
                                name_of(GltfNumbers::indices));
    array.places = elements_in(document, places, changed, 1, of_places, place + ", the array of sparse indices");
    array.changes = elements_in(document, sparse.at("values"), changed, width, *array.component,
                                place + ", the array of sparse values");
    return array;
}

} // namespace

std::string primitive_place(std::size_t mesh, std::size_t primitive) {
    return "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(primitive);
}

std::size_t count_of(const GltfDocument& document, const Json& accessor, const GltfUse& use) {
    return checked(document, accessor, use).all.count;
}

std::vector<double> values_of(const GltfDocument& document, const Json& accessor, const GltfUse& use) {
    const AccessorArray array = checked(document, accessor, use);
    const std::size_t count = array.all.count, width = array.all.width;
    document.numbers_read += count * width;
    if (document.numbers_read > most_numbers(document))
        throw std::out_of_range(use.place + ": with it more than " + std::to_string(most_numbers(document)) +
                                " numbers are read, as its arrays are named over and over; expected fewer copies");
    std::vector<double> values =
        array.all.component ? read(document, array.all) : std::vector<double>(count * width, 0);
    if (array.places.component) {
        const std::vector<double> at = read(document, array.places), to = read(document, array.changes);
        for (std::size_t k = 0; k < at.size(); ++k) {
            const std::size_t place = std::size_t(at[k]); // of an unsigned int, so exact
            if (place >= count)
                throw std::out_of_range(use.place + ": a sparse array changes element " + std::to_string(place) +
                                        " of " + std::to_string(count));
            std::copy_n(to.begin() + std::ptrdiff_t(k * width), width, values.begin() + std::ptrdiff_t(place * width));
        }
    }
    if (array.normalized && array.component->type != f32)
        for (double& value : values) value = std::max(-1.0, value / array.component->most);
    return values;
}

} // namespace bough
