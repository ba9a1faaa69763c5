#include "parallel.h"
#include <array>
#include <atomic>
#include <cassert>
#include <cfenv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <thread>
#include <utility>
#include <vector>

namespace bough {
namespace {

using Time = std::chrono::steady_clock;

// How long a thread looks out before it sleeps: longer than what stands between the loops of a step, over which helpers stay awake (a sleeper takes
// some 5 us of its caller to wake, and some 50 to come), and short beside the slice of time that another program waits for.
constexpr std::chrono::microseconds patience(50);
constexpr double worth = 10e3, worth_waking = 100e3; // [ns] of work for a helper that is awake; for one that sleeps
// Where another program wants the core of a helper, which is then taken from it against its will, helpers are no longer looking out, and woken for
// much alone, for a while that doubles each time.
constexpr double worth_crowded = 400e3; // [ns]
constexpr std::chrono::milliseconds ask_every(1), shortest_while(4), longest_while(64);

thread_local int limit = 0;       // 0: the machine's
thread_local bool inside = false; // a block

// Until `ready`, or for as long as patience lasts; whether it was.
template <class F> bool look_out(const F& ready) {
    const Time::time_point start = Time::now();
    do {
        for (int k = 0; k < 8; ++k) {
            if (ready()) return true;
#if defined(__x86_64__) || defined(__i386__)
            __builtin_ia32_pause();
#elif defined(__aarch64__)
            __asm__ __volatile__("isb");
#endif
        }
    } while (Time::now() - start < patience);
    return false;
}

// Blocks that nobody has begun: [begin, end), in one number.
struct alignas(64) Stretch {
    std::atomic<std::uint64_t> left{0}; // end << 32 | begin

    void set(std::size_t begin, std::size_t end) {
        left.store(std::uint64_t(end) << 32 | begin, std::memory_order_relaxed);
    }
    bool is_empty() const { return is_empty(left.load(std::memory_order_relaxed)); }
    std::optional<std::size_t> take(Order from) {
        std::uint64_t now = left.load(std::memory_order_relaxed), then;
        do {
            if (is_empty(now)) return std::nullopt;
            then = from == Order::forward ? now + 1 : now - (std::uint64_t(1) << 32);
        } while (!left.compare_exchange_weak(now, then, std::memory_order_relaxed));
        return from == Order::forward ? begin_of(now) : end_of(then);
    }

private:
    static std::size_t begin_of(std::uint64_t both) { return std::size_t(both & 0xFFFFFFFFu); }
    static std::size_t end_of(std::uint64_t both) { return std::size_t(both >> 32); }
    static bool is_empty(std::uint64_t both) { return begin_of(both) >= end_of(both); }
};

constexpr std::size_t most_stretches = 32, most_blocks = 0xFFFFFFFFu, none_failed = SIZE_MAX;

// A loop. Its place is the pool's for good, so that a late helper may look at it.
//   state   places left for helpers, and how many helpers are inside: one number, so that nobody enters what has been closed
//   failed  the first block that threw
// The rest is written by the caller while there are no places and nobody is inside, and read by those who have entered.
struct alignas(64) Loop {
    static constexpr std::uint32_t place = 1u << 16, inside_mask = place - 1;
    std::atomic<std::uint32_t> state{0};
    std::atomic<bool> taken{false};
    std::array<Stretch, most_stretches> stretch;
    alignas(64) std::size_t stretches = 1;
    Order order = Order::forward;
    parallel::Work work = nullptr;
    const void* what = nullptr;
    std::fenv_t numbers{}; // rounding and denormals of the caller
    std::atomic<std::size_t> failed{none_failed};
    std::mutex mutex; // over error
    std::exception_ptr error;

    void fail(std::size_t block) {
        const std::lock_guard lock(mutex);
        if (failed < block) return;
        error = std::current_exception();
        failed = block;
    }

    // The next block of the stretch of this thread, else from the far end of another. Once one has failed, those before it, from the first on.
    std::optional<std::size_t> next(std::size_t own) {
        if (failed.load(std::memory_order_relaxed) != none_failed) {
            for (std::size_t s = 0; s < stretches; ++s)
                if (const auto block = stretch[s].take(Order::forward))
                    return *block < failed.load(std::memory_order_relaxed) ? block : std::nullopt;
            return std::nullopt;
        }
        if (const auto block = stretch[own].take(order)) return block;
        const Order far_end = order == Order::forward ? Order::backward : Order::forward;
        for (std::size_t k = 1; k < stretches; ++k)
            if (const auto block = stretch[(own + k) % stretches].take(far_end)) return block;
        return std::nullopt;
    }

    // thread: the caller is 0, helpers have numbers from 1 on for good.
    void work_on(int worker, std::size_t thread) {
        inside = true;
        const std::size_t own = thread == 0 || stretches == 1 ? 0 : 1 + (thread - 1) % (stretches - 1);
        while (const auto block = next(own)) {
            try {
                work(what, *block, worker);
            } catch (...) {
                fail(*block);
            }
        }
        inside = false;
    }

    bool is_done() const {
        return std::all_of(stretch.begin(), stretch.begin() + std::ptrdiff_t(stretches),
                           [](const Stretch& s) { return s.is_empty(); });
    }

    // As a helper; false if there was no place or nothing to do.
    bool help(std::size_t thread) {
        std::uint32_t s = state.load(std::memory_order_acquire);
        do {
            if (s < place) return false;
        } while (!state.compare_exchange_weak(s, s - place + 1, std::memory_order_acquire));
        const bool helps = !is_done();
        if (helps) {
            std::fesetenv(&numbers);
            work_on(int(s / place), thread);
        }
        if (state.fetch_sub(1, std::memory_order_release) == 1) state.notify_one(); // closed, and the last
        return helps;
    }

    void wait_for_helpers() {
        for (std::uint32_t s; (s = state.load(std::memory_order_acquire)) != 0;)
            if (!look_out([this] { return state.load(std::memory_order_acquire) == 0; }))
                state.wait(s, std::memory_order_acquire);
    }
};

// Whether a thread's core was taken from it; of the thread that asks.
class Taken {
public:
    bool since_last() {
#ifdef RUSAGE_THREAD
        rusage used;
        ::getrusage(RUSAGE_THREAD, &used);
        return std::exchange(times_, used.ru_nivcsw) != used.ru_nivcsw;
#else
        return false;
#endif
    }

private:
    long times_ = 0;
};

void* serve(void*);

class Pool {
public:
    // A loop that nobody else has, or null.
    Loop* take() {
        for (Loop& loop : loops_)
            if (!loop.taken.load(std::memory_order_relaxed) && !loop.taken.exchange(true, std::memory_order_acquire))
                return &loop;
        return nullptr;
    }

    // Calls those who are awake, for `ns` of work, and wakes so many of the others as that pays for, who are started where there are fewer.
    void call(std::uint32_t helpers, double ns) {
        const double each = ns >= 2 * worth_waking && crowded() ? worth_crowded : worth_waking;
        const auto wakes = std::uint32_t(std::clamp(ns / each - 1, 0.0, double(helpers)));
        if (started_.load(std::memory_order_acquire) < wakes) start(wakes);
        calls_.fetch_add(1);
        if (wakes >= started_.load(std::memory_order_relaxed)) return calls_.notify_all();
        for (std::uint32_t k = 0; k < wakes; ++k) calls_.notify_one();
    }

    void serve() {
        const std::size_t number = 1 + served_.fetch_add(1, std::memory_order_relaxed);
        Taken taken;
        Time::time_point asked = Time::now();
        Time::duration pause{0}; // the last one's
        for (;;) {
            const std::uint32_t seen = calls_.load(std::memory_order_acquire);
            if (ended_.load(std::memory_order_acquire)) return;
            bool helped = false;
            for (Loop& loop : loops_) helped = loop.help(number) || helped;
            if (const Time::time_point now = Time::now(); now - asked >= ask_every) {
                asked = now;
                if (taken.since_last()) {
                    pause = std::clamp<Time::duration>(2 * pause, shortest_while, longest_while);
                    crowded_until_.store((now + pause).time_since_epoch().count(), std::memory_order_relaxed);
                } else if (!crowded()) {
                    pause /= 2;
                }
            }
            if (helped) continue;
            if (!crowded() && look_out([&] { return calls_.load(std::memory_order_relaxed) != seen; })) continue;
            calls_.wait(seen, std::memory_order_relaxed);
        }
    }

    void end() {
        const std::lock_guard lock(mutex_);
        ended_.store(true, std::memory_order_release);
        calls_.fetch_add(1);
        calls_.notify_all();
        for (const pthread_t helper : helpers_)
            if (!::pthread_equal(helper, ::pthread_self())) ::pthread_join(helper, nullptr);
        helpers_ = {};
    }

    void before_fork() { mutex_.lock(); }
    void after_fork() { mutex_.unlock(); }
    // The thread that forked is the only one: no helper is there, and no other caller.
    void in_child() {
        helpers_.clear();
        started_ = served_ = 0;
        for (Loop& loop : loops_) {
            loop.state = 0;
            loop.taken = false;
        }
        mutex_.unlock();
    }

private:
    bool crowded() const {
        return Time::now().time_since_epoch().count() < crowded_until_.load(std::memory_order_relaxed);
    }

    // A thread begins with its creator's signal mask: signals are the program's, not a helper's.
    void start(std::uint32_t helpers) {
        const std::lock_guard lock(mutex_);
        if (ended_.load(std::memory_order_relaxed)) return;
        try {
            helpers_.reserve(helpers);
        } catch (const std::bad_alloc&) {
            return;
        }
        sigset_t all, before;
        sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before);
        for (pthread_t helper; helpers_.size() < helpers && !::pthread_create(&helper, nullptr, bough::serve, nullptr);)
            helpers_.push_back(helper);
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
        started_.store(std::uint32_t(helpers_.size()), std::memory_order_release);
    }

    std::array<Loop, 16> loops_; // at a time: those who find none free work alone
    alignas(64) std::atomic<std::uint32_t> calls_{0};
    std::atomic<Time::rep> crowded_until_{0};
    std::atomic<std::uint32_t> started_{0}, served_{0};
    std::atomic<bool> ended_{false};
    std::mutex mutex_; // over helpers_
    std::vector<pthread_t> helpers_;
};

// A pool that is never destroyed: at the program's end other threads may still be in a loop.
union Kept {
    Kept() : pool() {}
    ~Kept() {}
    Pool pool;
} kept;
Pool& pool = kept.pool;

void* serve(void*) {
    pool.serve();
    return nullptr;
}

// From the library's loading to its unloading, or the program's end.
struct Life {
    Life() {
        ::pthread_atfork([] { pool.before_fork(); }, [] { pool.after_fork(); }, [] { pool.in_child(); });
    }
    ~Life() { pool.end(); }
} life;

} // namespace

int machine_threads() {
    cpu_set_t cores;
    if (::sched_getaffinity(0, sizeof cores, &cores) == 0) return std::max(CPU_COUNT(&cores), 1);
    return std::max(int(std::thread::hardware_concurrency()), 1);
}

int thread_limit() {
    if (limit == 0) limit = machine_threads();
    return limit;
}
void set_thread_limit(int threads) {
    assert(threads >= 0);
    limit = std::min(threads, most_threads);
}

int threads_for(std::size_t blocks, double ns) {
    if (blocks < 2 || !(ns >= 2 * worth) || inside) return 1;
    return int(std::min({double(thread_limit()), double(blocks), ns / worth}));
}

std::size_t parallel::pieces(std::size_t count, double ns) {
    const double all = double(count) * ns;
    return all < 2 * worth ? 1 : std::size_t(std::min(double(count), all / (worth / 2)));
}

void parallel::run(std::size_t blocks, int threads, double ns, Order order, Work work, const void* what) {
    Loop* const loop = blocks <= most_blocks ? pool.take() : nullptr;
    if (!loop) {
        for (std::size_t k = 0; k < blocks; ++k) work(what, order == Order::forward ? k : blocks - 1 - k, 0);
        return;
    }
    const std::size_t stretches = std::min(std::size_t(threads), most_stretches);
    for (std::size_t s = 0; s < stretches; ++s)
        loop->stretch[s].set(blocks * s / stretches, blocks * (s + 1) / stretches);
    loop->stretches = stretches;
    loop->order = order;
    loop->failed.store(none_failed, std::memory_order_relaxed);
    loop->work = work;
    loop->what = what;
    std::fegetenv(&loop->numbers);
    const auto helpers = std::uint32_t(threads - 1);
    loop->state.store(helpers * Loop::place, std::memory_order_release);
    pool.call(helpers, ns);
    loop->work_on(0, 0);
    loop->state.fetch_and(Loop::inside_mask, std::memory_order_relaxed); // no more come
    loop->wait_for_helpers();
    const std::exception_ptr error = std::exchange(loop->error, nullptr);
    loop->taken.store(false, std::memory_order_release);
    if (error) std::rethrow_exception(error);
}

} // namespace bough
