#include "tool.h"
#include "file_names.h"
#include "formats/plain_text.h"
#include "made_with.h"
#include "progress.h"
#include "signals.h"
#include "threads.h"
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <fcntl.h>
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

void prepare_process(const ToolInfo& info) {
    hold_standard_streams();
    std::setlocale(LC_ALL, "C");
    catch_signals(info.name);
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
    list.add_help("Print version, compiler, flags and SIMD target, and exit");
    list.add_flag("-q,--quiet", common.quiet, "No notes and no progress on stderr");
    if (info.has_threads)
        list.add("--threads", common.threads, "Threads to work with; all of the machine unless given")
            .takes("N")
            .check(whole_number(1, most_threads));
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
        say(info.name, "out of memory");
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

int parse_and_work(const ToolInfo& info, int argc, char** argv, CommonOptions& common,
                   const std::function<void(OptionList&)>& declare, const std::function<void()>& work) {
    OptionList list(info.name, info.about, info.epilog);
    declare(list);
    declare_common(list, info, common);
    if (argc <= 1 && info.has_input) return refuse_usage(info, "no arguments");
    const OptionsRead read = list.read(argc, argv);
    switch (read.end) {
    case OptionsRead::End::help:
        std::cout << read.text;
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
    common.command_line = joined(info.name, argc, argv);
    return work_and_report(info, work);
}

} // namespace

int run_tool(const ToolInfo& info, int argc, char** argv, CommonOptions& common,
             const std::function<void(OptionList&)>& declare, const std::function<void()>& work) {
    prepare_process(info);
    int code = parse_and_work(info, argc, argv, common, declare, work);
    if (code == exit_done && !common.quiet)
        for (const std::string& note : common.notes) say(info.name, note);
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::fclose(stdout) != 0 || !std::cout) {
        if (code == exit_done) say(info.name, "<stdout>: cannot be written");
        if (code == exit_done) code = exit_output;
    }
    return code;
}

} // namespace bough
