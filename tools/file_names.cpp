#include "file_names.h"
#include "exits.h"
#include "formats/exports/sequence.h"
#include "formats/inside.h"
#include "formats/output_place.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace bough {

namespace {

bool is_pattern(const std::string& file) {
    return file.find('%') != std::string::npos && valid_sequence(file).empty();
}

// The files that a name stands for, as far as they can be told apart: itself, or of a pattern those that are links, and the pattern.
struct Written {
    std::string option, pattern; // "": one file
    std::vector<OutputPlace> places;
};

Written written_by(const NamedFile& output) {
    if (!is_pattern(output.file)) return {output.option, {}, {output_place(output.file)}};
    // The last number has as many digits as a pattern can ask for, so that %d and %04d give one name.
    constexpr std::int64_t last = 999'999'999'999'999'999;
    Written files{output.option, output.file, {output_place(sequence_name(output.file, 0))}};
    try {
        files.places.push_back(output_place(sequence_name(output.file, last)));
    } catch (const OutputError&) { // a name that is too long, which a number of fewer digits may not make
    }
    std::error_code none;
    for (const SequenceFile& file : sequence_files(output.file))
        if (std::filesystem::is_symlink(file.name, none)) files.places.push_back(output_place(file.name));
    return files;
}

bool holds(const Written& files, const OutputPlace& place) {
    for (const OutputPlace& own : files.places)
        if (same_output(own, place)) return true;
    if (files.pattern.empty() || place.direct) return false;
    const std::optional<std::int64_t> frame = sequence_frame(files.pattern, place.name);
    return frame && same_output(output_place(sequence_name(files.pattern, *frame)), place);
}

bool meet(const Written& one, const Written& other) {
    for (const OutputPlace& place : other.places)
        if (holds(one, place)) return true;
    for (const OutputPlace& place : one.places)
        if (holds(other, place)) return true;
    return false;
}

bool replaces(const Written& output, const std::string& input) {
    struct stat status {};
    const bool there = input == "-" ? ::fstat(STDIN_FILENO, &status) == 0 : ::stat(input.c_str(), &status) == 0;
    if (!there || S_ISDIR(status.st_mode)) return false;
    if (input != "-") return holds(output, output_place(input));
    if (!S_ISREG(status.st_mode)) return false;
    const OutputPlace::File file{std::uint64_t(status.st_dev), std::uint64_t(status.st_ino)};
    return std::any_of(output.places.begin(), output.places.end(),
                       [&](const OutputPlace& place) { return place.exists && place.file == file; });
}

} // namespace

bool same_file(const std::string& input, const std::string& output) {
    return !input.empty() && !output.empty() && replaces(written_by({"", output}), input);
}

bool is_kept(const std::string& output) {
    struct stat status {};
    const bool there = output == "-" ? ::fstat(STDOUT_FILENO, &status) == 0 : ::stat(output.c_str(), &status) == 0;
    return there ? S_ISREG(status.st_mode) || S_ISDIR(status.st_mode) : output != "-";
}

void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
    for (const NamedFile& output : written)
        for (const NamedFile& input : read)
            if (same_file(input.file, output.file))
                throw UsageError(output.option + ": is '" + output.file + "', which " + input.option +
                                 " reads and the output would replace");
}

void refuse_overwriting_the_model(const std::vector<NamedFile>& written) {
    for (const std::string& file : named_files_read()) refuse_overwriting({{"the model", file}}, written);
}

void refuse_overwriting_by_images(const std::vector<NamedFile>& named, const std::vector<std::string>& images) {
    for (const std::string& image : images) {
        const std::string folder = std::filesystem::path(image).parent_path().string();
        std::error_code none;
        const bool made = folder.empty() || std::filesystem::is_directory(folder, none);
        const Written written{"", {}, {output_place(made ? image : folder)}};
        for (const NamedFile& other : named)
            if (!other.file.empty() &&
                (other.file == "-" ? replaces(written, "-") : holds(written, output_place(other.file))))
                throw UsageError("-o: an image beside it would be '" + image + "', the file of " + other.option +
                                 "; expected another name");
        require_output(made ? image : folder);
    }
}

namespace {

// Two files of a sequence that are one, by links that stand there already.
void refuse_one_for_two(const NamedFile& output) {
    std::error_code none;
    std::map<std::string, std::string> links; // by the place that each leads to
    for (const SequenceFile& file : sequence_files(output.file)) {
        if (!std::filesystem::is_symlink(file.name, none)) continue;
        const OutputPlace place = output_place(file.name);
        const auto [known, first] = links.emplace(place.path, file.name);
        std::string other = first || place.direct ? "" : known->second;
        const std::int64_t frame = place.direct ? -1 : sequence_frame(output.file, place.name).value_or(-1);
        if (other.empty() && frame >= 0 && frame != file.frame)
            if (const std::string named = sequence_name(output.file, frame); same_output(output_place(named), place))
                other = named;
        if (!other.empty())
            throw UsageError(output.option + ": '" + file.name + "' is a link to the file of '" + other +
                             "', and each would replace the other; remove the link");
    }
}

} // namespace

void require_outputs(const std::vector<NamedFile>& written) {
    std::vector<Written> all;
    for (const NamedFile& output : written) {
        if (output.file.empty()) continue;
        Written files = written_by(output);
        for (const Written& other : all)
            if (meet(files, other))
                throw UsageError(output.option + ": is '" + output.file + "', the same file as " + other.option +
                                 " writes");
        if (!files.pattern.empty()) refuse_one_for_two(output);
        all.push_back(std::move(files));
    }
    for (const NamedFile& output : written)
        if (!output.file.empty()) require_output(is_pattern(output.file) ? sequence_name(output.file, 0) : output.file);
}

std::string ending(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

} // namespace bough
