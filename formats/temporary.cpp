#include "temporary.h"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dirent.h>
#include <fcntl.h>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace bough {
namespace {

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

// Names that exist, for remove_unfinished_outputs(). A list that only grows, its entries used again; whoever takes a name out of an entry
// owns it, so that a signal at any moment sees a whole name or none.
struct Unfinished {
    std::atomic<char*> path{nullptr};
    Unfinished* next = nullptr;
};
std::atomic<Unfinished*> unfinished{nullptr};

Unfinished* register_unfinished(const std::string& path) {
    char* copy = ::strdup(path.c_str());
    if (!copy) throw std::bad_alloc();
    for (Unfinished* u = unfinished.load(); u; u = u->next) {
        char* none = nullptr;
        if (u->path.compare_exchange_strong(none, copy)) return u;
    }
    auto* u = new Unfinished;
    u->path = copy;
    u->next = unfinished.load();
    while (!unfinished.compare_exchange_weak(u->next, u)) {
    }
    return u;
}

void release_unfinished(void* entry) {
    if (entry) std::free(static_cast<Unfinished*>(entry)->path.exchange(nullptr));
}

// While a name comes to be: it is registered before it exists, and remove_unfinished_outputs() waits for those of other threads, so that it finds
// all.
// Once that has begun, no name comes to be any more: the process is about to end.
std::atomic<bool> ending{false};
std::atomic<int> naming{0};
struct Naming {
    Naming() {
        ++naming;
        if (!ending) return;
        --naming;
        for (;;) ::pause();
    }
    ~Naming() { --naming; }
    Naming(const Naming&) = delete;
    Naming& operator=(const Naming&) = delete;
};

// `.bough-PID-N.tmp`
bool is_temporary_name(std::string_view name) {
    constexpr std::string_view begin = ".bough-", end = ".tmp";
    if (name.size() < begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return false;
    name = name.substr(begin.size(), name.size() - begin.size() - end.size());
    const std::size_t dash = name.find('-');
    const auto is_number = [](std::string_view text) {
        return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    return dash != std::string_view::npos && is_number(name.substr(0, dash)) && is_number(name.substr(dash + 1));
}

// What is in an open folder: files alone, as no folder of ours holds others.
void remove_content(int folder) {
    const int copy = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); // which closedir() closes
    if (copy < 0) return;
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(copy), ::closedir);
    while (const dirent* entry = entries ? ::readdir(entries.get()) : nullptr) ::unlinkat(folder, entry->d_name, 0);
}

// A folder and what was finished in it, by calls that a signal's handler may make.
void remove_folder(const char* path) {
#ifdef __linux__
    const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    alignas(dirent64) char entries[4096];
    ssize_t got = 0;
    while (folder >= 0 && (got = ::getdents64(folder, entries, sizeof entries)) > 0)
        for (ssize_t at = 0; at < got; at += reinterpret_cast<const dirent64*>(entries + at)->d_reclen)
            ::unlinkat(folder, reinterpret_cast<const dirent64*>(entries + at)->d_name, 0);
#endif
    ::rmdir(path); // the folder stays open: the process ends
}

void remove_folder_if_left(int folder, const char* name) {
    const int left = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (left < 0) return;
    struct stat opened {};
    if (::fstat(left, &opened) == 0 && opened.st_uid == ::geteuid() && ::flock(left, LOCK_EX | LOCK_NB) == 0) {
        remove_content(left);
        ::unlinkat(folder, name, AT_REMOVEDIR);
    }
    ::close(left);
}

// Whoever writes a file holds its lock, on any machine that sees it.
void remove_if_left(int folder, const char* name) {
    const int file = ::openat(folder, name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0 && errno == EISDIR) return remove_folder_if_left(folder, name);
    if (file < 0) return;
    struct stat opened {
    }, named{};
    if (::fstat(file, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_uid == ::geteuid() &&
        ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
        named.st_dev == opened.st_dev && named.st_ino == opened.st_ino)
        ::unlinkat(folder, name, 0);
    ::close(file);
}

// Once for each folder: a sequence of many files looks through it for the first alone.
void remove_what_is_left(const std::string& folder) {
    static std::mutex mutex;
    // A new folder may have the number of one that is gone
    static std::set<std::tuple<std::string, dev_t, ino_t>> known;
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
    if (!entries) return; // it may be written to all the same
    struct stat status {};
    if (::fstat(::dirfd(entries.get()), &status) != 0) return;
    {
        const std::lock_guard lock(mutex);
        if (!known.insert({folder, status.st_dev, status.st_ino}).second) return;
    }
    while (const dirent* entry = ::readdir(entries.get()))
        if (is_temporary_name(entry->d_name)) remove_if_left(::dirfd(entries.get()), entry->d_name);
}

std::string link_to(int file) {
    return "/proc/self/fd/" + std::to_string(file);
}

// Where a path's file stands, with a slash behind; "." for a bare name.
std::string folder_before(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

// A name that no other of this process has.
std::string temporary_name(const std::string& folder) {
    static std::atomic<unsigned> count{0};
    const std::string leaf = ".bough-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
    return folder == "." ? leaf : folder + leaf;
}

} // namespace

Temporary::Temporary(const std::string& path, unsigned mode, bool nameless) : path_(path) {
    folder_ = folder_before(path);
    remove_what_is_left(folder_);
    if (!nameless || !open_nameless()) open_named();
    if (mode != 0) (void)!::fchmod(file_, mode); // another owner's file: the umask's permissions are what we may give
}

// A file system that has no such files refuses in several ways; what is truly wrong open_named() finds again.
bool Temporary::open_nameless() {
#ifdef O_TMPFILE
    file_ = ::open(folder_.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
    if (file_ < 0) return false;
    if (::access(link_to(file_).c_str(), F_OK) == 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0) return true;
    ::close(std::exchange(file_, -1)); // without /proc it could not be given a name
#endif
    return false;
}

void Temporary::open_named() {
    const Naming now;
    for (;;) {
        name_ = temporary_name(folder_);
        registered_ = register_unfinished(name_);
        file_ = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file_ < 0) {
            const int error = errno;
            release_unfinished(std::exchange(registered_, nullptr));
            if (error == EEXIST) continue;
            name_.clear();
            fail(error);
        }
        // Another process may take it for one that is left over until it is locked.
        const bool taken = ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        struct stat status {};
        if (!taken && (::fstat(file_, &status) != 0 || status.st_nlink > 0)) return;
        release_unfinished(std::exchange(registered_, nullptr));
        ::close(std::exchange(file_, -1));
    }
}

void Temporary::give_name() {
    const Naming now;
    const std::string link = link_to(file_);
    for (;;) {
        name_ = temporary_name(folder_);
        registered_ = register_unfinished(name_);
        if (::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
        const int error = errno;
        release_unfinished(std::exchange(registered_, nullptr));
        if (error == EEXIST) continue;
        name_.clear();
        fail(error);
    }
}

void Temporary::finish() {
    // A file system that writes later tells of its errors where a descriptor is closed; the lock has to outlast the new name.
    const int copy = ::fcntl(file_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0 || (::close(copy) != 0 && errno != EINTR)) fail(errno);
    if (name_.empty()) give_name();
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail(errno);
    name_.clear();
    release_unfinished(std::exchange(registered_, nullptr));
    ::close(std::exchange(file_, -1));
}

Temporary::~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
    release_unfinished(registered_);
    if (file_ >= 0) ::close(file_);
}

TemporaryFolder::TemporaryFolder(const std::string& path) : path_(path) {
    const std::string beside = folder_before(path);
    remove_what_is_left(beside);
    const Naming now;
    for (;;) {
        name_ = temporary_name(beside);
        registered_ = register_unfinished(name_);
        if (::mkdir(name_.c_str(), 0777) != 0) {
            const int error = errno;
            release_unfinished(std::exchange(registered_, nullptr));
            if (error == EEXIST) continue;
            name_.clear();
            fail(error);
        }
        folder_ = ::open(name_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (const int error = errno; folder_ < 0 && error != ENOENT) {
            ::rmdir(name_.c_str());
            release_unfinished(std::exchange(registered_, nullptr));
            name_.clear();
            fail(error);
        }
        // Another process may take it for one that is left over until it is locked.
        const bool taken = folder_ >= 0 && ::flock(folder_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        struct stat status {};
        if (folder_ >= 0 && !taken && ::stat(name_.c_str(), &status) == 0) return;
        release_unfinished(std::exchange(registered_, nullptr));
        if (folder_ >= 0) ::close(std::exchange(folder_, -1));
    }
}

void TemporaryFolder::finish() {
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail(errno);
    name_.clear();
    release_unfinished(std::exchange(registered_, nullptr));
    ::close(std::exchange(folder_, -1));
}

TemporaryFolder::~TemporaryFolder() {
    if (!name_.empty()) {
        remove_content(folder_);
        ::rmdir(name_.c_str());
    }
    release_unfinished(registered_);
    if (folder_ >= 0) ::close(folder_);
}

void remove_unfinished_outputs() noexcept {
    ending = true;
    // Not for ever: the signal may have met this thread itself while it was naming, which then goes no further.
    for (int wait = 0; wait < 500 && naming > 0; ++wait) {
        const timespec millisecond{0, 1000000};
        ::nanosleep(&millisecond, nullptr);
    }
    // Files first, which may stand in one of the folders.
    for (Unfinished* u = unfinished.load(); u; u = u->next)
        if (char* path = u->path.exchange(nullptr); path && ::unlink(path) != 0 && errno == EISDIR) u->path = path;
    for (Unfinished* u = unfinished.load(); u; u = u->next)
        if (const char* path = u->path.exchange(nullptr)) remove_folder(path);
}

} // namespace bough
