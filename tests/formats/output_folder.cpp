#include "formats/output_folder.h"
#include "formats/temporary.h"
#include "tests/support/random_documents.h"
#include <csignal>
#include <fstream>
#include <sys/stat.h>
#include <sys/wait.h>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

TEST_CASE("a folder that is not there appears whole, or nothing is left of it") {
    const Folder folder;
    for (const char* slash : {"", "/"}) {
        {
            OutputFolder dropped(folder / "oak_vat" + slash);
            dropped.add("a").write("half");
            CHECK_FALSE(fs::exists(folder / "oak_vat"));
        }
        CHECK(folder.files() == 0);
        OutputFolder made(folder / "oak_vat" + slash);
        made.add("a").write("one");
        made.add("b").write("two");
        CHECK_FALSE(fs::exists(folder / "oak_vat"));
        made.finish();
        CHECK(folder.files() == 1);
        CHECK(read_input(folder / "oak_vat/a") == "one");
        CHECK(read_input(folder / "oak_vat/b") == "two");
        struct stat status {};
        REQUIRE(::stat((folder / "oak_vat").c_str(), &status) == 0);
        const mode_t mask = ::umask(0);
        ::umask(mask);
        CHECK((status.st_mode & 0777u) == (0777u & ~mask));
        fs::remove_all(folder / "oak_vat");
    }
}

TEST_CASE("messages name a file of a new folder by the name that it is to have") {
    const Folder folder;
    OutputFolder made(folder / "oak_vat");
    CHECK(made.add("a").name() == folder / "oak_vat/a");
}

TEST_CASE("in a folder that is there each file is replaced, once all are written; others stay") {
    const Folder folder;
    fs::create_directory(folder / "oak_vat");
    std::ofstream(folder / "oak_vat/a") << "old";
    std::ofstream(folder / "oak_vat/notes") << "mine";
    {
        OutputFolder dropped(folder / "oak_vat");
        dropped.add("a").write("half");
    }
    CHECK(read_input(folder / "oak_vat/a") == "old");
    OutputFolder made(folder / "oak_vat");
    made.add("a").write("new");
    made.add("b").write("two");
    CHECK(read_input(folder / "oak_vat/a") == "old");
    made.finish();
    CHECK(read_input(folder / "oak_vat/a") == "new");
    CHECK(read_input(folder / "oak_vat/b") == "two");
    CHECK(read_input(folder / "oak_vat/notes") == "mine");
    CHECK(std::distance(fs::directory_iterator(folder / "oak_vat"), fs::directory_iterator()) == 3);
}

TEST_CASE("what is no folder, and a folder in one that is not there, are told of") {
    const Folder folder;
    std::ofstream(folder / "file") << "x";
    CHECK_THROWS_AS(OutputFolder(folder / "file"), OutputError);
    CHECK_THROWS_AS(require_output_folder(folder / "missing/oak_vat"), OutputError);
    fs::create_symlink(folder / "nowhere", folder / "link");
    for (const char* slash : {"", "/"})
        CHECK_THROWS_WITH(OutputFolder(folder / "link" + slash),
                          folder / "link/" + ": is a link that leads nowhere: No such file or directory");
    fs::remove(folder / "link");
    require_output_folder(folder / "oak_vat/");
    CHECK(folder.files() == 1);
}

TEST_CASE("a signal's handler leaves no folder, and what a killed process left the next one takes away") {
    const Folder folder;
    for (const bool killed : {false, true}) {
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            OutputFolder made(folder / "oak_vat");
            made.add("a").write("half");
            if (killed) ::raise(SIGKILL);
            remove_unfinished_outputs();
            ::_exit(0);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK(folder.files() == (killed ? 1 : 0));
    }
    OutputFolder made(folder / "oak_vat");
    CHECK(folder.files() == 1);
    made.add("a").write("one");
    made.finish();
    CHECK(folder.files() == 1);
    CHECK(read_input(folder / "oak_vat/a") == "one");
}
