// json_shape.h: what text of JSON would take to read it as a tree of values, told before it is read.
#pragma once
#include <cstddef>
#include <string_view>

namespace bough {

struct JsonShape {
    std::size_t depth = 0; // most objects and lists within one another
    std::size_t names = 0; // most names in one object
};
// Of text that need not be whole or right. O(bytes).
JsonShape json_shape(std::string_view text);

// How deep values may be nested: they are copied, shown and taken down by functions that call themselves.
constexpr std::size_t deepest_json = 200;
inline constexpr const char* nested_too_deep = "is nested deeper than 200";

} // namespace bough
