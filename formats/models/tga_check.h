// tga_check.h: what is looked at in a TGA before stb_image reads it (private to this folder).
//
// stb_image draws what a file that was cut off lacks as it comes, and an index that its palette has not as the palette's first colour.
#pragma once
#include <string>
#include <string_view>

namespace bough {

// Why a TGA's pixels are not all there: "" where they are, and for what is no TGA. O(bytes).
std::string tga_defect(std::string_view file);

} // namespace bough
