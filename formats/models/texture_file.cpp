#include "texture_file.h"
#include "formats/inside.h"
#include "formats/open.h"
#include "formats/plain_text.h"
#include "gltf_document.h"
#include "jpeg_check.h"
#include "png_check.h"
#include "tga_check.h"
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tiffio.h>

// Debian's stb, whose code comes with its header; its warnings are its own.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wpedantic"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-align"
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#else
#pragma GCC diagnostic ignored "-Wstringop-overflow"
#pragma GCC diagnostic ignored "-Wuseless-cast"
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace bough {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

// The regular files of a folder by their names in small letters.
std::map<std::string, std::set<std::string>> files_of(const fs::path& folder) {
    std::map<std::string, std::set<std::string>> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (std::error_code none; entry->is_regular_file(none))
            found[lower_case(entry->path().filename().string())].insert(entry->path().string());
    return found;
}

// A TIFF in memory, as libtiff wants to read it.
struct Bytes {
    const std::string* content;
    toff_t at = 0;
};
tsize_t tiff_read(thandle_t handle, tdata_t to, tsize_t count) {
    auto& bytes = *static_cast<Bytes*>(handle);
    const toff_t left = bytes.at < bytes.content->size() ? bytes.content->size() - bytes.at : 0;
    const tsize_t taken = std::min<tsize_t>(count, tsize_t(left));
    std::memcpy(to, bytes.content->data() + bytes.at, std::size_t(taken));
    bytes.at += toff_t(taken);
    return taken;
}
toff_t tiff_seek(thandle_t handle, toff_t offset, int whence) {
    auto& bytes = *static_cast<Bytes*>(handle);
    bytes.at = offset + (whence == SEEK_CUR ? bytes.at : whence == SEEK_END ? toff_t(bytes.content->size()) : 0);
    return bytes.at;
}

constexpr std::uint64_t most_pixels = std::uint64_t(1) << 29, // what 2 GB hold
    most_of_byte = 8256;                                      // as many as PNG packs into one

// Whether an image that says that it is so large may be one of a file of `bytes`: memory is asked for only then.
bool may_hold(std::uint64_t width, std::uint64_t height, std::size_t bytes, std::string& why) {
    const std::uint64_t pixels = width * height;
    if (pixels > most_pixels)
        why = "it is too large";
    else if (pixels / most_of_byte > bytes)
        why = "it says that it is " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels, more than its " + std::to_string(bytes) + " bytes can hold";
    else
        return true;
    return false;
}

bool decode_tiff(const std::string& content, Pixels& pixels, std::string& why) {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    Bytes bytes{&content};
    TIFF* const tiff = TIFFClientOpen(
        "tiff", "rm", &bytes, tiff_read, [](thandle_t, tdata_t, tsize_t) -> tsize_t { return 0; }, tiff_seek,
        [](thandle_t) { return 0; },
        [](thandle_t handle) { return toff_t(static_cast<Bytes*>(handle)->content->size()); },
        [](thandle_t, tdata_t*, toff_t*) { return 0; }, [](thandle_t, tdata_t, toff_t) {});
    why = "it is broken";
    if (!tiff) return false;
    std::uint32_t width = 0, height = 0;
    std::uint16_t samples = 1;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    bool good = width > 0 && height > 0 && may_hold(width, height, content.size(), why);
    if (good) {
        pixels.width = int(width), pixels.height = int(height), pixels.channels = std::clamp<int>(samples, 1, 4);
        std::vector<std::uint32_t> raster(std::size_t(width) * height);
        good = TIFFReadRGBAImageOriented(tiff, width, height, raster.data(), ORIENTATION_TOPLEFT, 1) != 0;
        pixels.rgba.resize(4 * raster.size());
        for (std::size_t k = 0; k < raster.size(); ++k)
            for (int c = 0; c < 4; ++c) pixels.rgba[4 * k + std::size_t(c)] = std::uint8_t(raster[k] >> (8 * c) & 255);
    }
    TIFFClose(tiff);
    return good;
}

bool decode(const std::string& content, Pixels& pixels, std::string& why) {
    if (content.starts_with(std::string("II*\0", 4)) || content.starts_with(std::string("MM\0*", 4)))
        return decode_tiff(content, pixels, why);
    if (content.starts_with("\xFF") && !jpeg_tables_fit(content)) {
        why = "a table of its segments does not fit";
        return false;
    }
    const auto* const data = reinterpret_cast<const stbi_uc*>(content.data());
    why = "of no kind that is known";
    if (content.size() > std::size_t(std::numeric_limits<int>::max())) return false;
    const int size = int(content.size());
    if (stbi_info_from_memory(data, size, &pixels.width, &pixels.height, &pixels.channels) &&
        !may_hold(std::uint64_t(pixels.width), std::uint64_t(pixels.height), content.size(), why))
        return false;
    for (const auto defect_of : {png_defect, tga_defect})
        if (std::string defect = defect_of(content); !defect.empty()) {
            why = std::move(defect);
            return false;
        }
    stbi_uc* const read = stbi_load_from_memory(data, size, &pixels.width, &pixels.height, &pixels.channels, 4);
    if (!read) {
        if (const char* reason = stbi_failure_reason()) why = valid_utf8(reason); // it may repeat the file
        return false;
    }
    pixels.rgba.assign(read, read + 4 * std::size_t(pixels.width) * std::size_t(pixels.height));
    stbi_image_free(read);
    return true;
}

} // namespace

bool Pixels::transparent() const {
    for (std::size_t k = 3; k < rgba.size(); k += 4)
        if (rgba[k] < 255) return true;
    return false;
}

// The path itself, or what its folder has under that name but for capitals.
std::string TextureFinder::existing(const std::string& path) {
    std::error_code error;
    const fs::path file(path);
    if (fs::is_regular_file(file, error)) return path;
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    auto listed = listed_.find(folder);
    if (listed == listed_.end()) listed = listed_.emplace(folder, files_of(folder)).first;
    const auto found = listed->second.find(lower_case(file.filename().string()));
    if (found == listed->second.end()) return "";
    for (const std::string& each : found->second)
        if (within_reach(each, folder_)) return each;
    return *found->second.begin();
}

std::string TextureFinder::find(const std::string& name, TexturePlaces& looked) {
    const std::string file = with_slashes(name);
    const bool absolute = file.starts_with("/") || (file.size() > 2 && file[1] == ':' && file[2] == '/');
    std::vector<fs::path> places;
    if (absolute || !folder_.empty()) places.push_back(absolute ? fs::path(file) : fs::path(folder_) / file);
    if (const fs::path bare = fs::path(file).filename(); !folder_.empty() && !bare.empty())
        if (places.empty() || places[0] != fs::path(folder_) / bare) places.push_back(fs::path(folder_) / bare);
    for (const fs::path& place : places) {
        std::string outside = place.string(); // which is not looked at
        if (within_reach(outside, folder_)) {
            outside = existing(place.string());
            if (outside.empty())
                looked.tried.push_back(place.string());
            else if (within_reach(outside, folder_)) // a name but for capitals may be a link
                return outside;
            std::error_code none;
            if (looked.folder.empty() && fs::is_directory(place, none)) looked.folder = place.string();
        }
        if (looked.outside.empty()) looked.outside = outside;
    }
    return "";
}

std::string unread_kind(const std::string& path) {
    std::string head(12, ' ');
    std::ifstream(path, std::ios::binary)
        .read(head.data(), std::streamsize(head.size())); // what cannot be opened is read_texture's to name
    if (head.starts_with("DDS ")) return "DDS";
    if (head.starts_with("\xABKTX ")) return "KTX";
    if (head.starts_with("RIFF") && head.ends_with("WEBP")) return "WebP";
    if (head.starts_with("\x76\x2F\x31\x01")) return "OpenEXR";
    return "";
}

Texture read_texture(const std::string& path, const std::string& named_by) {
    Texture texture;
    texture.bytes = read_input(path);
    note_named_file(path);
    std::string why;
    if (texture.bytes.empty() || !decode(texture.bytes, texture.pixels, why))
        throw InputError(path, "is no image that can be read (" + (texture.bytes.empty() ? "it is empty" : why) +
                                   "), expected PNG, JPEG, TGA, TIFF or BMP; " + named_by + " names it");
    const char* const type = image_type(texture.bytes);
    const std::string_view kept = type ? type : "";
    if (kept == "image/png" || kept == "image/jpeg")
        texture.type = kept;
    else
        texture.bytes.clear();
    return texture;
}

std::uint8_t channel_at(const Pixels& pixels, int channel, int x, int y, int width, int height) {
    const auto at = [](int k, int of, int size) {
        return std::size_t((2 * std::int64_t(k) + 1) * size / (2 * std::int64_t(of)));
    };
    const std::size_t pixel = at(y, height, pixels.height) * std::size_t(pixels.width) + at(x, width, pixels.width);
    return pixels.rgba[4 * pixel + std::size_t(channel)];
}

} // namespace bough
