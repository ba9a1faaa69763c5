// data_image.h: numbers from 0 to 1 as images that programs read back as numbers: no colour space, no gamma, nothing lost but by rounding.
#pragma once
#include "formats/open.h"
#include <functional>

namespace bough {

// Fills a row's pixels, red, green and blue in turn; rows from the top down, each asked for once.
using PixelRow = std::function<void(std::size_t row, float* rgb)>;

// OpenEXR: half floats (11 bits), ZIP. PNG: 16 bits. O(pixels), memory a row or some. Throws OutputError; what `row` throws.
void write_exr(Output&, std::size_t width, std::size_t height, const PixelRow& row);
void write_png16(Output&, std::size_t width, std::size_t height, const PixelRow& row);

} // namespace bough
