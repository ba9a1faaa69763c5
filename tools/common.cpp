#include "common.h"
#include "formats/plain_text.h"
#include "lib/fast/targets.h"
#include "progress.h"
#include "signals.h"
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <new>
#include <thread>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

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

std::string quoted(const std::string& argument) {
    const auto plain = [](unsigned char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c >= 0x80 ||
               std::string_view("_-./=:,+%@").find(char(c)) != std::string_view::npos;
    };
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), plain)) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c == '\n' ? ' ' : c);
    return text + "'";
}

std::string joined(const std::string& name, int argc, char** argv) {
    std::string text = name;
    for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
    return text;
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void say(const char* tool, const std::string& text) {
    const std::string line = std::string(tool) + ": " + one_line(text) + "\n";
    clear_progress();
    (void)!::write(STDERR_FILENO, line.data(), line.size());
}

// CLI11's texts with our wording where a user meets them daily.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extras = app.remaining(true);
        for (const std::string& extra : extras)
            if (extra.size() > 1 && extra[0] == '-') return extra + ": unknown option";
        if (!extras.empty()) return "'" + extras.front() + "': one argument too many";
    }
    return error.what();
}

std::string version_text(const char* tool) {
    return std::string(tool) + " " + bough_version() + " (bough)\ncompiler " + compiler_name() + "\nflags " +
           compiler_flags() + "\nsimd " + simd_target() + "\n";
}

void declare_common(CLI::App& app, const ToolInfo& info, CommonOptions& common) {
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.add_flag_callback(
        "--version", [&info] { throw CLI::CallForVersion(version_text(info.name), 0); },
        "Print version, compiler, flags and SIMD target, and exit");
    app.add_flag("-q,--quiet", common.quiet, "No notes and no progress on stderr");
    if (info.has_threads)
        app.add_option("--threads", common.threads, "Threads to work with; all of the machine unless given")
            ->option_text("N")
            ->check(whole_number(1, most_threads));
    app.add_option("-o,--output", common.output, "Output, - for stdout")->option_text("FILE")->check(file_name());
    if (!info.formats.empty()) {
        std::string names;
        for (const std::string& f : info.formats) names += (names.empty() ? "" : ", ") + f;
        app.add_option("--format", common.format, "Output format: " + names + "; else by the output's name")
            ->option_text("NAME")
            ->check(CLI::IsMember(info.formats));
    }
    if (info.has_source)
        app.add_flag_callback(
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

int parse_and_work(const ToolInfo& info, int argc, char** argv, CommonOptions& common,
                   const std::function<void(CLI::App&)>& declare, const std::function<void()>& work) {
    CLI::App app(info.about, info.name);
    app.option_defaults()->always_capture_default(false);
    app.get_formatter()->column_width(30);
    app.footer(info.epilog);
    declare(app);
    declare_common(app, info, common);
    try {
        if (argc <= 1 && info.has_input) throw UsageError("no arguments");
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return exit_done;
    } catch (const CLI::CallForVersion&) {
        std::cout << version_text(info.name);
        return exit_done;
    } catch (const CLI::ParseError& error) {
        say(info.name, usage_text(app, error) + "; see " + info.name + " --help");
        return exit_usage;
    } catch (const UsageError& error) {
        say(info.name, std::string(error.what()) + "; see " + info.name + " --help");
        return exit_usage;
    }
    if (common.threads == 0) common.threads = machine_threads();
    use_threads(common.threads);
    common.command_line = joined(info.name, argc, argv);
    return work_and_report(info, work);
}

} // namespace

int run_tool(const ToolInfo& info, int argc, char** argv, CommonOptions& common,
             const std::function<void(CLI::App&)>& declare, const std::function<void()>& work) {
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

bool same_file(const std::string& one, const std::string& other) {
    std::error_code none;
    return one != "-" && other != "-" && !one.empty() && !other.empty() &&
           (one == other ||
            std::filesystem::weakly_canonical(one, none) == std::filesystem::weakly_canonical(other, none));
}

void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
    for (const NamedFile& output : written)
        for (const NamedFile& input : read)
            if (same_file(input.file, output.file))
                throw UsageError(output.option + ": is '" + output.file + "', which " + input.option +
                                 " reads and the output would replace");
}

std::string ending(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

Form chosen_form(const CommonOptions& common) {
    if (common.format == "json") return Form::json;
    if (common.format == "safetensors") return Form::safetensors;
    for (const char* other :
         {".glb", ".gltf", ".fbx", ".obj", ".dae", ".ply", ".stl", ".abc", ".usd", ".jsonl", ".xml"})
        if (ending(common.output) == other)
            throw UsageError("-o is '" + common.output +
                             "', but this tool writes a document there: .json or .safetensors");
    return ending(common.output) == ".safetensors" ? Form::safetensors : form_of_name(common.output);
}

std::string with_command_line(const std::string& before, const CommonOptions& common) {
    if (!common.source) return before;
    return before.empty() ? common.command_line : before + "\n" + common.command_line;
}

const char* bough_version() {
    return BOUGH_VERSION;
}
const char* compiler_name() {
    return BOUGH_COMPILER;
}
const char* compiler_flags() {
    return BOUGH_FLAGS;
}
const char* simd_target() {
    return fast::target_name(fast::best_target());
}
void use_threads(int threads) {
#ifdef _OPENMP
    omp_set_num_threads(threads);
#else
    (void)threads; // most_threads is 1
#endif
}
int machine_threads() {
    return std::clamp(int(std::thread::hardware_concurrency()), 1, most_threads);
}

} // namespace bough
