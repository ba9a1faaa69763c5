// What a child process may take: its limits, those of the process itself, and what is said where they bite.
#include "formats/forked.h"
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <memory>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace bough;

namespace {

// What only a build without sanitizers uses is marked.
constexpr std::size_t megabyte = std::size_t(1) << 20;

[[maybe_unused]] std::size_t address_space() {
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    file >> pages;
    return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

// Work that takes so much memory.
[[maybe_unused]] std::function<std::string()> taking(std::size_t megabytes) {
    return [megabytes] {
        const std::unique_ptr<char[]> block(new char[megabytes * megabyte]);
        for (std::size_t at = 0; at < megabytes; ++at) block[at * megabyte] = 1;
        return "took " + std::to_string(megabytes);
    };
}

[[maybe_unused]] std::string soft_limit() {
    rlimit limit{};
    ::getrlimit(RLIMIT_AS, &limit);
    return std::to_string(limit.rlim_cur);
}

[[maybe_unused]] ChildLimits of_memory(std::size_t megabytes) {
    ChildLimits limits;
    limits.bytes = megabytes * megabyte;
    limits.stack = 16 * megabyte;
    limits.bytes_from = "as the test says";
    return limits;
}

} // namespace

#ifdef __linux__
TEST_CASE("a child ends with a process that is killed") {
    int pipe[2];
    REQUIRE(::pipe(pipe) == 0);
    const pid_t parent = ::fork();
    REQUIRE(parent >= 0);
    if (parent == 0) {
        run_forked([&]() -> std::string {
            const pid_t self = ::getpid();
            (void)!::write(pipe[1], &self, sizeof self);
            for (;;) ::pause();
        });
        ::_exit(0);
    }
    ::close(pipe[1]);
    pid_t child = 0;
    REQUIRE(::read(pipe[0], &child, sizeof child) == sizeof child);
    ::kill(parent, SIGKILL);
    REQUIRE(::waitpid(parent, nullptr, 0) == parent);
    // The pipe ends with the last process that has it. A child that lives on keeps it for ever.
    pollfd ended{pipe[0], POLLIN, 0};
    const bool gone = ::poll(&ended, 1, 60000) == 1;
    if (!gone) ::kill(child, SIGKILL);
    CHECK(gone);
    ::close(pipe[0]);
}
#endif

TEST_CASE("work in a child hands back what it returns, throws and dies of") {
    CHECK(run_forked([] { return std::string("a\0b", 3); }).bytes == std::string("a\0b", 3));
    CHECK(run_forked([] { return std::string(3'000'000, 'x'); }).bytes.size() == 3'000'000);
    CHECK(run_forked([]() -> std::string { throw 1; }).failure == "failed");
    CHECK(run_forked([]() -> std::string { throw std::runtime_error("why"); }).failure == "why");
    CHECK(run_forked([]() -> std::string { ::raise(SIGSEGV), ::_exit(0); }).failure == "crashed (signal 11)");
    CHECK(run_forked([]() -> std::string { ::raise(SIGKILL), ::_exit(0); }).failure ==
          "was killed (signal 9), as the system does for want of memory");
}

TEST_CASE("processor time is limited, by the lower of two limits, which is named") {
    const auto forever = []() -> std::string {
        for (std::uint64_t k = 0;; ++k)
            if (::getppid() == 1) return std::to_string(k); // nobody waits any more
    };
    ChildLimits limits;
    limits.seconds = 1;
    limits.seconds_from = "as the test says";
    const ChildResult late = run_forked(forever, limits);
    CHECK(late.failure == "takes longer than 1 s of processor time (as the test says)");
    CHECK(late.limited);
    // One of the process itself, which it may not raise, is in a process of its own.
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit own{1, 1};
        ::setrlimit(RLIMIT_CPU, &own);
        limits.seconds = 1000;
        const std::string failure = run_forked(forever, limits).failure;
        ::_exit(failure == "takes longer than 1 s of processor time (ulimit -t)" ? 0 : 1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
}

#ifndef BOUGH_SANITIZED // a sanitizer's own memory is no matter of limits
TEST_CASE("memory is limited, and what limits it is named") {
    CHECK(run_forked(taking(100), of_memory(200)).bytes == "took 100");
    const ChildResult large = run_forked(taking(300), of_memory(200));
    CHECK(large.failure == "needs more memory than the 200 MB it may take (as the test says)");
    CHECK(large.limited);
    CHECK(!run_forked([]() -> std::string { throw std::runtime_error("why"); }, of_memory(200)).limited);
    // Code that catches what is thrown and goes on with less, as assimp does.
    const ChildResult less = run_forked(
        []() -> std::string {
            try {
                return taking(300)();
            } catch (const std::exception&) {
                return "a smaller tree";
            }
        },
        of_memory(200));
    CHECK(less.failure == "needs more memory than the 200 MB it may take (as the test says)");
    CHECK(less.limited);
    CHECK(less.bytes.empty());
    // Code that does not outlive the lack of it.
    const auto crashes = []() noexcept { return taking(400)(); };
    const auto fills = [&] {
        const std::unique_ptr<char[]> block(new char[200 * megabyte]);
        for (std::size_t at = 0; at < 200 * megabyte; at += 4096) block[at] = 1;
        return crashes();
    };
    CHECK_THAT(run_forked(fills, of_memory(350)).failure,
               Catch::Matches("crashed \\(signal 6\\) when it had taken 2[0-9]+ MB of the 350 MB it may take .*"));
}

TEST_CASE("a limit of the process itself that is lower stays, soft or hard") {
    for (const bool hard : {false, true}) {
        CAPTURE(hard);
        const pid_t child = ::fork(); // a hard one is for good
        if (child == 0) {
            rlimit own{};
            ::getrlimit(RLIMIT_AS, &own);
            own.rlim_cur = address_space() + 200 * megabyte;
            if (hard) own.rlim_max = own.rlim_cur;
            if (::setrlimit(RLIMIT_AS, &own) != 0) ::_exit(2);
            if (run_forked(soft_limit, of_memory(2000)).bytes != std::to_string(own.rlim_cur)) ::_exit(3);
            if (run_forked(taking(100), of_memory(2000)).bytes != "took 100") ::_exit(4);
            if (run_forked(taking(300), of_memory(2000)).failure != "needs more memory than ulimit -v leaves")
                ::_exit(5);
            if (run_forked(taking(100), of_memory(50)).failure !=
                "needs more memory than the 50 MB it may take (as the test says)")
                ::_exit(6);
            ::_exit(0);
        }
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
    }
}
#endif
