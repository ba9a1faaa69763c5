#include "common.h"
#include "formats/plain_text.h"
#include "lib/fast/targets.h"
#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdlib>
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

volatile std::sig_atomic_t caught_signal = 0;
volatile std::sig_atomic_t at_boundary = 0;
std::atomic<bool> bar_on_screen{false};

extern "C" void on_signal(int signal) {
    caught_signal = signal;
    if (at_boundary) {
        std::signal(signal, SIG_DFL); // a second one ends the program at once
        return;
    }
    remove_unfinished_outputs();
    _exit(128 + signal);
}

const char* running_tool = "";

// A page of an input that is looked at where it lies (mapped.h) is there no more, or cannot be read from its disk.
extern "C" void on_missing_page(int) {
    remove_unfinished_outputs();
    constexpr std::string_view text =
        ": an input became shorter while it was read, or its disk failed; expected a finished file\n";
    if (bar_on_screen) (void)!::write(STDERR_FILENO, "\r\033[K", 4);
    (void)!::write(STDERR_FILENO, running_tool, std::string_view(running_tool).size());
    (void)!::write(STDERR_FILENO, text.data(), text.size());
    _exit(exit_input);
}

// A standard stream that the caller closed must not become the next file we open: it is held by a descriptor on which
// the use that would be made of it fails.
void hold_standard_streams() {
    for (int fd = 0; fd <= 2; ++fd)
        if (::fcntl(fd, F_GETFD) < 0) (void)!::open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

void prepare_process(const ToolInfo& info) {
    running_tool = info.name;
    hold_standard_streams();
    std::setlocale(LC_ALL, "C");
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGBUS, on_missing_page);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before;
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) std::signal(signal, on_signal);
    }
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
    if (bar_on_screen.exchange(false)) (void)!::write(STDERR_FILENO, "\r\033[K", 4);
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
        return 128 + (caught_signal ? int(caught_signal) : SIGINT);
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

CLI::Validator number_check(const char* expected, bool (*accepts)(double)) {
    return CLI::Validator(
        [=](const std::string& text) {
            const std::optional<double> value = parse_number(text);
            return value && accepts(*value) ? std::string() : "is '" + text + "', expected " + expected;
        },
        "", "");
}

std::int64_t now_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

} // namespace

std::optional<double> parse_number(const std::string& text) {
    double value = 0;
    const char* first = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
    return value;
}

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

CLI::Validator positive_number() {
    return number_check("a number above 0", [](double v) { return v > 0; });
}

CLI::Validator not_negative_number() {
    return number_check("a number, 0 or more", [](double v) { return v >= 0; });
}

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
    return CLI::Validator(
        [=](const std::string& text) {
            std::int64_t value = 0;
            const char* last = text.data() + text.size();
            const auto [end, error] = std::from_chars(text.data(), last, value);
            if (error == std::errc() && end == last && value >= least && value <= most) return std::string();
            return "is '" + text + "', expected a whole number from " + std::to_string(least) +
                   (most == INT64_MAX ? "" : " to " + std::to_string(most));
        },
        "", "");
}

CLI::Validator file_name() {
    return CLI::Validator(
        [](const std::string& text) -> std::string {
            if (text.empty()) return "is empty, expected a file name";
            if (text.size() > 1 && text[0] == '-')
                return "is '" + text + "', which looks like an option (write ./" + text + " for a file of that name)";
            return {};
        },
        "", "");
}

void add_import_options(CLI::App& app, ImportChoice& choice) {
    app.add_option("--units", choice.units, "Unit of the imported file: m, cm, mm, ft, in or its length in metres")
        ->option_text("UNIT")
        ->check(CLI::Validator(
            [](const std::string& text) {
                return unit_in_metres(text) ? std::string()
                                            : "is '" + text + "', expected m, cm, mm, ft, in or a number above 0";
            },
            "", ""));
    app.add_option("--up", choice.up, "Up axis of the imported file: y or z")
        ->option_text("AXIS")
        ->check(CLI::IsMember({"y", "z"}, CLI::ignore_case));
}

std::optional<double> unit_in_metres(const std::string& units) {
    if (units == "m") return 1.0;
    if (units == "cm") return 0.01;
    if (units == "mm") return 0.001;
    if (units == "ft") return 0.3048;
    if (units == "in") return 0.0254;
    const std::optional<double> value = parse_number(units);
    return value && *value > 0 ? value : std::nullopt;
}

std::vector<std::string> split_list(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
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

std::vector<double> number_list(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> values;
    for (const std::string& part : split_list(text)) {
        const std::optional<double> value = parse_number(part);
        if (!value) break;
        values.push_back(*value);
    }
    if (values.size() != count || split_list(text).size() != count)
        throw UsageError(option + " is '" + text + "', expected " +
                         (count == 1 ? "a number" : std::to_string(count) + " numbers parted by commas"));
    return values;
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

void interrupt_at_boundary() {
    at_boundary = 1;
}

bool interrupted() {
    return caught_signal != 0;
}

Progress::Progress(const CommonOptions& common, std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total), wanted_(!common.quiet && ::isatty(STDERR_FILENO) == 1),
      last_ms_(now_ms() + 400) {}

Progress::~Progress() {
    if (shown_ && bar_on_screen.exchange(false)) (void)!::write(STDERR_FILENO, "\r\033[K", 4);
}

void Progress::at(std::int64_t done) {
    if (!wanted_ || now_ms() < last_ms_ + 100) return;
    last_ms_ = now_ms();
    const int filled = int(30 * done / std::max<std::int64_t>(total_, 1));
    const std::string text = "\r" + what_ + " [" + std::string(filled, '#') + std::string(30 - filled, '.') + "] " +
                             std::to_string(done) + "/" + std::to_string(total_) + "\033[K";
    (void)!::write(STDERR_FILENO, text.data(), text.size());
    bar_on_screen = shown_ = true;
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
