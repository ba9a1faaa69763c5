// models.cpp: formats/models as a page has it: a file's textures are not looked for, since a page has no folder beside it. (Models that the tools
// alone read: left_to_tools.cpp.)
#include "formats/error.h"
#include "formats/exports/png_image.h"
#include "formats/models/texture_file.h"

namespace bough {

std::string TextureFinder::find(const std::string&, TexturePlaces&) {
    return "";
}
std::string unread_kind(const std::string&) {
    return "";
}
Texture read_texture(const std::string& path, const std::string&) {
    throw InputError(path, "is a texture, which this page does not read");
}
std::string png_of(int, int, int, const std::vector<std::uint8_t>&) {
    return "";
}
std::uint8_t channel_at(const Pixels&, int, int, int, int, int) {
    return 0;
}
bool Pixels::transparent() const {
    return false;
}

} // namespace bough
