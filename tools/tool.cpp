#include "tool.h"
#include "file_names.h"
#include "formats/held_inputs.h"
#include "formats/in_shell.h"
#include "formats/nearest_name.h"
#include "formats/plain_text.h"
#include "formats/temporary.h"
#include "made_with.h"
#include "progress.h"
#include "signals.h"
#include "threads.h"
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <new>
#include <unistd.h>

namespace bough {
namespace {

// A standard stream that the caller closed must not become the next file we open: it is held by a descriptor on which
// the use that would be made of it fails.
void hold_standard_streams() {
    for (int fd = 0; fd <= 2; ++fd)
        if (::fcntl(fd, F_GETFD) < 0) (void)!::open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

const char* tool_that_runs = "bough";

// Memory may end where nothing can be thrown: nlohmann::json allocates as it is freed. That is no reason to dump core.
[[noreturn]] void end_without_memory() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        constexpr const char* text = ": out of memory\n";
        remove_unfinished_outputs();
        (void)!::write(STDERR_FILENO, tool_that_runs, std::strlen(tool_that_runs));
        (void)!::write(STDERR_FILENO, text, std::strlen(text));
        ::_exit(exit_input);
    } catch (...) {
    }
    std::abort();
}

void prepare_process(const ToolInfo& info) {
    tool_that_runs = info.name;
    std::set_terminate(end_without_memory);
    hold_standard_streams();
    std::setlocale(LC_ALL, "C");
    catch_signals(info.name);
    hold_inputs();
}

std::string joined(const std::string& name, int argc, char** argv) {
    std::string text = name;
    for (int i = 1; i < argc; ++i) text += " " + in_shell(argv[i]);
    return text;
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return valid_utf8(in_words(std::move(text))); // names and pieces of a file are whatever they are
}

void say(const char* tool, const std::string& text) {
    const std::string line = std::string(tool) + ": " + one_line(text) + "\n";
    clear_progress();
    (void)!::write(STDERR_FILENO, line.data(), line.size());
}

std::string version_text(const char* tool) {
    return std::string(tool) + " " + bough_version() + " (bough)\ncompiler " + compiler_name() + "\nflags " +
           compiler_flags() + "\nsimd " + simd_target() + "\n";
}

void declare_common(OptionList& list, const ToolInfo& info, CommonOptions& common) {
    list.group("Output");
    list.add("-o,--output", common.output, "Output, - for stdout").takes("FILE").check(file_name());
    if (!info.formats.empty()) {
        std::string names;
        for (const std::string& f : info.formats) names += (names.empty() ? "" : ", ") + f;
        list.add("--format", common.format, "Output format: " + names + "; else by the output's name")
            .takes("NAME")
            .one_of(info.formats);
    }
    if (info.has_source)
        list.add_flag(
            "--no-source", [&common] { common.source = false; }, "Do not record this command line in the output");
    list.group("General");
    list.add_help("Print version, compiler, flags and SIMD target, and exit");
    list.add_flag("-q,--quiet", common.quiet, "No notes and no progress on stderr");
    if (info.has_threads)
        list.add("--threads", common.threads, "Threads to work with; all of the machine unless given")
            .takes("N")
            .check(whole_number(1, most_threads));
    list.group("Input");
}

int work_and_report(const ToolInfo& info, const std::function<void()>& work) {
    try {
        work();
        return exit_done;
    } catch (const UsageError& error) {
        say(info.name, std::string(error.what()) + "; see " + info.name + " --help");
        return exit_usage;
    } catch (const InputError& error) {
        say(info.name, error.what());
        return exit_input;
    } catch (const PromiseError& error) {
        say(info.name, error.what());
        return exit_promise;
    } catch (const OutputError& error) {
        say(info.name, error.what());
        return exit_output;
    } catch (const Interrupted& error) {
        say(info.name, error.what());
        return interrupted_exit();
    } catch (const std::bad_alloc&) {
        say(info.name, "out of memory: expected more, or a higher limit (ulimit -v)");
        return exit_input;
    } catch (const std::exception& error) {
        say(info.name, error.what());
        return exit_input;
    }
}

int refuse_usage(const ToolInfo& info, const std::string& text) {
    say(info.name, text + "; see " + info.name + " --help");
    return exit_usage;
}

std::vector<std::string> words_of(const std::vector<Subcommand>& commands) {
    std::vector<std::string> words;
    for (const Subcommand& command : commands)
        if (*command.word) words.push_back(command.word);
    return words;
}

std::unique_ptr<OptionList> declared(const std::vector<Subcommand>& commands, std::size_t chosen,
                                     CommonOptions& common) {
    const auto& [word, info, declare, work] = commands[chosen];
    HelpPage head{info.name, info.about, info.usage, info.details, info.examples, {}, {}};
    if (chosen > 0) head.command += std::string(" ") + word;
    if (chosen == 0 && commands.size() > 1) head.commands = words_of(commands);
    auto list = std::make_unique<OptionList>(head);
    declare_common(*list, info, common);
    declare(*list);
    if (!info.first.empty()) {
        std::vector<std::string> first = info.first;
        first.insert(first.end(), {"-o", "--help", "--help-all", "--version", "-q"});
        list->first(first);
    }
    return list;
}

// The manual page of this one, or what a shell is to complete of all of them.
std::string help_as(const std::string& form, const std::vector<Subcommand>& commands, std::size_t chosen,
                    CommonOptions& common) {
    if (form == "man") return manual_page(declared(commands, chosen, common)->page(), bough_version());
    std::vector<HelpPage> pages;
    for (std::size_t k = 0; k < commands.size(); ++k) pages.push_back(declared(commands, k, common)->page());
    return completion(pages, form);
}

int parse_and_work(const std::vector<Subcommand>& commands, std::size_t chosen, std::vector<char*> arguments,
                   const std::string& command_line, CommonOptions& common) {
    const ToolInfo& info = commands[chosen].info;
    const std::unique_ptr<OptionList> list = declared(commands, chosen, common);
    const std::string usage = list->page().usage;
    if (arguments.size() <= 1 && info.has_input)
        return refuse_usage(info, "nothing to read; it is called as " + usage.substr(0, usage.find('\n')));
    const OptionsRead read = list->read(int(arguments.size()), arguments.data());
    switch (read.end) {
    case OptionsRead::End::help:
        std::cout << read.text;
        return exit_done;
    case OptionsRead::End::help_as:
        std::cout << help_as(read.text, commands, chosen, common);
        return exit_done;
    case OptionsRead::End::version:
        std::cout << version_text(info.name);
        return exit_done;
    case OptionsRead::End::wrong:
        return refuse_usage(info, read.text);
    case OptionsRead::End::work:
        break;
    }
    if (common.threads == 0) common.threads = machine_threads();
    use_threads(common.threads);
    common.command_line = command_line;
    return work_and_report(info, commands[chosen].work);
}

// A word that can only be meant as a sub-command's name: letters alone, and no file is called so.
bool is_no_file(const std::string& word) {
    std::error_code none;
    return !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos &&
           !std::filesystem::exists(word, none);
}

int choose_and_work(const std::vector<Subcommand>& commands, int argc, char** argv, CommonOptions& common) {
    // An input is never called like a sub-command by accident, because ./compare is another word.
    const std::string word = argc > 1 ? argv[1] : "";
    std::vector<char*> arguments(argv, argv + argc);
    const std::string line = joined(commands.front().info.name, argc, argv);
    const std::vector<std::string> words = words_of(commands);
    for (std::size_t k = 0; k < commands.size(); ++k)
        if (!word.empty() && word == commands[k].word) {
            arguments.erase(arguments.begin() + 1);
            return parse_and_work(commands, k, arguments, line, common);
        }
    if (commands.size() > 1 && is_no_file(word)) {
        const std::string name = nearest_name(word, words, 2);
        std::string all;
        for (const std::string& each : words) all += (all.empty() ? "" : ", ") + each;
        if (words.size() == commands.size() || !name.empty())
            return refuse_usage(commands.front().info, "'" + word + "' is neither a file nor one of " + all +
                                                           (name.empty() ? "" : "; did you mean " + name + "?"));
    }
    return parse_and_work(commands, 0, arguments, line, common);
}

} // namespace

int run_tool(const std::vector<Subcommand>& commands, int argc, char** argv, CommonOptions& common) {
    const ToolInfo& info = commands.front().info;
    prepare_process(info);
    int code = choose_and_work(commands, argc, argv, common);
    if (code == exit_done && !common.quiet)
        for (const std::string& note : common.notes) say(info.name, note);
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::fclose(stdout) != 0 || !std::cout) {
        if (code == exit_done) say(info.name, "<stdout>: cannot be written");
        if (code == exit_done) code = exit_output;
    }
    return code;
}

int run_tool(const ToolInfo& info, int argc, char** argv, CommonOptions& common,
             const std::function<void(OptionList&)>& declare, const std::function<void()>& work) {
    return run_tool({{"", info, declare, work}}, argc, argv, common);
}

} // namespace bough
