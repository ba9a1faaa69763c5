// Command lines: the first byte chooses the tool, the rest are its words, a line each. They run in an empty folder, and no word leads out of it.
#include "options.h"
#include "fuzzing.h"
#include "tools/profile.h"
#include "tools/tool.cpp"
#include <algorithm>
#include <unistd.h>

namespace bough::fuzzing {

int read_words(const std::vector<Subcommand>& commands, int argc, char** argv, CommonOptions& common) {
    return choose_and_work(commands, argc, argv, common);
}

int treeprofile_words(int argc, char** argv) {
    CommonOptions common;
    std::vector<Subcommand> commands{profile_stages(common), profile_error(common),   profile_stability(common),
                                     profile_modes(common),  profile_scaling(common), profile_compare(common)};
    for (Subcommand& command : commands) command.work = [] {};
    return read_words(commands, argc, argv, common);
}

} // namespace bough::fuzzing

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    std::string folder = "/tmp/bough-options-XXXXXX";
    if (!::mkdtemp(folder.data()) || ::chdir(folder.c_str()) != 0 || ::rmdir(folder.c_str()) != 0)
        bough::fuzzing::fail("no folder to work in");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace bough::fuzzing;
    if (size == 0) return 0;
    std::vector<std::string> words{"tool", ""};
    for (std::size_t k = 1; k < size; ++k) {
        const char c = char(data[k]);
        if (c == '\n')
            words.emplace_back();
        else if (c != '\0')
            words.back() += c == '/' || c == '~' ? '_' : c;
    }
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    const int argc = int(argv.size());
    argv.push_back(nullptr);
    constexpr int (*tools[])(int, char**) = {treegen_words, treeconvert_words, treesim_words, treeprofile_words};
    const int code = tools[data[0] % 4](argc, argv.data());
    if (code < 0 || code > 4) fail("exit code " + std::to_string(code));
    return 0;
}
