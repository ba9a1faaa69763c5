// parallel.h: every block once and no two at a time under one worker's number; what blocks throw; nested loops, several callers, a caller's numbers;
// fork(), the end of the program and the library's unloading. The thread sanitizer's program, as threads.cpp, has the main function.
#include "lib/base/parallel.h"
#include "lib/base/sanitizers.h"
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cfenv>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

using namespace bough;

namespace {

constexpr double much = 1e6; // [ns] of a block: worth a thread

constexpr bool forks = !BOUGH_THREAD_SANITIZER; // a forked child may start no threads under it

void wait_a_moment() {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

// How many threads took part in a loop of blocks that last.
int threads_taking_part(std::size_t blocks) {
    std::vector<int> taken(std::size_t(most_threads), 0);
    parallel_blocks(blocks, much, [&](std::size_t, int worker) {
        taken[std::size_t(worker)] = 1;
        wait_a_moment();
    });
    return int(std::count(taken.begin(), taken.end(), 1));
}

// A loop whose sum is known; false if it came out wrong.
bool loop_is_right(std::size_t blocks) {
    std::vector<std::size_t> value(blocks, 0);
    parallel_blocks(blocks, much, [&](std::size_t b, int) { value[b] += b + 1; });
    for (std::size_t b = 0; b < blocks; ++b)
        if (value[b] != b + 1) return false;
    return true;
}

// What a child that does `work` exits with; -1 if it was killed, as it is by its alarm when it hangs.
template <class F> int exit_of_child(const F& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20);
        work();
        ::_exit(99);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::size_t threads_of_process() {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return std::size_t(std::distance(begin(tasks), end(tasks)));
}

} // namespace

TEST_CASE("every block is done once, and what it wrote is there after the loop") {
    for (const int threads : {1, 2, 3, 8, 40}) {
        const ThreadLimit limit(threads);
        for (const std::size_t blocks : {0, 1, 2, 3, 7, 100})
            for (int k = 0; k < 200; ++k) REQUIRE(loop_is_right(blocks));
        for (const std::size_t count : {0, 1, 5, 1000, 30011}) {
            std::vector<int> done(count, 0);
            parallel_for(count, 1000, [&](std::size_t i) { ++done[i]; });
            CHECK(std::count(done.begin(), done.end(), 1) == std::ptrdiff_t(count));
        }
    }
}

TEST_CASE("a worker's number is one thread's at a time, below the number of threads") {
    for (const int threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        REQUIRE(threads_for(50, 50 * much) == threads);
        std::vector<std::size_t> own(std::size_t(threads), 0); // not atomic: the thread sanitizer looks at it
        for (int k = 0; k < 300; ++k)
            parallel_blocks(50, much, [&](std::size_t, int worker) { ++own.at(std::size_t(worker)); });
        std::size_t sum = 0;
        for (const std::size_t n : own) sum += n;
        CHECK(sum == 300 * 50);
    }
}

TEST_CASE("helpers take part, as many as the limit lets; little work stays with the caller") {
    {
        const ThreadLimit limit(3);
        int most = 0;
        for (int k = 0; k < 20 && most < 3; ++k) most = std::max(most, threads_taking_part(60));
        CHECK(most == 3);
        CHECK(threads_for(60, 1000) == 1);
        CHECK(threads_for(1, 1e9) == 1);
        CHECK(threads_for(2, 1e9) == 2);
        const ThreadLimit fewer(2); // between two loops
        CHECK(threads_taking_part(60) <= 2);
        const ThreadLimit alone(1);
        CHECK(threads_taking_part(10) == 1);
    }
    const ThreadLimit all(0);
    CHECK(thread_limit() == machine_threads());
}

TEST_CASE("a thread begins with the same blocks in every loop, and goes on at the far end of the others'") {
    const ThreadLimit limit(2);
    for (const Order order : {Order::forward, Order::backward}) {
        int helped = 0;
        for (int k = 0; k < 40; ++k) {
            std::vector<int> worker_of(60, -1);
            parallel_blocks(
                60, much,
                [&](std::size_t block, int worker) {
                    worker_of[block] = worker;
                    wait_a_moment();
                },
                order);
            const std::ptrdiff_t helpers = std::count(worker_of.begin(), worker_of.end(), 1);
            REQUIRE(helpers + std::count(worker_of.begin(), worker_of.end(), 0) == 60);
            if (helpers == 0) continue; // it came too late
            ++helped;
            // The caller, who has the other half, takes this block last.
            REQUIRE(worker_of[order == Order::forward ? 30 : 59] == 1);
        }
        CHECK(helped > 0);
    }
}

TEST_CASE("a loop may go backward") {
    const ThreadLimit alone(1);
    std::vector<std::size_t> done;
    parallel_blocks(
        5, much, [&](std::size_t block, int) { done.push_back(block); }, Order::backward);
    CHECK(done == std::vector<std::size_t>{4, 3, 2, 1, 0});
    const ThreadLimit limit(4);
    for (int k = 0; k < 100; ++k) {
        std::vector<int> times(37, 0);
        parallel_blocks(
            37, much, [&](std::size_t block, int) { ++times[block]; }, Order::backward);
        REQUIRE(std::count(times.begin(), times.end(), 1) == 37);
    }
}

TEST_CASE("what a block throws reaches the caller, of several blocks the first's") {
    const ThreadLimit limit(4);
    for (int k = 0; k < 200; ++k) {
        std::string what;
        std::atomic<int> begun{0};
        try {
            parallel_blocks(1000, much, [&](std::size_t block, int) {
                ++begun;
                if (block >= 3) throw std::runtime_error(std::to_string(block));
            });
        } catch (const std::runtime_error& error) {
            what = error.what();
        }
        REQUIRE(what == "3");
        REQUIRE(begun < 100);
        REQUIRE(loop_is_right(20));
    }
}

TEST_CASE("a loop within a block runs on the block's thread") {
    const ThreadLimit limit(4);
    std::vector<int> right(40, 0);
    parallel_blocks(right.size(), much, [&](std::size_t block, int) {
        const std::thread::id own = std::this_thread::get_id();
        bool same = true;
        parallel_blocks(10, much, [&](std::size_t, int worker) {
            same = same && worker == 0 && std::this_thread::get_id() == own;
        });
        right[block] = same;
    });
    CHECK(std::count(right.begin(), right.end(), 1) == 40);
    CHECK(threads_for(2, 1e9) == 2);
}

TEST_CASE("several callers at once, more than there is room for, each with its own limit") {
    std::atomic<int> wrong{0};
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 24; ++caller)
        callers.emplace_back([&wrong, caller] {
            set_thread_limit(1 + caller % 4);
            for (int k = 0; k < 200; ++k) wrong += !loop_is_right(1 + std::size_t(k) % 9);
            wrong += thread_limit() != 1 + caller % 4;
        });
    for (std::thread& caller : callers) caller.join();
    CHECK(wrong == 0);
}

TEST_CASE("a block runs with its caller's rounding, and its denormals") {
    const ThreadLimit limit(3);
    const auto thirds = [] {
        std::vector<double> third(60);
        parallel_blocks(third.size(), much, [&](std::size_t block, int) {
            volatile double one = 1, three = 3;
            third[block] = one / three;
            wait_a_moment();
        });
        return third;
    };
    const std::vector<double> nearest = thirds();
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    const std::vector<double> up = thirds();
    std::fesetround(FE_TONEAREST);
    const std::vector<double> again = thirds();
    CHECK(std::count(nearest.begin(), nearest.end(), nearest[0]) == 60);
    CHECK(std::count(up.begin(), up.end(), up[0]) == 60);
    CHECK(up[0] > nearest[0]);
    CHECK(again == nearest);
#ifdef __SSE2__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040); // denormals are zero, in and out
    std::vector<unsigned> seen(60);
    parallel_blocks(seen.size(), much, [&](std::size_t block, int) {
        seen[block] = _mm_getcsr() & 0x8040;
        wait_a_moment();
    });
    _mm_setcsr(before);
    CHECK(std::count(seen.begin(), seen.end(), 0x8040u) == 60);
#endif
}

TEST_CASE("a child that was forked runs loops on helpers of its own") {
    if (!forks) return;
    const ThreadLimit limit(3);
    REQUIRE(loop_is_right(50)); // there are helpers
    const auto work = [] {
        int most = 0;
        for (int k = 0; k < 20 && most < 3; ++k) most = std::max(most, threads_taking_part(60));
        ::_exit(loop_is_right(50) && most == 3 ? 0 : 1);
    };
    CHECK(exit_of_child(work) == 0);
    CHECK(loop_is_right(50));
    // And forked while another thread is in the midst of one.
    std::atomic<bool> enough{false};
    std::thread other([&] {
        set_thread_limit(3);
        while (!enough) (void)threads_taking_part(20);
    });
    for (int k = 0; k < 10; ++k) CHECK(exit_of_child(work) == 0);
    enough = true;
    other.join();
}

TEST_CASE("a program ends while a loop runs") {
    if (!forks) return;
    CHECK(exit_of_child([] {
              std::thread([] {
                  set_thread_limit(3);
                  for (;;) (void)threads_taking_part(20);
              }).detach();
              std::this_thread::sleep_for(std::chrono::milliseconds(20));
              std::exit(7);
          }) == 7);
}

TEST_CASE("a library that is unloaded takes its helpers with it") {
    const std::size_t before = threads_of_process();
    for (int k = 0; k < 5; ++k) {
        void* const library = ::dlopen(BOUGH_PARALLEL_MODULE, RTLD_NOW | RTLD_LOCAL);
        INFO((library ? "" : ::dlerror()));
        REQUIRE(library != nullptr);
        const auto run = reinterpret_cast<int (*)(int)>(::dlsym(library, "run_loop"));
        REQUIRE(run != nullptr);
        CHECK(run(4) == 60);
        CHECK(threads_of_process() > before);
        REQUIRE(::dlclose(library) == 0);
        REQUIRE(::dlopen(BOUGH_PARALLEL_MODULE, RTLD_NOW | RTLD_NOLOAD) == nullptr); // it is gone
        CHECK(threads_of_process() == before);
    }
    if (forks) CHECK(exit_of_child([] { ::_exit(loop_is_right(5) ? 0 : 1); }) == 0); // nor is it called by fork()
}
