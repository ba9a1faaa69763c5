// held_inputs.h: a path that is opened twice for one result leads to one file.
#include "formats/held_inputs.h"
#include "formats/mapped.h"
#include "formats/open.h"
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace bough;
namespace fs = std::filesystem;

namespace {

struct Holding {
    fs::path folder = fs::temp_directory_path() / ("bough_held_" + std::to_string(::getpid()));
    Holding() {
        fs::create_directory(folder);
        hold_inputs();
    }
    ~Holding() {
        hold_inputs(false);
        fs::remove_all(folder);
    }
    std::string file(const char* name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
    }
};

} // namespace

TEST_CASE("an input that is another file, or written anew, when it is opened again is refused, however it is opened") {
    const Holding holding;
    const std::string a = holding.file("a", "one"), b = holding.file("b", "two");
    CHECK(read_input(a) == "one");
    CHECK(Input(a).content() == "one");
    CHECK(MappedInput(a).content() == "one");
    fs::rename(b, a);
    CHECK_THROWS_WITH(read_input(a), Catch::Contains("a: was replaced while it was read"));
    CHECK_THROWS_AS(Input(a), InputError);
    CHECK_THROWS_AS(MappedInput(a), InputError);
    hold_inputs();
    CHECK(MappedInput(a).content() == "two");
    holding.file("a", "six");
    CHECK_THROWS_AS(read_input(a), InputError);
    hold_inputs(false);
    CHECK(read_input(a) == "six");
    holding.file("a", "ten");
    CHECK(read_input(a) == "ten");
}

TEST_CASE("a pipe with a name brings what it has once: for one result that is what everyone gets who opens it") {
    const Holding holding;
    const std::string pipe = (holding.folder / "pipe").string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    std::thread writer([&] { std::ofstream(pipe) << "once"; });
    CHECK(MappedInput(pipe).content() == "once");
    writer.join();
    CHECK(read_input(pipe) == "once"); // opened again it would wait for another writer
    CHECK(Input(pipe).content() == "once");
    CHECK(Input(pipe).size() == 4);
    hold_inputs();
    std::thread again([&] { std::ofstream(pipe) << "anew"; });
    CHECK(read_input(pipe) == "anew");
    again.join();
}

TEST_CASE("of another result a pipe is read as it comes") {
    const Holding holding;
    for (const std::string text : {"one", "another"}) { // two pipes, one after the other under one name
        hold_inputs();
        int ends[2];
        REQUIRE(::pipe(ends) == 0);
        constexpr int number = 99;
        REQUIRE(::dup2(ends[0], number) == number);
        ::close(ends[0]);
        REQUIRE(::write(ends[1], text.data(), text.size()) == ssize_t(text.size()));
        ::close(ends[1]);
        CHECK(read_input("/dev/fd/" + std::to_string(number)) == text);
        ::close(number);
    }
}
