// Which file an output would be written to, and which outputs are one.
#include "formats/output_place.h"
#include "formats/open.h"
#include "tests/support/random_documents.h"
#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

namespace {

bool same(const std::string& one, const std::string& other) {
    return same_output(output_place(one), output_place(other));
}

} // namespace

TEST_CASE("a file that stands among devices is replaced, not written over") {
    if (!fs::is_directory("/dev/shm")) return;
    const std::string path = "/dev/shm/bough-test-" + std::to_string(::getpid());
    put(path, "old");
    CHECK(!output_place(path).direct);
    {
        Output output(path);
        output.write("half");
        output.flush();
        CHECK(read_input(path) == "old");
    }
    CHECK(read_input(path) == "old");
    fs::remove(path);
}

TEST_CASE("what is no file of its own is written directly") {
    const Folder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    fs::create_symlink("pipe", folder.path / "link");
    for (const std::string& path : {std::string("-"), folder / "pipe", folder / "link", std::string("/dev/null")}) {
        CAPTURE(path);
        CHECK(output_place(path).direct);
    }
    if (!fs::is_directory("/proc/self/fd")) return;
    const int log = ::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    REQUIRE(::write(log, "before\n", 7) == 7);
    fs::create_symlink("/dev/fd/" + std::to_string(log), folder.path / "descriptor");
    CHECK(output_place(folder / "descriptor").direct);
    Output output("/dev/fd/" + std::to_string(log));
    output.write("after\n");
    output.finish();
    ::close(log);
    CHECK(read_input(folder / "log") == "before\nafter\n");
}

TEST_CASE("outputs are one where they are one file, under whatever name") {
    const Folder folder;
    fs::create_directory(folder.path / "there");
    fs::create_directory_symlink("there", folder.path / "also");
    put(folder / "old", "");
    fs::create_symlink("old", folder.path / "link");
    fs::create_symlink("there/new", folder.path / "dangling");
    fs::create_hard_link(folder.path / "old", folder.path / "twin"); // replaced by itself
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(same(folder / "old", folder / "there/../old"));
    CHECK(same(folder / "old", folder / "link"));
    CHECK(same(folder / "there/new", folder / "also/new"));
    CHECK(same(folder / "there/new", folder / "dangling"));
    CHECK(same(folder / "pipe", folder / "there/../pipe"));
    CHECK(!same(folder / "old", folder / "twin"));
    CHECK(!same(folder / "old", folder / "new"));
    CHECK(!same(folder / "there/new", folder / "new"));
    CHECK(!same("/dev/null", "/dev/null"));
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    CHECK(same("new", "./new"));
    CHECK(same("new", folder / "new"));
    fs::current_path(before);
}

TEST_CASE("whether an output can be written is known beforehand, and nothing stays") {
    const Folder folder;
    require_output(folder / "new");
    require_output("-");
    require_output("/dev/null");
    CHECK(folder.files() == 0);
    CHECK_THROWS_WITH(require_output(folder / "no/where"), Catch::Contains("no/where: ") && Catch::Contains("No such"));
    CHECK_THROWS_WITH(require_output(folder.path.string()), Catch::Contains("directory"));
    put(folder / "file", "");
    CHECK_THROWS_AS(require_output(folder / "file/below"), OutputError);
    if (::geteuid() != 0) {
        ::chmod((folder / "file").c_str(), 0400);
        CHECK_THROWS_AS(require_output(folder / "file"), OutputError);
    }
}
