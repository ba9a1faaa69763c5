#include "output_place.h"
#include "temporary.h"
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#ifdef __linux__
#include <linux/magic.h>
#include <sys/vfs.h>
#endif

namespace bough {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what, int error) {
    throw OutputError(name, what + ": " + std::generic_category().message(error));
}

// Whether a folder's files are the system's own, where none can be made and links are no names: /proc/self/fd/1.
bool in_proc([[maybe_unused]] const std::string& folder) {
#ifdef __linux__
    struct statfs system {};
    return ::statfs(folder.c_str(), &system) == 0 &&
           (system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC);
#else
    return false;
#endif
}

std::string folder_of_place(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

OutputPlace::File file_of(const struct stat& status) {
    return {std::uint64_t(status.st_dev), std::uint64_t(status.st_ino)};
}

OutputPlace standard_output() {
    OutputPlace place;
    place.path = "-";
    place.direct = true;
    struct stat status {};
    place.exists = ::fstat(STDOUT_FILENO, &status) == 0; // closed: the Output says so
    if (place.exists) place.file = file_of(status);
    place.swallows = place.exists && S_ISCHR(status.st_mode);
    return place;
}

} // namespace

OutputPlace output_place(const std::string& path) {
    if (path == "-") return standard_output();
    OutputPlace place;
    place.path = path;
    std::error_code none;
    bool own_link = false;
    for (int hops = 0; std::filesystem::is_symlink(place.path, none); ++hops) {
        if (hops == 40) fail(path, "cannot be opened", ELOOP);
        if ((own_link = in_proc(folder_of_place(place.path)))) break;
        const std::filesystem::path here(place.path);
        place.path = (here.parent_path() / std::filesystem::read_symlink(here, none)).string();
    }
    struct stat status {};
    place.exists = ::stat(place.path.c_str(), &status) == 0;
    if (!place.exists && errno != ENOENT) fail(path, "cannot be written", errno);
    if (place.exists && S_ISDIR(status.st_mode)) fail(path, "cannot be written", EISDIR);
    place.mode = unsigned(status.st_mode) & 07777u;
    if (place.exists) place.file = file_of(status);
    const std::string folder = folder_of_place(place.path);
    place.direct = own_link || (place.exists && (!S_ISREG(status.st_mode) || in_proc(folder)));
    place.swallows = place.direct && S_ISCHR(status.st_mode);
    if (place.direct) return place;
    place.name = std::filesystem::path(place.path).filename().string();
    if (::stat(folder.c_str(), &status) == 0) place.folder = file_of(status);
    return place;
}

bool same_output(const OutputPlace& one, const OutputPlace& other) {
    if (one.swallows || other.swallows) return false;
    if (!one.direct && !other.direct)
        return one.name == other.name && one.folder == other.folder &&
               (one.folder != OutputPlace::File() || one.path == other.path);
    return one.exists && other.exists && one.file == other.file;
}

namespace {

// 0, or why the system will not put another file in its place though the folder may be written to: EBUSY where something is mounted on it, EPERM
// where it is another user's in a folder whose files are their owners' alone (/tmp).
int kept_by_system([[maybe_unused]] const OutputPlace& place) {
#ifdef __linux__
    const std::string folder = folder_of_place(place.path);
    struct statx file {
    }, around{};
    constexpr unsigned asked = STATX_UID | STATX_MODE | STATX_MNT_ID;
    if (::statx(AT_FDCWD, place.path.c_str(), 0, asked, &file) != 0 ||
        ::statx(AT_FDCWD, folder.c_str(), 0, asked, &around) != 0)
        return 0;
    if ((file.stx_mask & around.stx_mask & STATX_MNT_ID) && file.stx_mnt_id != around.stx_mnt_id) return EBUSY;
    const uid_t user = ::geteuid();
    const bool kept = (around.stx_mode & S_ISVTX) && user != 0 && file.stx_uid != user && around.stx_uid != user;
    return kept ? EPERM : 0;
#else
    return 0;
#endif
}

} // namespace

void require_output(const std::string& path) {
    const OutputPlace place = output_place(path);
    if (place.direct && place.path == "-") return;
    if (place.exists && ::access(place.path.c_str(), W_OK) != 0) fail(path, "cannot be written", errno);
    if (place.direct) return;
    if (const int why = place.exists ? kept_by_system(place) : 0) fail(path, "cannot be replaced", why);
    try {
        const Temporary tried(place.path, place.mode);
    } catch (const std::system_error& error) {
        const std::filesystem::path folder = std::filesystem::path(path).parent_path();
        std::error_code none;
        if (!folder.empty() && !std::filesystem::exists(folder, none))
            throw OutputError(path, "cannot be created: No such file or directory, as there is no folder '" +
                                        folder.string() + "': make it first");
        fail(path, "cannot be created", error.code().value());
    }
}

} // namespace bough
