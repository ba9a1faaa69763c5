// An input that another program cuts short while it is read: one line, exit 2, and nothing of the output.
#include "formats/mapped.h"
#include "formats/open.h"
#include "tools/tool.h"
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace bough;
namespace fs = std::filesystem;

TEST_CASE("an input cut short while it is read ends the tool in one line, with exit 2 and no output") {
    const fs::path folder = fs::temp_directory_path() / ("bough_cut_" + std::to_string(::getpid()));
    fs::create_directory(folder);
    const std::string input = folder / "input", output = folder / "output", message = folder / "message";
    std::ofstream(input) << std::string(1 << 20, 'x');
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (!std::freopen(message.c_str(), "w", stderr)) _exit(99);
        char name[] = "cutter", argument[] = "-q";
        char* arguments[] = {name, argument, nullptr};
        CommonOptions common;
        volatile char last = 0;
        const int code = run_tool(
            {.name = "cutter", .about = "reads a file that is cut short", .usage = ""}, 2, arguments, common,
            [](OptionList&) {},
            [&] {
                Output unfinished(output);
                unfinished.write("half");
                unfinished.flush();
                const MappedInput file(input);
                fs::resize_file(input, 0);
                last = file.content().back();
            });
        _exit(code == 0 ? 98 : code); // reached only where nothing was missed
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == exit_input);
    std::string line, more;
    std::ifstream said(message);
    std::getline(said, line);
    CHECK(line == "cutter: an input became shorter while it was read, or its disk failed; expected a finished file");
    CHECK_FALSE(std::getline(said, more));
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& file : fs::directory_iterator(folder)) ++files;
    CHECK(files == 2); // the input and the message: no output, whole or temporary
    fs::remove_all(folder);
}
