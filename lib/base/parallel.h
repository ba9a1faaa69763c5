// parallel.h: shares the loops of a step out among threads that cost nothing while other programs want the machine.
//
//   parallel_blocks(blocks, ns, [&](std::size_t block, int worker) { ... });    // a block at a time, in any order, on any thread
//   parallel_for(bodies, ns, [&](std::size_t body) { ... });                    // many small things, in blocks as large as pay
//
// Threads. The caller works too. Helpers, which all callers share, take blocks as long as there are any. The caller waits only for helpers inside a
// block, not for those that have not come: a helper whose core is busy is not missed. Each begins with a stretch of the blocks of its own, the same
// in every loop of as many blocks, and goes on at the far ends of the others': what a core has in its cache it finds there in the next loop. Between
// loops a helper looks out for the next one for `patience`, then sleeps until it is called. The caller does the same while it waits. (OpenMP's
// barrier waits for every thread, and spins for milliseconds in just the time that the late one needs: with two programs on two cores this takes ten
// times the time of one thread.)
// How many. A loop takes as many threads as the work pays for, and at most thread_limit(). `ns` is about what one block or body takes one thread. A
// helper that is awake pays from 10 us of work on, one that must be woken from 100 us on, which is dear on virtual machines; the caller does less
// than that alone.
// Cost: less than a microsecond where nobody has to be woken, some microseconds where somebody has. Allocates only when helpers are started. What is
// done must not depend on who does it: blocks of one loop write to different places. `worker`, 0 <= worker < threads_for(...), belongs to one thread
// at a time, for memory to work in. The loop sees what was written before it, and the code after the loop sees what the loop wrote.
// Errors. What a block throws reaches the caller when the loop has ended: that of the first block which threw (of a backward loop any). From then on
// only blocks before it are begun. Where no thread can be started, the caller works alone.
// A loop within a block runs on the block's thread. Several threads may run loops at once. A block runs with its caller's rounding, and treatment of
// denormals. After a fork() the child starts helpers of its own (not from a block). When the library is unloaded, or the program ends, helpers end
// with the block they are at.
#pragma once
#include <algorithm>
#include <cstddef>

namespace bough {

constexpr int most_threads = 4096;
int machine_threads(); // cores that this process may use

// Limits the loops of this thread to so many threads, the thread itself among them. Every thread begins with machine_threads().
int thread_limit();
void set_thread_limit(int threads); // 0: machine_threads()

class ThreadLimit { // for as long as it lives
public:
    explicit ThreadLimit(int threads) : before_(thread_limit()) { set_thread_limit(threads); }
    ~ThreadLimit() { set_thread_limit(before_); }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    int before_;
};

// Returns on how many threads a loop of `blocks` runs that take one thread `ns` in all.
int threads_for(std::size_t blocks, double ns);

// From which end threads go through their blocks: backward after a forward loop, whose last blocks are in the caches still.
enum class Order { forward, backward };

namespace parallel {
using Work = void (*)(const void* what, std::size_t block, int worker);
void run(std::size_t blocks, int threads, double ns, Order, Work, const void* what);
std::size_t pieces(std::size_t count, double ns); // of a loop over `count` of `ns` each
} // namespace parallel

template <class F> void parallel_blocks(std::size_t blocks, double ns, const F& f, Order order = Order::forward) {
    const int threads = threads_for(blocks, ns * double(blocks));
    if (threads > 1)
        return parallel::run(
            blocks, threads, ns * double(blocks), order,
            [](const void* what, std::size_t block, int worker) { (*static_cast<const F*>(what))(block, worker); }, &f);
    for (std::size_t k = 0; k < blocks; ++k) f(order == Order::forward ? k : blocks - 1 - k, 0);
}

template <class F> void parallel_for(std::size_t count, double ns, const F& f) {
    const std::size_t pieces = parallel::pieces(count, ns);
    parallel_blocks(pieces, ns * double(count) / double(pieces), [&](std::size_t k, int) {
        const std::size_t end = count * (k + 1) / pieces;
        for (std::size_t i = count * k / pieces; i < end; ++i) f(i);
    });
}

} // namespace bough
