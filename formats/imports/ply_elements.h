// ply_elements.h: the elements of a PLY file, ascii or binary of either byte order, any types, lists included.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace bough {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;
    bool list = false;
    PlyType count = PlyType::u8; // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> property;
};

struct PlyHeader {
    enum class Form { ascii, little, big } form = Form::ascii;
    std::vector<PlyElement> element;
    std::size_t data = 0;  // offset of the first element's data
    std::size_t lines = 0; // of the header
};

// Throws InputError FILE:LINE for a header that is none, or names more elements than the file has bytes.
PlyHeader read_ply_header(std::string_view content, const std::string& name);

// The numbers of one entry of an element, property by property: values[first[k]] .. values[first[k + 1] - 1].
struct PlyEntry {
    std::vector<double> values;
    std::vector<std::size_t> first;
    std::string place() const; // where it stands, for messages
    const std::string* name = nullptr;
    const PlyElement* element = nullptr;
    std::uint64_t index = 0;
    std::size_t line = 0; // 0: binary
};

// Calls entry(element, values) for every entry of the elements that are wanted, in the file's order. O(bytes).
// Throws InputError for data that end early (FILE:LINE, in binary files FILE with element and index) or are no numbers.
void each_ply_entry(std::string_view content, const PlyHeader&, const std::string& name,
                    const std::function<bool(const PlyElement&)>& wanted,
                    const std::function<void(const PlyElement&, const PlyEntry&)>& entry);

} // namespace bough
