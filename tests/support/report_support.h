// report_support.h: what the tests of reports share.
#pragma once
#include "formats/error.h"
#include "formats/open.h"
#include "formats/reports/gnuplot.h"
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <unistd.h>
#include <vector>

namespace bough {

// A folder of its own, removed at the end.
struct ReportFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("bough-report-" + std::to_string(::getpid()));
    ReportFolder() { std::filesystem::create_directories(path); }
    ~ReportFolder() { std::filesystem::remove_all(path); }
    std::string file(const std::string& name) const { return (path / name).string(); }
    std::size_t files() const {
        return std::size_t(
            std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator{}));
    }
};

// What `write` writes.
inline std::string written(const std::function<void(Output&)>& write) {
    const ReportFolder folder;
    Output output(folder.file("output"));
    write(output);
    output.finish();
    return read_input(folder.file("output"));
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
    }
    return lines;
}

// A PATH without gnuplot, while it lives.
struct NoPrograms {
    std::string before = std::getenv("PATH") ? std::getenv("PATH") : "";
    NoPrograms() { ::setenv("PATH", "/nowhere", 1); }
    ~NoPrograms() { ::setenv("PATH", before.c_str(), 1); }
};

inline bool has_gnuplot() {
    try {
        require_gnuplot("test");
        return true;
    } catch (const OutputError&) {
        WARN("skipped: gnuplot is not installed (Debian: gnuplot-nox)");
        return false;
    }
}

} // namespace bough
