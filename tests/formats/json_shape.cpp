// Depth and names of JSON beside a reader's own: nlohmann's callback tells the depth of each value.
#include "formats/json_shape.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>

using namespace bough;
using nlohmann::json;

namespace {

json any(std::mt19937& engine, int depth) {
    static const std::vector<std::string> texts{"a", "{[:\"", "\\", "]}", "\\\"{", ""};
    switch (depth > 0 ? engine() % 4 : 3) {
    case 0:
    case 1: {
        json list = json::array();
        for (auto k = engine() % 4; k > 0; --k) list.push_back(any(engine, depth - 1));
        return list;
    }
    case 2: {
        json object = json::object();
        for (auto k = engine() % 5; k > 0; --k)
            object[texts[engine() % 6] + std::to_string(k)] = any(engine, depth - 1);
        return object;
    }
    default:
        return engine() % 2 ? json(texts[engine() % 6]) : json(1.5);
    }
}

void measure(const json& value, std::size_t depth, JsonShape& shape) {
    if (!value.is_structured()) return;
    shape.depth = std::max(shape.depth, depth + 1);
    if (value.is_object()) shape.names = std::max(shape.names, value.size());
    for (const json& part : value) measure(part, depth + 1, shape);
}

} // namespace

TEST_CASE("depth and names of JSON are those of the values it holds") {
    std::mt19937 engine(3);
    for (int k = 0; k < 2000; ++k) {
        const json value = any(engine, int(engine() % 9));
        JsonShape wanted;
        measure(value, 0, wanted);
        const std::string text = value.dump(k % 2 ? 1 : -1);
        const JsonShape shape = json_shape(text);
        INFO(text);
        CHECK(shape.depth == wanted.depth);
        CHECK(shape.names == wanted.names);
    }
}

TEST_CASE("of broken text something is told all the same") {
    CHECK(json_shape("").depth == 0);
    CHECK(json_shape("]]}}{").depth == 1);
    CHECK(json_shape("{\"a").names == 0);
    CHECK(json_shape("\"\\").depth == 0);
    CHECK(json_shape(std::string(1000000, '[')).depth == 1000000);
}
