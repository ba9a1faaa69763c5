// Pictures as PNG are what libpng's reader finds in them, in few bytes where they are plain.
#include "formats/exports/png_image.h"
#include <catch2/catch.hpp>
#include <png.h>
#include <random>

using namespace bough;

namespace {

struct Picture {
    int width, height, channels;
    std::vector<std::uint8_t> pixels;
};

// `of` colours in all, by chance.
Picture picture(int width, int height, int channels, unsigned of) {
    std::mt19937 dice(of);
    std::vector<std::uint8_t> colors(std::size_t(channels) * of);
    for (std::size_t k = 0; k < of; ++k) {
        colors[std::size_t(channels) * k] = std::uint8_t(k);
        colors[std::size_t(channels) * k + 1] = std::uint8_t(k >> 8);
        for (int c = 2; c < channels; ++c) colors[std::size_t(channels) * k + std::size_t(c)] = std::uint8_t(dice());
    }
    Picture made{width, height, channels, {}};
    for (int k = 0; k < width * height; ++k) {
        const std::size_t color = unsigned(k) < of ? std::size_t(k) : dice() % of;
        made.pixels.insert(made.pixels.end(), colors.begin() + std::ptrdiff_t(std::size_t(channels) * color),
                           colors.begin() + std::ptrdiff_t(std::size_t(channels) * (color + 1)));
    }
    return made;
}

void check_read(const Picture& of, const std::string& bytes, bool palette) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    CHECK(int(image.width) == of.width);
    CHECK(int(image.height) == of.height);
    CHECK(((image.format & PNG_FORMAT_FLAG_COLORMAP) != 0) == palette);
    CHECK(((image.format & PNG_FORMAT_FLAG_ALPHA) != 0) == (of.channels == 4));
    image.format = of.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr));
    CHECK(read == of.pixels);
}

} // namespace

TEST_CASE("a PNG holds every pixel, as a palette up to 256 colours") {
    for (const int channels : {3, 4})
        for (const unsigned colors : {1u, 2u, 255u, 256u, 257u, 3000u}) {
            const Picture of = picture(71, 53, channels, colors);
            check_read(of, png_of(of.width, of.height, of.channels, of.pixels), colors <= 256);
        }
    const Picture one{1, 1, 3, {1, 2, 3}};
    check_read(one, png_of(1, 1, 3, one.pixels), true);
}

TEST_CASE("even areas of many colours are packed as they are, slopes by what they differ from their neighbours") {
    Picture even = picture(256, 256, 3, 600), slope{256, 256, 3, {}};
    for (std::size_t k = 2048; k < even.pixels.size(); ++k) even.pixels[k] = even.pixels[k % 96];
    for (int k = 0; k < 256 * 256; ++k)
        for (const int step : {1, 2, 5}) slope.pixels.push_back(std::uint8_t((k % 256) * step + (k / 256) * 3));
    for (const Picture* of : {&even, &slope}) {
        const std::string bytes = png_of(of->width, of->height, of->channels, of->pixels);
        check_read(*of, bytes, false);
        CHECK(bytes.size() < of->pixels.size() / 30);
    }
}
