#include "formats/models/texture_file.h"
#include "fuzzing.h"
#include <sys/mman.h>
#include <unistd.h>

using namespace bough;

namespace {

// A file in memory: its name, which is the same for all.
const std::string& file_of(const std::uint8_t* data, std::size_t size) {
    static const int file = ::memfd_create("texture", 0);
    static const std::string name = "/proc/self/fd/" + std::to_string(file);
    if (file < 0 || ::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != ssize_t(size))
        fuzzing::fail("no file in memory");
    return name;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string& name = file_of(data, size);
    fuzzing::is_read(
        fuzzing::content_of(data, size),
        [&](std::string_view) {
            const Texture texture = read_texture(name, "a test");
            const Pixels& pixels = texture.pixels;
            if (pixels.rgba.size() != 4 * std::size_t(pixels.width) * std::size_t(pixels.height))
                fuzzing::fail("an image of another size than it says");
            if (pixels.width > 0 && pixels.height > 0)
                channel_at(pixels, 3, pixels.width, pixels.height, pixels.width + 1, pixels.height + 1);
        },
        70000);
    return 0;
}
