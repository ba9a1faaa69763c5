#include "forked.h"
#include "lib/base/sanitizers.h"
#include "plain_text.h"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <pthread.h>
#include <stdexcept>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bough {
namespace {

constexpr char kDone = 'D', kFailed = 'F', kLimited = 'L'; // first byte of what the child sends

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

std::string in_brackets(const std::string& text) {
    return text.empty() ? "" : " (" + text + ")";
}

// What holds for the child in the end, and how it is called.
struct Kept {
    rlimit seconds{RLIM_INFINITY, RLIM_INFINITY}, bytes{RLIM_INFINITY, RLIM_INFINITY};
    std::string seconds_text, bytes_text;
    std::size_t room = 0; // [bytes] that the second leaves beside what the caller has; 0: no limit
};

Kept kept_limits(const ChildLimits& limits) {
    Kept kept;
    ::getrlimit(RLIMIT_CPU, &kept.seconds);
    const std::string second = " s of processor time";
    kept.seconds_text = std::to_string(kept.seconds.rlim_cur) + second + " (ulimit -t)";
    if (limits.seconds > 0 && limits.seconds <= kept.seconds.rlim_cur) {
        kept.seconds.rlim_cur = limits.seconds;
        kept.seconds.rlim_max =
            std::min<rlim_t>(kept.seconds.rlim_max, limits.seconds + 1); // what ignores the first ends by the second
        kept.seconds_text = std::to_string(limits.seconds) + second + in_brackets(limits.seconds_from);
    }
    ::getrlimit(RLIMIT_AS, &kept.bytes);
    kept.bytes_text = kept.bytes.rlim_cur == RLIM_INFINITY ? "there is" : "ulimit -v leaves";
    if (const std::size_t taken = address_space(); kept.bytes.rlim_cur != RLIM_INFINITY)
        kept.room = std::max<std::size_t>(1, kept.bytes.rlim_cur > taken ? kept.bytes.rlim_cur - taken : 0);
#if !BOUGH_ADDRESS_SANITIZER && !BOUGH_THREAD_SANITIZER // whose own memory is no matter of limits
    const std::size_t most = address_space() + limits.stack + limits.bytes;
    if (limits.bytes > 0 && most <= kept.bytes.rlim_cur) {
        kept.bytes.rlim_cur = most;
        kept.room = limits.bytes;
        kept.bytes_text =
            "the " + std::to_string(limits.bytes >> 20) + " MB it may take" + in_brackets(limits.bytes_from);
    }
#endif
    return kept;
}

// Throws where a limit cannot be kept: what is read is not to be trusted.
void keep(const Kept& kept) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (::setrlimit(RLIMIT_CPU, &kept.seconds) != 0 || ::setrlimit(RLIMIT_AS, &kept.bytes) != 0)
        throw std::runtime_error(std::string("its time and memory could not be limited: ") + std::strerror(errno));
}

// Of the child: whether it was ever refused memory. assimp catches what is thrown for want of it, and goes on with what it has by then.
std::atomic<bool> out_of_memory = false;

[[noreturn]] void note_no_memory() {
    out_of_memory = true;
    throw std::bad_alloc();
}

std::string outcome(const std::function<std::string()>& work, const Kept& kept) {
    std::string bytes(1, kFailed);
    std::set_new_handler(note_no_memory);
    try {
        std::string made = work();
        bytes[0] = kDone;
        bytes += made;
    } catch (const std::bad_alloc&) { // an array of too many elements, too, which asks for none
        out_of_memory = true;
    } catch (const std::exception& error) {
        const std::string_view what = error.what();
        bytes += in_words(error.what());
        if (what.find("needs more memory than") != std::string::npos) return bytes; // it says so itself, with its place
    } catch (...) {
        bytes += unnamed_failure;
    }
    if (!out_of_memory) return bytes;
    return kLimited + ("needs more memory than " + kept.bytes_text);
}

struct Job {
    const std::function<std::string()>& work;
    const Kept& kept;
    std::string bytes{};
};

void* run_job(void* job) {
    Job& own = *static_cast<Job*>(job);
    own.bytes = outcome(own.work, own.kept);
    return nullptr;
}

// On a stack of its own size; without one where there is no memory for it.
std::string outcome(const std::function<std::string()>& work, const Kept& kept, std::size_t stack) {
    Job job{work, kept};
    pthread_attr_t size;
    pthread_t thread;
    ::pthread_attr_init(&size);
    if (stack == 0 || ::pthread_attr_setstacksize(&size, stack) != 0 ||
        ::pthread_create(&thread, &size, run_job, &job) != 0)
        return outcome(work, kept);
    ::pthread_join(thread, nullptr);
    return std::move(job.bytes);
}

[[noreturn]] void be_child(int pipe, [[maybe_unused]] pid_t parent, const std::function<std::string()>& work,
                           const Kept& kept, std::size_t stack) {
    for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU})
        ::signal(crash, SIG_DFL);
#ifdef __linux__
    // A killed parent ends nothing by itself. It may have died before this was asked for, on which the child has another parent.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
#endif
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    const std::function<std::string()> limited = [&] {
        keep(kept);
        return work();
    };
    const std::string bytes = outcome(limited, kept, stack);
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
struct Ended {
    int status = 0;
    double seconds = 0;    // of processor time
    std::size_t bytes = 0; // resident at most
};
Ended ended(pid_t child) {
    Ended end;
    rusage used{};
    while (::wait4(child, &end.status, 0, &used) < 0 && errno == EINTR) {
    }
    end.bytes = std::size_t(used.ru_maxrss) << 10;
    for (const timeval& time : {used.ru_utime, used.ru_stime})
        end.seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
    return end;
}

} // namespace

ChildResult run_forked(const std::function<std::string()>& work, const ChildLimits& limits) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error(std::string("no pipe to a child process: ") + std::strerror(errno));
    const Kept kept = kept_limits(limits);
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) {
        const int error = errno;
        ::close(ends[0]), ::close(ends[1]);
        throw std::runtime_error(std::string("no child process: ") + std::strerror(error));
    }
    if (child == 0) {
        ::close(ends[0]);
        be_child(ends[1], parent, work, kept, limits.stack);
    }
    ::close(ends[1]);
    std::string bytes;
    try {
        bytes = received(ends[0]);
    } catch (...) {       // no memory for it
        ::close(ends[0]); // on which the child ends
        (void)ended(child);
        throw;
    }
    ::close(ends[0]);
    const auto [status, seconds, most] = ended(child);
    ChildResult result;
    const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL; // also where both limits of time are one
    result.limited = (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) ||
                     (killed && seconds > double(kept.seconds.rlim_cur) - 0.5);
    if (result.limited)
        result.failure = "takes longer than " + kept.seconds_text;
    else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGBUS) // as an input does that is mapped (mapped.h)
        result.failure = "found the file cut short while it was read";
    else if (killed)
        result.failure = "was killed (signal 9), as the system does for want of memory";
    else if (WIFSIGNALED(status)) {
        // Not all code outlives the lack of memory that its limit makes.
        result.failure = "crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
        result.limited = kept.room > 0 && most > kept.room / 2;
        if (result.limited)
            result.failure += " when it had taken " + std::to_string(most >> 20) + " MB of " + kept.bytes_text;
    } else if (bytes.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        result.failure = "crashed";
    else if (bytes[0] != kDone) {
        result.failure = bytes.size() > 1 ? bytes.substr(1) : unnamed_failure;
        result.limited = bytes[0] == kLimited;
    } else
        result.bytes = bytes.substr(1);
    return result;
}

} // namespace bough
