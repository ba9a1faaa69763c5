#include "file_names.h"
#include "exits.h"
#include "formats/plain_text.h"
#include <filesystem>

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

std::string ending(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

} // namespace bough
