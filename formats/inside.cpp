#include "inside.h"
#include <algorithm>
#include <filesystem>

namespace bough {

const char* const out_of_reach = "leads out of the folder of the file that names it; --outside lets it";

const char* const no_regular_file =
    "is no regular file, expected one: what a file names is not read from a pipe or device";

bool opens_at_once(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    return !exists(status) || is_regular_file(status) || is_directory(status);
}

bool& may_reach_outside() {
    static bool may = false;
    return may;
}

bool within_reach(const std::string& path, const std::string& folder) {
    if (may_reach_outside()) return true;
    std::error_code error;
    const auto resolved = [&error](const std::string& name) {
        // A path that is not absolute is not resolved where its first folder is not there.
        const std::filesystem::path full = std::filesystem::absolute(name.empty() ? "." : name, error);
        std::filesystem::path real = error ? full : std::filesystem::weakly_canonical(full, error);
        return real.has_filename() ? real : real.parent_path(); // without a last slash
    };
    const std::filesystem::path top = resolved(folder);
    if (error) return false;
    const std::filesystem::path named = resolved(path);
    return !error && std::mismatch(top.begin(), top.end(), named.begin(), named.end()).first == top.end();
}

} // namespace bough
