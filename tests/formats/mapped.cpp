// Inputs that are looked at where they lie (mapped.h).
#include "formats/mapped.h"
#include "formats/documents/splines.h"
#include "tests/support/import_support.h"
#include <filesystem>
#include <unistd.h>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

namespace {

struct MappedFolder {
    fs::path path = fs::temp_directory_path() / ("bough_mapped_" + std::to_string(::getpid()));
    MappedFolder() { fs::create_directory(path); }
    ~MappedFolder() { fs::remove_all(path); }
};

// [kB] of the mapping that begins at `address` that are in memory for this process, as the system says; -1: there is none.
long in_memory(const char* address) {
    std::ostringstream wanted;
    wanted << std::hex << reinterpret_cast<std::uintptr_t>(address) << "-";
    std::ifstream mappings("/proc/self/smaps");
    bool found = false;
    for (std::string line; std::getline(mappings, line);) {
        found = found || line.starts_with(wanted.str());
        if (found && line.starts_with("Rss:")) return std::stol(line.substr(4));
    }
    return -1;
}

std::string written(const Splines& splines, const fs::path& file) {
    Output output(file);
    write_splines(output, splines, Form::safetensors);
    output.finish();
    return content_of(file);
}

} // namespace

TEST_CASE("pages that are given back are in memory no more, and come back when they are looked at") {
    const MappedFolder folder;
    std::string text(1 << 20, 'a');
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = char('a' + i % 23);
    std::ofstream(folder.path / "input") << text;
    const MappedInput file(folder.path / "input");
    const char* const first = file.content().data();
    REQUIRE(file.content() == text);
    CHECK(in_memory(first) == 1024);
    file.give_back();
    CHECK(in_memory(first) == 0);
    CHECK(file.content() == text);
    CHECK(in_memory(first) == 1024);
}

TEST_CASE("a file whose pages are given back when it has been taken in gives the tree that it gives from memory") {
    const MappedFolder folder;
    std::size_t files = 0, gave = 0;
    for (const auto& entry : fs::directory_iterator(std::string(BOUGH_DATA_DIR) + "/fixtures")) {
        const std::string name = entry.path().filename(), content = content_of(entry.path());
        CAPTURE(name);
        ImportOptions options;
        options.name = name;
        options.folder = entry.path().parent_path();
        ImportNotes notes, later;
        std::string direct;
        try {
            direct = written(import_splines(content, options, notes), folder.path / "tree");
        } catch (const InputError&) {
            continue; // parameters of generators, a part of another file
        }
        const MappedInput file(entry.path());
        bool given = false;
        options.taken_in = [&] {
            file.give_back();
            given = true;
        };
        CHECK(written(import_splines(file.content(), options, later), folder.path / "tree") == direct);
        CHECK(later.lines == notes.lines);
        ++files, gave += given;
    }
    CHECK(files >= 15);
    CHECK(gave >= 5); // SpeedTree, OBJ, curves
}

TEST_CASE("an input written to while it is read is refused when all has been read") {
    const MappedFolder folder;
    const std::string input = folder.path / "input";
    std::ofstream(input) << "of three"; // within a page, of which a cut leaves zeros
    {
        const MappedInput file(input);
        CHECK(file.content() == "of three");
        CHECK_NOTHROW(file.check());
        fs::resize_file(input, 2);
        CHECK_THROWS_WITH(file.check(), input + ": was written to while it was read, expected a finished file");
    }
    {
        const MappedInput file(input);
        std::ofstream(folder.path / "new") << "another";
        fs::rename(folder.path / "new", input); // as tools write: what was opened stays as it was
        CHECK(file.content() == "of");
        CHECK_NOTHROW(file.check());
    }
}
