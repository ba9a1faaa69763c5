// texture_file.h: an image that a tree's file names, found, looked at, and as PNG or JPEG, which are what glTF holds.
//
// Where it is looked for: where the name leads (as it is if absolute, else from the folder of the file that names it), unless that is out of the
// folder (inside.h), then under its bare name in that folder, both without regard to capitals where there is no exact match; names written on
// Windows are understood.
// PNG and JPEG stay byte for byte; TGA, BMP, TIFF and whatever else stb_image reads are decoded and written as PNG.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace bough {

struct Pixels {
    int width = 0, height = 0, channels = 0; // channels of the file, 1 to 4
    std::vector<std::uint8_t> rgba;          // 4 bytes a pixel, from the top row down
    bool transparent() const;                // any pixel less than opaque
};

// Where a texture was looked for in vain.
struct TexturePlaces {
    std::vector<std::string> tried;
    std::string folder;  // of them the first that is a folder, "": none
    std::string outside; // the first place that was not looked at, as it is out of the folder; "": none
};

// Finds the textures of one file. A folder's entries are read once, when a name is not there as it is written.
class TextureFinder {
public:
    explicit TextureFinder(std::string folder)
        : folder_(std::move(folder)) {} // of the file that names them; "": there is none
    // The path of the file, "" if there is none that may be opened; `looked` gets the places that were tried. Of several that differ in capitals
    // alone the first by its bytes that may be opened. O(log of the folder's entries) but for the first name that is not there.
    std::string find(const std::string& name, TexturePlaces& looked);

private:
    std::string existing(const std::string& path);

    std::string folder_;
    // Folder -> a name in small letters -> paths
    std::map<std::string, std::map<std::string, std::set<std::string>>> listed_;
};

// What kind of image the file is, by its first bytes, where it is one that games and the web use and that is not read here: "DDS", "KTX", "WebP",
// "OpenEXR"; "" for others.
std::string unread_kind(const std::string& path);

struct Texture {
    std::string bytes, type; // of the file if it is PNG or JPEG, else empty
    Pixels pixels;
};
// Throws InputError with the path and `named_by` for what is no image, or half of one.
Texture read_texture(const std::string& path, const std::string& named_by);

// One channel of an image at another's size, by the nearest pixel.
std::uint8_t channel_at(const Pixels&, int channel, int x, int y, int width, int height);

} // namespace bough
