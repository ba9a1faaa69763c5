// A glTF file in a folder: buffers and images beside it, and a file above it, which nothing may reach.
#include "formats/imports/import_notes.h"
#include "formats/inside.h"
#include "formats/models/gltf_document.h"
#include "fuzzing.h"
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace bough;
namespace fs = std::filesystem;

namespace {

constexpr const char* secret = "no file of the folder's";

// What stands beside the file: a.bin, a.png, below/b.bin, and links out and in. It is left to the system's temporary files.
struct Beside {
    std::string folder;
    std::size_t bytes = 0;

    Beside() {
        const fs::path top = fs::temp_directory_path() / ("bough-fuzz-" + std::to_string(::getpid()));
        fs::remove_all(top); // of an earlier process of that number
        folder = (top / "own").string();
        fs::create_directories(folder + "/below");
        put(top / "secret.bin", secret);
        put(folder + "/a.bin", std::string(4096, '\1'));
        put(folder + "/below/b.bin", std::string(100, '\2'));
        put(folder + "/a.png", "\x89PNG\r\n\x1a\n" + std::string(60, '\0'));
        fs::create_symlink("../secret.bin", folder + "/out.bin");
        fs::create_symlink("a.bin", folder + "/in.bin");
    }
    void put(const fs::path& path, const std::string& content) {
        std::ofstream(path, std::ios::binary) << content;
        bytes += content.size();
    }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Beside beside;
    const std::string_view content = fuzzing::content_of(data, size);
    constexpr std::size_t for_each_byte = 1000;
    for (const GltfImages images : {GltfImages::leave, GltfImages::embed})
        fuzzing::is_read(
            content,
            [&](std::string_view text) {
                ImportNotes notes;
                const GltfDocument document = read_gltf(text, "file", beside.folder, images, notes);
                if (document.binary.find(secret) != std::string::npos && text.find(secret) == std::string_view::npos)
                    fuzzing::fail("a file outside the folder was read");
                for (const std::string& line : notes.lines) fuzzing::check_message(line, content);
            },
            for_each_byte);
    static std::size_t known = 0; // names are only added
    const std::set<std::string> named = named_files_read();
    if (named.size() > known)
        for (const std::string& file : named)
            if (!fs::canonical(file).string().starts_with(fs::canonical(beside.folder).string() + "/"))
                fuzzing::fail("a file outside the folder was read: " + file);
    known = named.size();
    return 0;
}
