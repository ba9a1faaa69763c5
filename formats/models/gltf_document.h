// gltf_document.h: a glTF 2.0 file (.glb or .gltf) of another program as its JSON, untouched, and one buffer: what is
// read of it, and what is written again with something added (private to this folder).
//
// Buffers beside the file and in data: URIs are laid one after another into the binary chunk, each from a multiple of 4,
// and the views' places moved with them; nothing in them is decoded. Buffers without bytes (the fallbacks of
// EXT_meshopt_compression) stay as they are. All other JSON, extensions and extras too, keeps its order and its numbers.
#pragma once
#include "formats/error.h"
#include "formats/imports/import.h"
#include <nlohmann/json.hpp>

namespace bough {

struct GltfDocument {
    nlohmann::ordered_json json;
    std::string binary;                     // of buffer 0
    std::size_t text = 0;                   // [bytes] of the JSON that was read
    mutable std::uint64_t numbers_read = 0; // by values_of (gltf_accessor.h), which bounds them
};

enum class GltfImages { leave, embed };

// An image beside a model that calls itself PNG or JPEG and is neither.
struct ImageError : InputError {
    using InputError::InputError;
};

// `folder`: where files that the JSON names stand, "": none are found. `embed`: images beside the file come into the
// binary chunk; one that cannot be read keeps its name, with a note. O(size of all files).
// Throws InputError (place `name`): no glTF 2.0, JSON that is broken or nested deeper than 200, a chunk, buffer or view
// that is cut off, a buffer that cannot be found; ImageError. Memory that runs out is std::bad_alloc.
GltfDocument read_gltf(std::string_view content, const std::string& name, const std::string& folder, GltfImages,
                       ImportNotes&);

// The whole number that an object, which messages call `place`, holds under a key; `otherwise` where it has no such key.
// Throws std::out_of_range: another number, or none ("PLACE: KEY is 1.5, expected a whole number"); Json exceptions for a
// key that is missing, or what is no object.
std::size_t whole_number(const nlohmann::ordered_json& object, const char* key, const std::string& place);
std::size_t whole_number(const nlohmann::ordered_json& object, const char* key, const std::string& place,
                         std::size_t otherwise);

// The index of something of which there are `end`: that a JSON value holds which messages call `what`, or an object under
// a key. Throws as whole_number does, and std::out_of_range for one that is too large ("WHAT is 7, expected less than 5").
std::size_t checked_index(const nlohmann::ordered_json& value, const std::string& what, std::size_t end);
std::size_t index_of(const nlohmann::ordered_json& object, const char* key, const std::string& place, std::size_t end);

// How many entries a list of the document has ("accessors"); 0 where there is no such list.
std::size_t entries_of(const nlohmann::ordered_json& document, const char* list);

// The type of an image that begins with these bytes ("image/png", jpeg, webp, ktx2), or null.
const char* image_type(std::string_view bytes);

// Appends an array to the binary chunk from a multiple of 4: its view, and an accessor of `count` floats or vectors
// ("SCALAR", "VEC3", "VEC4", "MAT4"). Returns the accessor's index.
std::size_t add_floats(GltfDocument&, const std::vector<float>&, const char* type, bool with_bounds);

// The same of unsigned shorts.
std::size_t add_shorts(GltfDocument&, const std::vector<std::uint16_t>&, const char* type);

// As a .glb; the JSON then says the buffer's size. Throws OutputError beyond its 4 GiB.
std::string glb_of(GltfDocument&, const std::string& output_name);

} // namespace bough
