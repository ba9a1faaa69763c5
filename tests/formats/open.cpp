// Files in and out: whole or not at all, pipes and devices directly, and what is said when it does not work.
#include "formats/open.h"
#include "formats/free_memory.h"
#include "tests/support/random_documents.h"
#include <csignal>
#include <fstream>
#include <functional>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

namespace {

thread_local std::function<void()> after_read; // called after each block of a file that this thread reads

} // namespace

// In the C library's place, so that something may happen between two blocks of one file.
extern "C" ssize_t read(int file, void* to, std::size_t count) {
    const ssize_t got = ::syscall(SYS_read, file, to, count);
    if (after_read) after_read();
    return got;
}

namespace {

void overwrite(const std::string& path, const std::string& text) {
    std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << text;
}

unsigned mode_of(const std::string& path) {
    struct stat status;
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 0777u;
}

} // namespace

TEST_CASE("an output appears whole under its name, or not at all") {
    const Folder folder;
    put(folder / "out", "old");
    {
        Output output(folder / "out");
        output.write("half");
        output.flush();
        CHECK(read_input(folder / "out") == "old");
    }
    CHECK(read_input(folder / "out") == "old");
    CHECK(folder.files() == 1);

    Output output(folder / "out");
    const std::string large(3'000'000, 'x');
    output.write("new");
    output.write(large);
    output.write("end");
    output.finish();
    CHECK(read_input(folder / "out") == "new" + large + "end");
    CHECK(folder.files() == 1);
    CHECK_THROWS_AS(output.write("more"), OutputError);
}

TEST_CASE("two outputs to one name do not mix, the later one stays") {
    const Folder folder;
    Output a(folder / "out"), b(folder / "out");
    a.write("a");
    b.write("b");
    a.finish();
    b.finish();
    CHECK(read_input(folder / "out") == "b");
    CHECK(folder.files() == 1);
}

TEST_CASE("a link stays a link, also one whose file is not there yet") {
    const Folder folder;
    fs::create_directory(folder.path / "there");
    fs::create_symlink("there/file", folder.path / "link");
    for (const char* text : {"first", "second"}) {
        Output output(folder / "link");
        output.write(text);
        output.finish();
        CHECK(fs::is_symlink(folder.path / "link"));
        CHECK(read_input(folder / "there/file") == text);
    }
    fs::create_symlink("loop", folder.path / "loop");
    CHECK_THROWS_AS(Output(folder / "loop"), OutputError);
}

TEST_CASE("permissions are the umask's, or those of the file replaced") {
    const Folder folder;
    const mode_t before = ::umask(027);
    Output fresh(folder / "fresh");
    fresh.finish();
    put(folder / "old", "");
    ::chmod((folder / "old").c_str(), 0604);
    Output again(folder / "old");
    again.finish();
    ::umask(before);
    CHECK(mode_of(folder / "fresh") == 0640u);
    CHECK(mode_of(folder / "old") == 0604u);
}

TEST_CASE("a full disk is an error at the latest when finishing") {
    if (!fs::exists("/dev/full")) return;
    Output small("/dev/full");
    small.write("x");
    CHECK_THROWS_WITH(small.finish(), Catch::Contains("/dev/full: ") && Catch::Contains("No space left"));
    Output large("/dev/full");
    const std::string text(3'000'000, 'x');
    CHECK_THROWS_AS(large.write(text), OutputError);
    CHECK_THROWS_AS(large.write("x"), OutputError);
    CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("what cannot be opened is named") {
    const Folder folder;
    CHECK_THROWS_WITH(Output(folder / "no/where"), Catch::Contains("no/where: ") && Catch::Contains("No such file"));
    CHECK_THROWS_WITH(Output(folder.path.string()), Catch::Contains("directory"));
    CHECK_THROWS_WITH(read_input(folder.path.string()), Catch::Contains("is a directory, expected a file"));
    CHECK_THROWS_WITH(read_input(folder / "none"), Catch::Contains("none: cannot be opened: No such file"));
    put(folder / "file", "");
    CHECK(read_input(folder / "file").empty());
    CHECK_THROWS_AS(Output(folder / "file/below"), OutputError);
    if (::geteuid() != 0) {
        ::chmod(folder.path.c_str(), 0500);
        CHECK_THROWS_AS(Output(folder / "new"), OutputError);
        ::chmod(folder.path.c_str(), 0700);
        ::chmod((folder / "file").c_str(), 0);
        CHECK_THROWS_AS(Output(folder / "file"), OutputError);
        CHECK_THROWS_AS(read_input(folder / "file"), InputError);
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a named pipe is written directly, and stays") {
    const Folder folder;
    const std::string pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const std::string large(1'000'000, 'y');
    std::string got;
    std::thread reader([&] { got = read_input(pipe); });
    Output output(pipe);
    output.write(large);
    output.write("end");
    output.finish();
    reader.join();
    CHECK(got == large + "end");
    CHECK(fs::is_fifo(pipe));
    CHECK(folder.files() == 1);
}

TEST_CASE("a pipe whose reader left is an error, not a signal's end") {
    std::signal(SIGPIPE, SIG_IGN);
    const Folder folder;
    const std::string pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    std::thread reader([&] { std::ifstream(pipe).get(); });
    Output output(pipe);
    output.write("x");
    output.flush();
    reader.join();
    output.write("y");
    CHECK_THROWS_WITH(output.finish(), Catch::Contains("Broken pipe"));
    std::signal(SIGPIPE, SIG_DFL);
}

TEST_CASE("an input that is written to while it is read is refused") {
    const Folder folder;
    // A document in the binary form, whose arrays are read when they are wanted, written anew in its place at once.
    const std::string document = std::string("\x02\0\0\0\0\0\0\0{}", 10) + std::string(1000, 'a');
    for (int k = 0; k < 30; ++k) {
        put(folder / "document", document);
        const Input input(folder / "document");
        REQUIRE(input.content().size() == 10);
        std::string bytes(500, ' ');
        input.read(10, bytes.size(), bytes.data());
        put(folder / "document", document);
        CHECK_THROWS_WITH(input.read(510, bytes.size(), bytes.data()),
                          Catch::Contains("document: was written to while it was read"));
    }
    // Read whole, a block at a time: between the first block and the second another program fills it with another letter.
    const std::string large(4'000'000, 'a');
    put(folder / "text", large);
    CHECK(read_input(folder / "text") == large);
    int blocks = 0;
    after_read = [&] {
        if (++blocks == 1) overwrite(folder / "text", std::string(large.size(), 'b'));
    };
    CHECK_THROWS_WITH(read_input(folder / "text"),
                      Catch::Contains("text: was written to while it was read, expected a finished file"));
    after_read = nullptr;
    CHECK(blocks > 2);
    CHECK(read_input(folder / "text") == std::string(large.size(), 'b'));
}

TEST_CASE("a device that has no end is no input") {
    if (!fs::is_character_file("/dev/zero")) return;
    CHECK_THROWS_WITH(read_input("/dev/zero"), Catch::Contains("/dev/zero: is a device, expected a file"));
    CHECK_THROWS_WITH(Input("/dev/urandom"), Catch::Contains("is a device, expected a file"));
    CHECK(read_input("/dev/null").empty());
}

TEST_CASE("the memory that is free is some, and not more than there is") {
    const std::optional<std::size_t> free = free_memory();
    if (!free) return;
    CHECK(*free > 0);
    CHECK(*free < std::size_t(::sysconf(_SC_PHYS_PAGES)) * std::size_t(::sysconf(_SC_PAGESIZE)));
}

TEST_CASE("the ending says the form") {
    CHECK(form_of_name("oak.safetensors") == Form::safetensors);
    CHECK(form_of_name("oak.json") == Form::json);
    CHECK(form_of_name(".safetensors") == Form::json);
    CHECK(form_of_name("-") == Form::json);
    CHECK(input_name("-") == "<stdin>");
}

TEST_CASE("an output to memory keeps to it, and counts what does not fit") {
    std::string memory(8, '.');
    Output output(memory.data(), 6, "here");
    output.write("abcd");
    output.flush();
    CHECK(memory == "abcd....");
    output.write("efgh");
    output.write("ij");
    output.finish();
    CHECK(memory == "abcdef..");
    CHECK(output.bytes() == 10);
    CHECK_FALSE(output.changeable());
    Output nothing(nullptr, 0, "nowhere");
    nothing.write("abc");
    CHECK(nothing.bytes() == 3);
}
