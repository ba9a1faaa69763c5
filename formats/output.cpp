#include "open.h"
#include "output_place.h"
#include "temporary.h"
#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace bough {
namespace {

constexpr std::size_t buffer_size = std::size_t(1) << 20;

}

Output::Output(const std::string& path) : Output(path, path == "-" ? "<stdout>" : path) {}

Output::Output(const std::string& path, const std::string& name) : name_(name) {
    if (path == "-") {
        if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) fail("is closed", errno);
        file_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        if (file_ < 0) fail("cannot be opened", errno);
        return;
    }
    const OutputPlace place = output_place(path);
    if (place.direct) {
        open_direct(place.path);
        return;
    }
    if (place.exists && ::access(place.path.c_str(), W_OK) != 0) fail("cannot be written", errno);
    try {
        temporary_ = std::make_unique<Temporary>(place.path, place.mode);
    } catch (const std::system_error& error) {
        fail("cannot be created", error.code().value());
    }
    file_ = temporary_->file();
}

// What stands in a file that another process has open (`-o /dev/fd/3 3>>log`) stays before what is written now.
void Output::open_direct(const std::string& path) {
    file_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file_ < 0) fail("cannot be opened", errno);
}

Output::~Output() {
    close();
}

int Output::close() {
    const int file = std::exchange(file_, -1);
    if (temporary_) {
        temporary_.reset();
        return 0;
    }
    return file >= 0 ? ::close(file) : 0;
}

void Output::fail(const std::string& what, int error) {
    close();
    throw OutputError(name_, what + ": " + std::generic_category().message(error));
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
    if (temporary_) {
        try {
            temporary_->finish();
        } catch (const std::system_error& error) {
            fail("cannot be written", error.code().value());
        }
    }
    if (close() != 0 && errno != EINTR) fail("cannot be written", errno);
}

} // namespace bough
