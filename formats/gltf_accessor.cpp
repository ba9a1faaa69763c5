#include "gltf_accessor.h"
#include <bit>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

struct Component {
    std::size_t bytes = 0;
    double most = 0;   // that a normalized one stands for 1 at
    bool sign = false; // two's complement
    bool real = false;
};

Component component_of(std::int64_t type) {
    switch (type) {
    case 5120:
        return {1, 127, true, false};
    case 5121:
        return {1, 255, false, false};
    case 5122:
        return {2, 32767, true, false};
    case 5123:
        return {2, 65535, false, false};
    case 5125:
        return {4, 4294967295.0, false, false};
    case 5126:
        return {4, 1, false, true};
    default:
        throw std::out_of_range("componentType is " + std::to_string(type) + ", expected 5120 to 5123, 5125 or 5126");
    }
}

// `count` values from `offset` of a view on.
std::vector<double> values_in(const GltfDocument& document, const Json& of, std::size_t count,
                              const Component& component) {
    const Json& view = document.json.at("bufferViews").at(of.at("bufferView").get<std::size_t>());
    if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression"))
        throw std::out_of_range("an array is compressed (EXT_meshopt_compression), expected plain numbers");
    const std::size_t in_view = of.value("byteOffset", std::size_t(0)),
                      length = view.at("byteLength").get<std::size_t>(),
                      start = view.value("byteOffset", std::size_t(0)),
                      stride = view.value("byteStride", component.bytes);
    const std::size_t last = std::numeric_limits<std::uint32_t>::max(); // sums and products below stay exact
    const bool fits = in_view <= length && count <= last && stride <= 252 &&
                      (count == 0 || (count - 1) * stride + component.bytes <= length - in_view);
    const bool there = view.at("buffer").get<std::size_t>() == 0 && start <= document.binary.size() &&
                       length <= document.binary.size() - start;
    if (!fits || !there)
        throw std::out_of_range("an array of " + std::to_string(count) + " numbers ends beyond its view");
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const char* const bytes = document.binary.data() + start + in_view + i * stride;
        std::uint32_t bits = 0;
        for (std::size_t k = component.bytes; k-- > 0;) bits = bits << 8 | static_cast<unsigned char>(bytes[k]);
        if (component.real)
            values.push_back(double(std::bit_cast<float>(bits)));
        else if (component.sign && bits >> (8 * component.bytes - 1) != 0)
            values.push_back(double(bits) - double(std::uint64_t(1) << (8 * component.bytes)));
        else
            values.push_back(double(bits));
    }
    return values;
}

} // namespace

std::vector<double> scalars_of(const GltfDocument& document, std::size_t index) {
    const Json& accessor = document.json.at("accessors").at(index);
    if (const std::string type = accessor.at("type").get<std::string>(); type != "SCALAR")
        throw std::out_of_range("accessor " + std::to_string(index) + " is " + type.substr(0, 8) + ", expected SCALAR");
    const Component component = component_of(accessor.at("componentType").get<std::int64_t>());
    const std::size_t count = accessor.at("count").get<std::size_t>();
    std::vector<double> values;
    if (accessor.contains("bufferView"))
        values = values_in(document, accessor, count, component);
    else if (count <= document.binary.size()) // nothing but zeros: not to be asked for without end
        values.assign(count, 0);
    else
        throw std::out_of_range("accessor " + std::to_string(index) + " names " + std::to_string(count) +
                                " zeros, more than the file has bytes");
    if (accessor.contains("sparse")) {
        const Json& sparse = accessor["sparse"];
        const std::size_t changed = sparse.at("count").get<std::size_t>();
        const Json& places = sparse.at("indices");
        const std::vector<double> at = values_in(document, places, changed,
                                                 component_of(places.at("componentType").get<std::int64_t>())),
                                  to = values_in(document, sparse.at("values"), changed, component);
        for (std::size_t k = 0; k < changed; ++k) {
            if (!(at[k] >= 0 && at[k] < double(count)))
                throw std::out_of_range("a sparse array changes a number that is not there");
            values[std::size_t(at[k])] = to[k];
        }
    }
    if (accessor.value("normalized", false) && !component.real)
        for (double& value : values) value = std::max(-1.0, value / component.most);
    return values;
}

} // namespace bough
