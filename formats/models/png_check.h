// png_check.h: what is looked at in a PNG before stb_image reads it (private to this folder).
//
// stb_image asks for as much memory as a chunk of image data declares, up to 2 GB for a file of a hundred bytes.
#pragma once
#include <string>
#include <string_view>

namespace bough {

// Why a PNG's chunks do not fit into it: "" where they do, and for what is no PNG. O(chunks).
std::string png_defect(std::string_view file);

} // namespace bough
