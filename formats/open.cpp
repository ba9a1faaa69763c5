#include "open.h"
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <poll.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace bough {
namespace {

constexpr std::size_t buffer_size = std::size_t(1) << 20;

std::string reason(int error) {
    return std::generic_category().message(error);
}

struct Descriptor {
    int fd;
    bool owned;
    ~Descriptor() {
        if (owned && fd >= 0) ::close(fd);
    }
};

// Reads until the end; `expected` bytes are made room for first so that a file of known size is one allocation. By way of
// a buffer that stays in cache: no byte of the content is written twice, as filling it with zeros first would.
std::string read_all(int fd, std::size_t expected, const std::string& name) {
    std::string content;
    try {
        content.reserve(expected);
        const auto buffer = std::make_unique<char[]>(std::min(expected + 1, buffer_size));
        for (;;) {
            const ssize_t n = ::read(fd, buffer.get(), std::min(expected + 1, buffer_size));
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) throw InputError(name, "cannot be read: " + reason(errno));
            if (n == 0) break;
            content.append(buffer.get(), std::size_t(n));
        }
    } catch (const std::bad_alloc&) {
        throw InputError(name, "does not fit into memory");
    } catch (const std::length_error&) {
        throw InputError(name, "does not fit into memory");
    }
    return content;
}

// Temporary files that exist, for remove_unfinished_outputs(). A list that only grows, its entries used again; whoever
// takes a name out of an entry owns it, so that a signal at any moment sees a whole name or none.
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

bool is_special(const std::string& path) {
    return path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0;
}

} // namespace

std::string folder_of(const std::string& path) {
    if (path == "-") return "";
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

std::string input_name(const std::string& path) {
    return path == "-" ? "<stdin>" : path;
}

namespace {

// What the system says of an input that is open.
struct stat status_of(int fd, const std::string& name) {
    if (fd < 0) throw InputError(name, "cannot be opened: " + reason(errno));
    struct stat status;
    if (::fstat(fd, &status) != 0) throw InputError(name, "cannot be read: " + reason(errno));
    if (S_ISDIR(status.st_mode)) throw InputError(name, "is a directory, expected a file");
    return status;
}

Descriptor open_descriptor(const std::string& path) {
    const bool standard = path == "-";
    return {standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), !standard};
}

std::string read_all(int fd, const struct stat& status, const std::string& name) {
    const bool sized = S_ISREG(status.st_mode) && status.st_size > 0;
    return read_all(fd, sized ? std::size_t(status.st_size) : 65536, name);
}

void read_at(int fd, std::uint64_t at, std::size_t count, char* to, const std::string& name) {
    while (count > 0) {
        const ssize_t n = ::pread(fd, to, count, off_t(at));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw InputError(name, "cannot be read: " + reason(errno));
        if (n == 0)
            throw InputError(name, "ended at byte " + std::to_string(at) + " while it was read: is it being written?");
        at += std::uint64_t(n);
        to += n;
        count -= std::size_t(n);
    }
}

// [bytes] of a binary document's header with its length before it, 0 where the file begins otherwise: the length (8 bytes,
// little-endian), then an object, then at least one byte. A text's first characters make a length that no file has.
std::size_t binary_header(int fd, std::uint64_t size, const std::string& name) {
    constexpr std::size_t prefix = 8;
    if (size <= prefix) return 0;
    unsigned char head[prefix + 1];
    read_at(fd, 0, sizeof head, reinterpret_cast<char*>(head), name);
    std::uint64_t length = 0;
    for (std::size_t k = prefix; k-- > 0;) length = length << 8 | head[k];
    return head[prefix] == '{' && length < size - prefix ? prefix + std::size_t(length) : 0;
}

} // namespace

std::string read_input(const std::string& path) {
    const std::string name = input_name(path);
    const Descriptor file = open_descriptor(path);
    return read_all(file.fd, status_of(file.fd, name), name);
}

Input::Input(const std::string& path) : name_(input_name(path)) {
    Descriptor file = open_descriptor(path);
    const struct stat status = status_of(file.fd, name_);
    size_ = std::uint64_t(status.st_size);
    // stdin may stand anywhere in its file: of it, what is still to be read is all.
    if (const std::size_t header = file.owned && S_ISREG(status.st_mode) ? binary_header(file.fd, size_, name_) : 0) {
        content_.resize(header);
        read_at(file.fd, 0, header, content_.data(), name_);
        file_ = std::exchange(file.fd, -1);
        return;
    }
    content_ = read_all(file.fd, status, name_);
    size_ = content_.size();
}

Input::~Input() {
    if (file_ >= 0) ::close(file_);
}

std::string Input::all() const {
    std::string all(content_);
    all.resize(std::size_t(size_));
    if (file_ >= 0) read(content_.size(), all.size() - content_.size(), all.data() + content_.size());
    return all;
}

void Input::read(std::uint64_t at, std::size_t count, char* to) const {
    if (file_ < 0)
        std::memcpy(to, content_.data() + at, count);
    else
        read_at(file_, at, count, to, name_);
}

Output::Output(const std::string& path) : name_(path == "-" ? "<stdout>" : path), path_(path) {
    if (path == "-") {
        if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) fail("is closed", errno);
        file_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        if (file_ < 0) fail("cannot be opened", errno);
        return;
    }
    // Follow links ourselves: the file a link names is replaced, or made if it is not there yet.
    bool special = is_special(path_);
    std::error_code none;
    for (int hops = 0; !special && std::filesystem::is_symlink(path_, none); ++hops) {
        if (hops == 40) fail("cannot be opened", ELOOP);
        const std::filesystem::path here(path_);
        path_ = (here.parent_path() / std::filesystem::read_symlink(here, none)).string();
        special = is_special(path_);
    }
    struct stat status;
    const bool exists = ::stat(path_.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) fail("cannot be written", errno);
    if (exists && S_ISDIR(status.st_mode)) fail("cannot be written", EISDIR);
    if (exists && (special || !S_ISREG(status.st_mode))) {
        open_direct();
        return;
    }
    if (exists && ::access(path_.c_str(), W_OK) != 0) fail("cannot be written", errno);
    open_temporary(exists ? unsigned(status.st_mode) & 07777u : 0u);
}

void Output::open_direct() {
    file_ = ::open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (file_ < 0) fail("cannot be opened", errno);
}

void Output::open_temporary(unsigned mode) {
    static std::atomic<unsigned> count{0};
    const std::filesystem::path directory = std::filesystem::path(path_).parent_path();
    do {
        const std::string leaf = ".bough-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
        temporary_ = (directory / leaf).string();
        file_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file_ < 0 && errno == EEXIST);
    if (file_ < 0) {
        const int error = errno;
        temporary_.clear();
        fail("cannot be created", error);
    }
    registered_ = register_unfinished(temporary_);
    if (mode != 0) (void)!::fchmod(file_, mode); // another owner's file: the umask's permissions are what we may give
}

Output::~Output() {
    if (file_ >= 0) ::close(file_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    release_unfinished(registered_);
}

void Output::fail(const std::string& what, int error) {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    temporary_.clear();
    release_unfinished(std::exchange(registered_, nullptr));
    throw OutputError(name_, what + ": " + reason(error));
}

void Output::write_out(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file_, bytes.data(), bytes.size());
        if (n >= 0) {
            bytes.remove_prefix(std::size_t(n));
        } else if (errno == EAGAIN ||
                   errno == EWOULDBLOCK) { // a terminal or pipe that another program made non-blocking
            pollfd ready{file_, POLLOUT, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            fail("cannot be written", errno);
        }
    }
}

Output::Output(char* to, std::size_t capacity, const std::string& name)
    : name_(name), memory_(to), capacity_(capacity), in_memory_(true) {}

void Output::write(std::string_view bytes) {
    if (in_memory_) {
        if (bytes_ < capacity_)
            std::memcpy(memory_ + bytes_, bytes.data(), std::min(bytes.size(), capacity_ - std::size_t(bytes_)));
        bytes_ += bytes.size();
        return;
    }
    if (file_ < 0) throw OutputError(name_, "cannot be written: it is closed");
    bytes_ += bytes.size();
    if (buffer_.size() + bytes.size() > buffer_size) flush();
    if (bytes.size() > buffer_size) return write_out(bytes);
    if (buffer_.capacity() < buffer_size) buffer_.reserve(buffer_size);
    buffer_.append(bytes);
}

void Output::flush() {
    if (in_memory_) return;
    if (file_ < 0) throw OutputError(name_, "cannot be written: it is closed");
    write_out(buffer_);
    buffer_.clear();
}

void Output::replace(std::uint64_t at, std::string_view bytes) {
    assert(changeable());
    flush();
    while (!bytes.empty()) {
        const ssize_t n = ::pwrite(file_, bytes.data(), bytes.size(), off_t(at));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail("cannot be written", errno);
        bytes.remove_prefix(std::size_t(n));
        at += std::uint64_t(n);
    }
}

void Output::take_out(std::uint64_t at, std::uint64_t count) {
    assert(changeable());
    flush();
    const auto block = std::make_unique<char[]>(buffer_size);
    for (;;) {
        const ssize_t n = ::pread(file_, block.get(), buffer_size, off_t(at + count));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail("cannot be read back", errno);
        if (n == 0) break;
        replace(at, {block.get(), std::size_t(n)});
        at += std::uint64_t(n);
    }
    if (::ftruncate(file_, off_t(at)) != 0 || ::lseek(file_, off_t(at), SEEK_SET) < 0) fail("cannot be written", errno);
}

void Output::finish() {
    if (in_memory_) return;
    flush();
    if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR) fail("cannot be written", errno);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be written", errno);
    temporary_.clear();
    release_unfinished(std::exchange(registered_, nullptr));
}

void remove_unfinished_outputs() noexcept {
    for (Unfinished* u = unfinished.load(); u; u = u->next)
        if (const char* path = u->path.exchange(nullptr)) ::unlink(path);
}

Form form_of_name(const std::string& path) {
    constexpr std::string_view ending = ".safetensors";
    const bool binary =
        path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
    return binary ? Form::safetensors : Form::json;
}

} // namespace bough
