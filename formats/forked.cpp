#include "forked.h"
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace bough {
namespace {

constexpr char kDone = 'D', kFailed = 'F'; // first byte of what the child sends

bool send(int pipe, const char* data, std::size_t size) {
    while (size > 0) {
        const ssize_t sent = ::write(pipe, data, size);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        data += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

[[noreturn]] void be_child(int pipe, const std::function<std::string()>& work) {
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGHUP})
        ::signal(crash, SIG_DFL);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    std::string bytes(1, kFailed);
    try {
        std::string made = work();
        bytes[0] = kDone;
        bytes += made;
    } catch (const std::bad_alloc&) {
        bytes += "needs more memory than there is";
    } catch (const std::exception& error) {
        bytes += error.what();
    } catch (...) {
        bytes += "failed";
    }
    ::_exit(send(pipe, bytes.data(), bytes.size()) ? 0 : 1);
}

std::string received(int pipe) {
    std::string bytes;
    char buffer[1 << 16];
    while (true) {
        const ssize_t got = ::read(pipe, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return bytes;
        bytes.append(buffer, static_cast<std::size_t>(got));
    }
}

} // namespace

ChildResult run_forked(const std::function<std::string()>& work) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error(std::string("no pipe to a child process: ") + std::strerror(errno));
    const pid_t child = ::fork();
    if (child < 0) {
        const int error = errno;
        ::close(ends[0]), ::close(ends[1]);
        throw std::runtime_error(std::string("no child process: ") + std::strerror(error));
    }
    if (child == 0) {
        ::close(ends[0]);
        be_child(ends[1], work);
    }
    ::close(ends[1]);
    std::string bytes = received(ends[0]);
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ChildResult result;
    if (WIFSIGNALED(status))
        result.failure = "crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    else if (bytes.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        result.failure = "crashed";
    else if (bytes[0] == kFailed)
        result.failure = bytes.size() > 1 ? bytes.substr(1) : "failed";
    else
        result.bytes = bytes.substr(1);
    return result;
}

} // namespace bough
