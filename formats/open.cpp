#include "open.h"
#include "free_memory.h"
#include "held_inputs.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace bough {
namespace {

constexpr std::size_t read_size = std::size_t(1) << 20;

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

} // namespace

std::string folder_of(const std::string& path) {
    if (path == "-") return "";
    const std::size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

namespace {

// What the system says of an input that is open.
struct stat status_of(int fd, const std::string& name) {
    if (fd < 0) throw InputError(name, "cannot be opened: " + reason(errno));
    struct stat status;
    if (::fstat(fd, &status) != 0) throw InputError(name, "cannot be read: " + reason(errno));
    if (S_ISDIR(status.st_mode)) throw InputError(name, "is a directory, expected a file");
    const bool empty = S_ISCHR(status.st_mode) && status.st_rdev == makedev(1, 3); // /dev/null
    if (S_ISBLK(status.st_mode) || (S_ISCHR(status.st_mode) && !empty && ::isatty(fd) == 0))
        throw InputError(name, "is a device, expected a file");
    return status;
}

Descriptor open_descriptor(const std::string& path) {
    const bool standard = path == "-";
    return {standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), !standard};
}

// A pipe that does not end would take all the memory there is, and with it other programs. As much again as it has brought has to be
// free, for what is made of it.
void require_room(const std::string& content, const std::string& name) {
    if (const std::size_t left = free_memory().value_or(SIZE_MAX); left < content.size())
        throw InputError(name, "does not fit into memory: it has not ended after " +
                                   std::to_string(content.size() >> 20) + " MB, and " + std::to_string(left >> 20) +
                                   " MB are free");
}

// Reads until the end; `expected` bytes are made room for first so that a file of known size is one allocation. By way of
// a buffer that stays in cache: no byte of the content is written twice, as filling it with zeros first would.
std::string read_all(int fd, std::size_t expected, bool pipe, const std::string& name) {
    std::string content;
    std::size_t looked_at = std::size_t(64) << 20; // asked after each block it would take longer than reading
    try {
        content.reserve(expected);
        const auto buffer = std::make_unique<char[]>(std::min(expected + 1, read_size));
        for (;;) {
            const ssize_t n = ::read(fd, buffer.get(), std::min(expected + 1, read_size));
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) throw InputError(name, "cannot be read: " + reason(errno));
            if (n == 0) break;
            content.append(buffer.get(), std::size_t(n));
            if (!pipe || content.size() < looked_at) continue;
            require_room(content, name);
            looked_at += looked_at / 4;
        }
    } catch (const std::bad_alloc&) {
        throw InputError(name, "does not fit into memory");
    } catch (const std::length_error&) {
        throw InputError(name, "does not fit into memory");
    }
    return content;
}

void require_unchanged(int fd, const FileVersion& opened, const std::string& name) {
    if (file_version(fd) != opened)
        throw InputError(name, "was written to while it was read, expected a finished file");
}

std::string read_all(int fd, const struct stat& status, const std::string& path) {
    const std::string name = input_name(path);
    if (!S_ISREG(status.st_mode)) {
        std::string content = read_all(fd, 65536, true, name);
        if (path != "-") hold_pipe(path, content);
        return content;
    }
    const FileVersion opened = settled_version(fd);
    if (path != "-") require_held(path, opened);
    std::string content = read_all(fd, opened.size > 0 ? std::size_t(opened.size) : 65536, false, name);
    require_unchanged(fd, opened, name);
    return content;
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
    if (const auto known = held_pipe(path)) return *known;
    const std::string name = input_name(path);
    const Descriptor file = open_descriptor(path);
    return read_all(file.fd, status_of(file.fd, name), path);
}

Input::Input(const std::string& path) : name_(input_name(path)) {
    if (const auto known = held_pipe(path)) {
        content_ = *known;
        size_ = content_.size();
        return;
    }
    Descriptor file = open_descriptor(path);
    const struct stat status = status_of(file.fd, name_);
    size_ = std::uint64_t(status.st_size);
    // stdin may stand anywhere in its file: of it, what is still to be read is all.
    const bool regular = file.owned && S_ISREG(status.st_mode);
    if (regular) opened_ = settled_version(file.fd);
    if (regular) size_ = std::uint64_t(opened_.size);
    if (const std::size_t header = regular ? binary_header(file.fd, size_, name_) : 0) {
        require_held(path, opened_);
        content_.resize(header);
        read_at(file.fd, 0, header, content_.data(), name_);
        require_unchanged(file.fd, opened_, name_);
        file_ = std::exchange(file.fd, -1);
        return;
    }
    content_ = read_all(file.fd, status, path);
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
    if (file_ < 0) {
        std::memcpy(to, content_.data() + at, count);
        return;
    }
    read_at(file_, at, count, to, name_);
    require_unchanged(file_, opened_, name_);
}

Form form_of_name(const std::string& path) {
    constexpr std::string_view ending = ".safetensors";
    const bool binary =
        path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
    return binary ? Form::safetensors : Form::json;
}

} // namespace bough
