#include "file_names.h"
#include "exits.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <filesystem>
#include <string_view>

namespace bough {

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

std::string in_shell(const std::string& argument) {
    const auto plain = [](unsigned char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c >= 0x80 ||
               std::string_view("_-./=:,+%@").find(char(c)) != std::string_view::npos;
    };
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), plain)) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c == '\n' ? ' ' : c);
    return text + "'";
}

std::string ending(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

} // namespace bough
