// import_support.h: what the tests of the foreign formats share: files in, errors as text, damage.
#pragma once
#include "formats/error.h"
#include "formats/imports/import.h"
#include "replaced.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>

namespace bough::test {

inline std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    INFO(path);
    REQUIRE(file.good());
    std::ostringstream out;
    out << file.rdbuf();
    return out.str();
}

inline std::string fixture(const std::string& name) {
    return content_of(std::string(BOUGH_DATA_DIR) + "/fixtures/" + name);
}

// A file of the cases that are not ours, or nothing, with a notice, where they are not present.
inline std::optional<std::string> foreign_case(const std::string& name) {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (folder == nullptr) {
        WARN("BOUGH_CASES_DIR is not set: " << name << " not tested");
        return {};
    }
    return content_of(std::string(folder) + "/" + name);
}

struct Imported {
    Splines splines;
    ImportNotes notes;
    bool notes_hold(const std::string& text) const {
        for (const std::string& line : notes.lines)
            if (line.find(text) != std::string::npos) return true;
        return false;
    }
};

// Where the file has it, unless it is to be set on the ground.
inline Imported imported(const std::string& content, const std::string& name, ImportOptions options = {},
                         bool on_ground = false) {
    options.keep_place = !on_ground;
    options.name = name;
    Imported result;
    result.splines = import_splines(content, options, result.notes);
    const auto defect = check(result.splines);
    INFO((defect ? defect->field + " " + defect->message : ""));
    REQUIRE_FALSE(defect);
    return result;
}

// The text of the InputError that the content gives, which must be one line; empty if it is read.
inline std::string error_of(const std::string& content, const std::string& name) {
    try {
        imported(content, name);
    } catch (const InputError& e) {
        const std::string text = e.what();
        const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
        CHECK(std::all_of(text.begin(), text.end(), printable));
        CHECK(text.compare(0, name.size() + 1, name + ":") == 0);
        return text;
    }
    return {};
}

// Cuts the content at every `step`th byte and flips bytes at random: each variant must be read or refused in one line.
inline void damage(const std::string& content, const std::string& name, std::size_t step, int rounds = 2000) {
    for (std::size_t cut = 0; cut < content.size(); cut += step) error_of(content.substr(0, cut), name);
    std::mt19937 random(7);
    for (int round = 0; round < rounds; ++round) {
        INFO("bytes changed, round " << round);
        std::string broken = content;
        for (int flips = 1 + round % 4; flips > 0; --flips)
            broken[random() % broken.size()] = round % 2 ? char(random() % 256) : "0123456789-.,<>/\" e"[random() % 19];
        error_of(broken, name);
    }
}

inline double branch_length(const Splines& s, std::size_t b) {
    double length = 0;
    for (std::int32_t k = s.first_point[b]; k + 1 < s.first_point[b + 1]; ++k)
        length += (s.point[k + 1] - s.point[k]).norm();
    return length;
}

inline double total_length(const Splines& s) {
    double length = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) length += branch_length(s, b);
    return length;
}

inline std::size_t segments(const Splines& s) {
    return s.points() - s.branches();
}

inline double top_of(const Splines& s) {
    double top = -1e300;
    for (const Vec3& p : s.point) top = std::max(top, p.y());
    return top;
}

inline bool near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
    return (a - b).norm() <= tolerance;
}

} // namespace bough::test
