#include "sequence.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <cassert>
#include <charconv>
#include <filesystem>

namespace bough {
namespace {

// The pattern's pieces: folder/prefix, width of the number, suffix.
struct Pattern {
    std::string prefix, suffix;
    int width = 0;
    std::string wrong;
};

Pattern parse(const std::string& pattern) {
    Pattern parts;
    const std::size_t slash = pattern.find_last_of('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t percent = pattern.find('%');
    auto wrong = [&](const std::string& what) {
        parts.wrong = what + ", expected a name like oak_%04d.obj";
        return parts;
    };
    if (percent == std::string::npos) return wrong("has no %d for the number");
    if (percent < name) return wrong("has a % in its folder");
    if (percent == name) return wrong("has nothing before the number in the file's name (programs look for a prefix)");
    std::size_t end = percent + 1;
    if (end < pattern.size() && pattern[end] == '0') {
        const char* const last = pattern.data() + pattern.size();
        const auto [stop, error] = std::from_chars(pattern.data() + end + 1, last, parts.width);
        if (error != std::errc() || parts.width < 1 || parts.width > 18)
            return wrong("has a width that is not 1 to 18 after %0");
        end = std::size_t(stop - pattern.data());
    }
    if (end >= pattern.size() || pattern[end] != 'd') return wrong("has a % that is not %d or %0Nd");
    if (pattern.find('%', end) != std::string::npos) return wrong("has more than one %");
    parts.prefix = pattern.substr(0, percent);
    parts.suffix = pattern.substr(end + 1);
    return parts;
}

} // namespace

std::string valid_sequence(const std::string& pattern) {
    return parse(pattern).wrong;
}

std::string sequence_name(const std::string& pattern, std::int64_t frame) {
    const Pattern parts = parse(pattern);
    assert(parts.wrong.empty() && frame >= 0);
    const std::string number = std::to_string(frame);
    const std::size_t width = std::size_t(parts.width);
    return parts.prefix + std::string(width > number.size() ? width - number.size() : 0, '0') + number + parts.suffix;
}

std::optional<std::int64_t> sequence_frame(const std::string& pattern, const std::string& file) {
    const Pattern parts = parse(pattern);
    assert(parts.wrong.empty());
    const std::string prefix = parts.prefix.substr(parts.prefix.find_last_of('/') + 1); // npos + 1: from its start
    if (file.size() <= prefix.size() + parts.suffix.size() || !file.starts_with(prefix) ||
        !file.ends_with(parts.suffix))
        return std::nullopt;
    const std::string number = file.substr(prefix.size(), file.size() - prefix.size() - parts.suffix.size());
    std::int64_t frame = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), frame);
    if (error != std::errc() || end != number.data() + number.size() || frame < 0) return std::nullopt;
    const std::string written = sequence_name(pattern, frame);
    return written.ends_with(file) ? std::optional(frame) : std::nullopt; // not 007 for %d
}

std::vector<SequenceFile> sequence_files(const std::string& pattern) {
    const std::size_t slash = pattern.find_last_of('/');
    const std::string folder = slash == std::string::npos ? "." : pattern.substr(0, slash + 1);
    std::vector<SequenceFile> files;
    std::error_code none;
    for (std::filesystem::directory_iterator at(folder, none), end; !none && at != end; at.increment(none))
        if (const auto frame = sequence_frame(pattern, at->path().filename().string()))
            files.push_back({*frame, sequence_name(pattern, *frame)});
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return files;
}

std::string left_behind(const std::string& pattern, std::int64_t last, const char* one, const char* several) {
    std::vector<SequenceFile> older = sequence_files(pattern);
    std::erase_if(older, [last](const SequenceFile& file) { return file.frame <= last; });
    if (older.empty()) return "";
    return pattern + ": " + counted(older.size(), one, several) +
           " of an earlier run stay behind the last one: " + older.front().name +
           (older.size() > 1 ? " to " + older.back().name : "");
}

std::string sequence_mtl(const std::string& pattern) {
    const std::string prefix = parse(pattern).prefix;
    const std::size_t slash = prefix.find_last_of('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t last = prefix.find_last_not_of("_-. ");
    const bool only_marks = last == std::string::npos || last < name;
    return (only_marks ? prefix : prefix.substr(0, last + 1)) + ".mtl";
}

} // namespace bough
