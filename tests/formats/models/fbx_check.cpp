// fbx_check.h: a file laid out here by the format's own rules passes; each number made wrong is named with its place.
#include "formats/models/fbx_check.h"
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>
#include <zlib.h>

namespace {

template <class T> std::string bytes_of(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class T> std::string array_of(char type, const std::vector<T>& numbers, bool packed = false) {
    const std::string raw(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    std::string data = raw;
    if (packed) {
        uLongf size = ::compressBound(uLong(raw.size()));
        data.resize(size);
        ::compress(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
                   uLong(raw.size()));
        data.resize(size);
    }
    return type + bytes_of(std::uint32_t(numbers.size())) + bytes_of(std::uint32_t(packed)) +
           bytes_of(std::uint32_t(data.size())) + data;
}

std::string named(const std::string& name) {
    const std::string text = name + std::string("\0\1", 2) + "Kind";
    return "L" + bytes_of(std::uint64_t(7)) + "S" + bytes_of(std::uint32_t(text.size())) + text;
}

struct Made {
    std::string name, properties;
    std::uint32_t count = 1;
    std::vector<Made> records{};
};

void put(std::string& file, const Made& made, bool wide) {
    const std::size_t first = file.size();
    const auto field = [&](std::uint64_t value) {
        return wide ? bytes_of(value) : bytes_of(static_cast<std::uint32_t>(value));
    };
    file += field(0) + field(made.count) + field(made.properties.size()) + char(made.name.size()) + made.name +
            made.properties;
    for (const Made& record : made.records) put(file, record, wide);
    if (!made.records.empty()) file += std::string(wide ? 25 : 13, '\0');
    const std::string end = field(file.size());
    file.replace(first, end.size(), end);
}

struct Numbers {
    std::vector<double> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0}, normals{0, 0, 1}, weights{1, 0.5},
        link = std::vector<double>(16, 1.0);
    std::vector<std::int32_t> polygons{0, 1, -3}, indexes{0, 2};
    bool packed = false;
};

std::string file_of(const Numbers& n, bool wide) {
    std::string file = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + bytes_of(std::uint32_t(wide ? 7500 : 7400));
    const Made geometry{"Geometry",
                        named("bark"),
                        2,
                        {{"Vertices", array_of('d', n.vertices, n.packed)},
                         {"PolygonVertexIndex", array_of('i', n.polygons, n.packed)},
                         {"LayerElementNormal", "", 0, {{"Normals", array_of('d', n.normals)}}}}};
    const Made deformer{"Deformer",
                        named("bone"),
                        2,
                        {{"Indexes", array_of('i', n.indexes)},
                         {"Weights", array_of('d', n.weights, n.packed)},
                         {"TransformLink", array_of('d', n.link)}}};
    put(file, {"Objects", "", 0, {deformer, geometry}}, wide); // in whatever order
    return file + std::string(wide ? 25 : 13, '\0');
}

std::string fbx_refusal(const std::string& content) {
    try {
        bough::check_fbx(content);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::string with(const std::function<void(Numbers&)>& change) {
    Numbers numbers;
    change(numbers);
    const std::string first = fbx_refusal(file_of(numbers, false));
    numbers.packed = true;
    CHECK(fbx_refusal(file_of(numbers, true)) == first);
    return first;
}

} // namespace

TEST_CASE("binary FBX that is whole passes, and text is left to its reader") {
    CHECK(with([](Numbers&) {}) == "");
    CHECK(fbx_refusal("; FBX 7.4.0 project file\n") == "");
    CHECK(fbx_refusal("") == "");
}

TEST_CASE("FBX indices and numbers that are out of range are named with their place") {
    CHECK(with([](Numbers& n) { n.polygons[1] = 3; }) ==
          "geometry \"bark\": PolygonVertexIndex names vertex 3 as number 1, expected 0 to less than 3");
    CHECK(with([](Numbers& n) { n.polygons[2] = -4; }) ==
          "geometry \"bark\": PolygonVertexIndex names vertex 3 as number 2, expected 0 to less than 3");
    CHECK(with([](Numbers& n) { n.vertices[4] = std::nan(""); }) ==
          "geometry \"bark\": Vertices has a number that is not finite, number 4");
    CHECK(with([](Numbers& n) { n.normals[2] = INFINITY; }) ==
          "geometry \"bark\": Normals has a number that is not finite, number 2");
    CHECK(with([](Numbers& n) { n.vertices.clear(); }) == "geometry \"bark\": has no vertices, but polygons of them");
    CHECK(with([](Numbers& n) { n.indexes[1] = 3; }) ==
          "deformer \"bone\": Indexes names vertex 3 as number 1, expected 0 to less than 3");
    CHECK(with([](Numbers& n) { n.indexes[0] = -1; }) ==
          "deformer \"bone\": Indexes names vertex -1 as number 0, expected 0 to less than 3");
    CHECK(with([](Numbers& n) { n.weights[0] = std::nan(""); }) ==
          "deformer \"bone\": Weights has a number that is not finite, number 0");
    CHECK(with([](Numbers& n) { n.link[15] = std::nan(""); }) ==
          "deformer \"bone\": TransformLink has a number that is not finite, number 15");
    CHECK(with([](Numbers& n) { n.weights.pop_back(); }) == "deformer \"bone\": has 1 Weights for 2 Indexes");
}

TEST_CASE("What an FBX calls a record is one line of ASCII in a refusal") {
    Numbers numbers;
    numbers.link[15] = std::nan("");
    std::string file = file_of(numbers, false);
    file[file.find("TransformLink") + 9] = '\n';
    CHECK(fbx_refusal(file) == R"(deformer "bone": "Transform?ink" has a number that is not finite, number 15)");
}

TEST_CASE("FBX that is cut anywhere, or says that it is longer, is refused by its byte and never read beyond its end") {
    for (const bool wide : {false, true}) {
        const std::string whole = file_of({}, wide);
        for (std::size_t size = 28; size < whole.size() - (wide ? 25 : 13); ++size)
            CHECK_THAT(fbx_refusal(std::string(whole.data(), size)), Catch::StartsWith("byte "));
        for (std::size_t at = 27; at < whole.size(); ++at) // whatever it says, it ends
            for (const char other : {'\xff', '\x7f', '\0'}) {
                std::string changed = whole;
                changed[at] = other;
                fbx_refusal(changed);
            }
    }
}
