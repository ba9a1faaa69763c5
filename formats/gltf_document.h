// gltf_document.h: a glTF 2.0 file (.glb or .gltf) of another program as its JSON, untouched, and one buffer: what is
// read of it, and what is written again with something added (private to formats/).
//
// Buffers beside the file and in data: URIs are laid one after another into the binary chunk, each from a multiple of 4,
// and the views' places moved with them; nothing in them is decoded. Buffers without bytes (the fallbacks of
// EXT_meshopt_compression) stay as they are. All other JSON, extensions and extras too, keeps its order and its numbers.
#pragma once
#include "import.h"
#include <nlohmann/json.hpp>

namespace bough {

struct GltfDocument {
    nlohmann::ordered_json json;
    std::string binary; // of buffer 0
};

enum class GltfImages { leave, embed };

// `folder`: where files that the JSON names stand, "": none are found. `embed`: images beside the file come into the
// binary chunk; one that cannot be read keeps its name, with a note. O(size of all files).
// Throws InputError (place `name`): no glTF 2.0, JSON that is broken or nested deeper than 200, a chunk, buffer or view
// that is cut off, a buffer that cannot be found.
GltfDocument read_gltf(std::string_view content, const std::string& name, const std::string& folder, GltfImages,
                       ImportNotes&);

// The type of an image that begins with these bytes ("image/png", jpeg, webp, ktx2), or null.
const char* image_type(std::string_view bytes);

// Appends an array to the binary chunk from a multiple of 4: its view, and an accessor of `count` floats or vectors
// ("SCALAR", "VEC3", "VEC4", "MAT4"). Returns the accessor's index.
std::size_t add_floats(GltfDocument&, const std::vector<float>&, const char* type, bool with_bounds);

// As a .glb; the JSON then says the buffer's size. Throws OutputError beyond its 4 GiB.
std::string glb_of(GltfDocument&, const std::string& output_name);

} // namespace bough
