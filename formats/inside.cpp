#include "inside.h"
#include <algorithm>
#include <filesystem>
#include <mutex>

namespace bough {
namespace {

namespace fs = std::filesystem;

std::mutex named_files_mutex;
std::set<std::string> named_files;

// Whether the name alone leads out: it is absolute and of another folder, or it climbs above the folder on its way.
bool leads_out(const std::string& path, const std::string& folder) {
    const std::string top = folder.ends_with('/') ? folder : folder + "/";
    fs::path rest;
    if (!folder.empty() && path.starts_with(top)) {
        rest = path.substr(top.size());
    } else if ((folder.empty() || folder == ".") && fs::path(path).is_relative()) {
        rest = path;
    } else {
        std::error_code error;
        const fs::path full = fs::absolute(path, error).lexically_normal();
        if (!error)
            rest = full.lexically_relative(fs::absolute(folder.empty() ? "." : folder, error).lexically_normal());
        if (error || rest.empty()) return true;
    }
    int depth = 0;
    for (const fs::path& step : rest) {
        if (step == "..") --depth;
        if (depth < 0) return true;
        if (step != ".." && step != "." && step != "/" && !step.empty()) ++depth;
    }
    return false;
}

} // namespace

const char* const out_of_reach = "leads out of the folder of the file that names it; --outside lets it";

const char* const no_regular_file =
    "is no regular file, expected one: what a file names is not read from a pipe or device";

bool opens_at_once(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    return !exists(status) || is_regular_file(status) || is_directory(status);
}

std::set<std::string> named_files_read() {
    const std::lock_guard guard(named_files_mutex);
    return named_files;
}

void note_named_file(const std::string& path) {
    const std::lock_guard guard(named_files_mutex);
    named_files.insert(path);
}

bool& may_reach_outside() {
    static bool may = false;
    return may;
}

bool within_reach(const std::string& path, const std::string& folder) {
    if (may_reach_outside()) return true;
    if (leads_out(path, folder)) return false;
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
