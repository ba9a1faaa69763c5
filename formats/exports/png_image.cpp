#include "png_image.h"
#include "png_file.h"
#include <new>
#include <unordered_map>

namespace bough {
namespace {

constexpr std::size_t most_tried_twice = 1 << 22; // bytes: where another try takes a fifth of a second

// Colours in the order in which they are seen first, and each pixel's number; no colours where there are more than 256.
struct Palette {
    std::vector<std::uint8_t> colors, index;
};

Palette palette_of(std::size_t channels, const std::vector<std::uint8_t>& pixels) {
    Palette palette;
    std::unordered_map<std::uint32_t, std::uint8_t> number;
    palette.index.reserve(pixels.size() / channels);
    for (std::size_t at = 0; at < pixels.size(); at += channels) {
        std::uint32_t key = 0;
        for (std::size_t c = 0; c < channels; ++c) key = key << 8 | pixels[at + c];
        const auto found = number.find(key);
        if (found != number.end()) {
            palette.index.push_back(found->second);
            continue;
        }
        if (number.size() == 256) return {};
        const auto next = std::uint8_t(number.size());
        number.emplace(key, next);
        palette.index.push_back(next);
        palette.colors.insert(palette.colors.end(), pixels.begin() + std::ptrdiff_t(at),
                              pixels.begin() + std::ptrdiff_t(at + channels));
    }
    return palette;
}

std::string written(const PngForm& form, const std::vector<std::uint8_t>& rows) {
    std::string bytes;
    PngFile png(bytes, form);
    bool right = png.begin();
    for (std::size_t y = 0; right && y < form.height; ++y)
        right = png.add_row(rows.data() + rows.size() / form.height * y);
    if (!right || !png.end()) throw std::bad_alloc();
    return bytes;
}

} // namespace

std::string png_of(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
    PngForm form{.width = std::uint32_t(width), .height = std::uint32_t(height), .channels = channels};
    Palette palette = palette_of(std::size_t(channels), pixels);
    if (!palette.colors.empty()) {
        form.colors = std::move(palette.colors);
        return written(form, palette.index);
    }
    std::string bytes = written(form, pixels);
    if (pixels.size() > most_tried_twice) return bytes;
    form.unfiltered = true;
    const std::string other = written(form, pixels);
    return other.size() < bytes.size() ? other : bytes;
}

} // namespace bough
