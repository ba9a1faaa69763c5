// gltf_accessor.h: numbers of a glTF document's accessors, in the shape that their use asks for (private to this folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// Which numbers an array may hold.
enum class GltfNumbers {
    any,
    floats,
    indices, // unsigned bytes, shorts or ints
    joints,  // unsigned bytes or shorts
    weights, // floats, or normalized unsigned bytes or shorts
};

// What an array is used as, and so how it must be shaped.
struct GltfUse {
    std::string place; // what a message calls it: "mesh 0, primitive 1: JOINTS_0"
    const char* type;  // of its elements: "SCALAR", "VEC2", "VEC3", "VEC4" or "MAT4"
    GltfNumbers numbers;
};

// "mesh 0, primitive 1".
std::string primitive_place(std::size_t mesh, std::size_t primitive);

// How many elements an accessor has, once it is found to be what it is used as. `accessor` is the JSON value that names it.
// A byteStride of 0, which the format does not know, means elements without gaps, as other readers take it. O(1).
// Throws std::out_of_range, beginning with the place: no such accessor, elements or numbers of another type, a stride less
// than an element, elements beyond their view or in a form that is not decoded here (EXT_meshopt_compression), a view
// whose bytes the file does not hold, more zeros than the file has bytes. Throws Json exceptions for what is missing or
// no number.
std::size_t count_of(const GltfDocument&, const nlohmann::ordered_json& accessor, const GltfUse&);

// How many numbers values_of reads of a document in all: a file may name one array as often as it likes, and each time takes memory.
constexpr std::uint64_t most_numbers(const GltfDocument& document) {
    return 1000000 + 32 * (std::uint64_t(document.text) + document.binary.size());
}

// Its numbers, an element after another (of a matrix a column after another): normalized ones from -1 or 0 to 1, sparse
// ones put in their places, all 0 where it has no view. O(count). Throws as count_of does, and std::out_of_range for a
// sparse element that is not there, and beyond most_numbers().
std::vector<double> values_of(const GltfDocument&, const nlohmann::ordered_json& accessor, const GltfUse&);

} // namespace bough
