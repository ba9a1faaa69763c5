#include "watch.h"
#include "file_names.h"
#include "formats/held_inputs.h"
#include "formats/plain_text.h"
#include "signals.h"
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <thread>

namespace bough {
namespace {

using Files = std::vector<std::string>;

struct Stamp {
    bool there = false;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
};

std::vector<Stamp> stamps(const Files& files) {
    std::vector<Stamp> result;
    for (const std::string& file : files) {
        std::error_code none, error;
        Stamp stamp;
        stamp.time = std::filesystem::last_write_time(file, error);
        stamp.there = !error;
        if (stamp.there) stamp.size = std::filesystem::file_size(file, none);
        result.push_back(stamp.there ? stamp : Stamp());
    }
    return result;
}

std::string time_of_day() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    return std::string(text, std::strftime(text, sizeof text, "%H:%M:%S", std::localtime(&now)));
}

void pause() {
    if (interrupted()) throw Interrupted("interrupted, no longer watching");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (interrupted()) throw Interrupted("interrupted, no longer watching");
}

std::string made(const TreesimOptions& o, std::int64_t frames, std::chrono::steady_clock::time_point start) {
    using namespace std::chrono;
    const auto ms = duration_cast<milliseconds>(steady_clock::now() - start).count();
    return o.common.output + ": " + std::to_string(frames) + " frames, " + std::to_string(ms) + " ms";
}

} // namespace

void watch(const TreesimOptions& o, const std::function<std::int64_t()>& run) {
    interrupt_at_boundary();
    Files files{o.run.input};
    for (;;) {
        hold_inputs();
        try {
            files = files_read(o.run);
            if (!o.skin.empty()) files.push_back(o.skin);
        } catch (const std::exception&) {
            // the run will say why; what was read before is what may be mended
        }
        std::vector<NamedFile> outputs = output_files(o, chosen_format(o.common));
        outputs.insert(outputs.end(), {{"--save-state", o.save_state}, {"--save-tree", o.save_tree}});
        for (const std::string& file : files)
            for (const auto& [option, written] : outputs)
                if (!written.empty() && same_file(file, written))
                    throw UsageError("--watch: " + option + " is '" + written +
                                     "', which is one of the files that are read");
        const std::vector<Stamp> seen = stamps(files);
        const auto start = std::chrono::steady_clock::now();
        std::string line;
        bool failed = false;
        try {
            hold_inputs(); // what changed since the files were looked up is the run's to read
            line = made(o, run(), start);
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {
            line = valid_utf8(in_words(error.what()));
            failed = true;
        }
        if (failed || !o.common.quiet) std::cerr << "treesim: " + time_of_day() + " " + line + "\n" << std::flush;
        while (stamps(files) == seen) pause();
        for (std::vector<Stamp> now = stamps(files), before; now != before; now = stamps(files)) {
            before = now;
            pause();
        }
    }
}

} // namespace bough
