#include "forked.h"
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <pthread.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// A sanitizer's own memory is no matter of limits.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BOUGH_CHILD_UNLIMITED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BOUGH_CHILD_UNLIMITED
#endif
#endif

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

// [bytes] of address space that this process has.
[[maybe_unused]] std::size_t address_space() {
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    file >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void keep_limits([[maybe_unused]] const ChildLimits& limits) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (limits.seconds > 0) {
        const rlimit seconds{limits.seconds, limits.seconds + 1};
        ::setrlimit(RLIMIT_CPU, &seconds);
    }
#ifndef BOUGH_CHILD_UNLIMITED
    if (limits.bytes > 0) {
        const rlimit bytes{address_space() + limits.bytes, RLIM_INFINITY};
        ::setrlimit(RLIMIT_AS, &bytes);
    }
#endif
}

std::string outcome(const std::function<std::string()>& work) {
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
        bytes += unnamed_failure;
    }
    return bytes;
}

struct Job {
    const std::function<std::string()>& work;
    std::string bytes{};
};

void* run_job(void* job) {
    static_cast<Job*>(job)->bytes = outcome(static_cast<Job*>(job)->work);
    return nullptr;
}

// On a stack of its own size; without one where there is no memory for it.
std::string outcome(const std::function<std::string()>& work, std::size_t stack) {
    Job job{work};
    pthread_attr_t size;
    pthread_t thread;
    ::pthread_attr_init(&size);
    if (stack == 0 || ::pthread_attr_setstacksize(&size, stack) != 0 ||
        ::pthread_create(&thread, &size, run_job, &job) != 0)
        return outcome(work);
    ::pthread_join(thread, nullptr);
    return std::move(job.bytes);
}

[[noreturn]] void be_child(int pipe, const std::function<std::string()>& work, const ChildLimits& limits) {
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGHUP, SIGXCPU})
        ::signal(crash, SIG_DFL);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    keep_limits(limits);
    const std::string bytes = outcome(work, limits.stack);
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

// When it has ended.
int status_of(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

} // namespace

ChildResult run_forked(const std::function<std::string()>& work, const ChildLimits& limits) {
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
        be_child(ends[1], work, limits);
    }
    ::close(ends[1]);
    std::string bytes;
    try {
        bytes = received(ends[0]);
    } catch (...) {       // no memory for it
        ::close(ends[0]); // on which the child ends
        (void)status_of(child);
        throw;
    }
    ::close(ends[0]);
    const int status = status_of(child);
    ChildResult result;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        result.failure = "took longer than " + std::to_string(limits.seconds) + " s";
    else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGBUS) // as an input does that is mapped (mapped.h)
        result.failure = "found the file cut short while it was read";
    else if (WIFSIGNALED(status))
        result.failure = "crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    else if (bytes.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        result.failure = "crashed";
    else if (bytes[0] == kFailed)
        result.failure = bytes.size() > 1 ? bytes.substr(1) : unnamed_failure;
    else
        result.bytes = bytes.substr(1);
    return result;
}

} // namespace bough
