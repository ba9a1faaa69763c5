// Files that are being written: where the file system has files without names, and where they have hidden ones.
#include "formats/temporary.h"
#include "formats/open.h"
#include "tests/support/random_documents.h"
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

namespace {

void write_to(const Temporary& file, const std::string& text) {
    REQUIRE(::write(file.file(), text.data(), text.size()) == ssize_t(text.size()));
}

// Whether the file system of a folder has files without names.
bool has_nameless(const Folder& folder) {
    const int file = ::open(folder.path.c_str(), O_RDWR | O_TMPFILE, 0600);
    if (file >= 0) ::close(file);
    return file >= 0;
}

} // namespace

TEST_CASE("a temporary file gets its name in one step, or nothing is left of it") {
    for (const bool nameless : {true, false}) {
        CAPTURE(nameless);
        const Folder folder;
        const std::size_t hidden = nameless && has_nameless(folder) ? 0 : 1;
        put(folder / "out", "old");
        {
            const Temporary dropped(folder / "out", 0, nameless);
            write_to(dropped, "half");
            CHECK(folder.files() == 1 + hidden);
        }
        CHECK(folder.files() == 1);
        Temporary file(folder / "out", 0, nameless);
        write_to(file, "new");
        CHECK(read_input(folder / "out") == "old");
        file.finish();
        CHECK(read_input(folder / "out") == "new");
        CHECK(folder.files() == 1);
        Temporary fresh(folder / "fresh", 0604, nameless);
        fresh.finish();
        struct stat status {};
        REQUIRE(::stat((folder / "fresh").c_str(), &status) == 0);
        CHECK((status.st_mode & 0777u) == 0604u);
    }
}

TEST_CASE("a temporary file whose name is taken by a folder is an error, and gone") {
    for (const bool nameless : {true, false}) {
        const Folder folder;
        fs::create_directories(folder.path / "out" / "full");
        {
            Temporary file(folder / "out", 0, nameless);
            CHECK_THROWS_AS(file.finish(), std::system_error);
        }
        CHECK(folder.files() == 1);
    }
    const Folder folder;
    CHECK_THROWS_AS(Temporary(folder / "no/where", 0), std::system_error);
}

TEST_CASE("an interrupt removes what is not finished, and what another thread is about to name") {
    const Folder folder;
    for (int round = 0; round < 100; ++round) {
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            Temporary done(folder / "done", 0, false);
            done.finish();
            const Temporary left(folder / "left", 0, false);
            const TemporaryFolder filled(folder / "filled");
            std::ofstream(filled.name() + "/whole") << "finished, in a folder that is not";
            std::thread writer([&] {
                for (int k = 0;; ++k) Temporary(folder / "other", 0, k % 2 == 0).finish();
            });
            std::this_thread::sleep_for(std::chrono::microseconds(37 * round));
            remove_unfinished_outputs();
            ::_exit(0);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        REQUIRE(fs::exists(folder.path / "done"));
        REQUIRE(folder.files() == (fs::exists(folder.path / "other") ? 2 : 1));
    }
}

TEST_CASE("what a killed process left is taken away by the next that writes there") {
    for (const bool nameless : {true, false}) {
        const Folder folder;
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            const Temporary left(folder / "out", 0, false);
            ::raise(SIGKILL);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFSIGNALED(status));
        REQUIRE(folder.files() == 1);
        Temporary file(folder / "out", 0, nameless);
        file.finish();
        CHECK(folder.files() == 1);
        CHECK(fs::exists(folder.path / "out"));
    }
}

TEST_CASE("what is still written, and what is no temporary file, stays") {
    const Folder folder;
    put(folder / ".bough-1-1.tmp", "left");
    put(folder / ".bough-x-1.tmp", "");
    put(folder / ".bough-11.tmp", "");
    put(folder / ".bough-1-1.tmp.json", "");
    put(folder / "kept", "kept");
    fs::create_symlink("kept", folder.path / ".bough-2-1.tmp");
    const std::string written = folder / ".bough-3-1.tmp";
    put(written, "");
    const int file = ::open(written.c_str(), O_RDWR);
    REQUIRE(::flock(file, LOCK_EX) == 0);
    Temporary(folder / "out", 0, false).finish(); // the first of this process here
    CHECK(!fs::exists(folder.path / ".bough-1-1.tmp"));
    for (const char* name : {".bough-x-1.tmp", ".bough-11.tmp", ".bough-1-1.tmp.json", ".bough-3-1.tmp", "kept", "out"})
        CHECK(fs::exists(folder.path / name));
    CHECK(fs::is_symlink(folder.path / ".bough-2-1.tmp"));
    ::close(file);
}

TEST_CASE("files written at once to one name do not mix") {
    const Folder folder;
    for (int k = 0; k < 50; ++k) {
        Temporary a(folder / "out", 0, false), b(folder / "out", 0, true);
        write_to(a, "a");
        write_to(b, "b");
        a.finish();
        b.finish();
        CHECK(read_input(folder / "out") == "b");
    }
    CHECK(folder.files() == 1);
}
