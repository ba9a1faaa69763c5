// png_image.h: pictures as PNG.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

// The bytes of a PNG of 8 bits a channel, 3 (RGB) or 4 (RGBA), rows from the top. Nothing is lost; of up to 256 colours a palette is written, which
// takes half the bytes of a bark. Throws std::bad_alloc.
std::string png_of(int width, int height, int channels, const std::vector<std::uint8_t>& pixels);

} // namespace bough
