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
constexpr double worth = 10e3, worth_waking = 40e3; // [ns] of work for a helper that is awake; for one that sleeps
// Where another program wants the core of a helper, which is then taken from it against its will, helpers are no longer looking out, and woken for much
// alone, for a while that doubles each time.
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

// A loop. Its place is the pool's for good, so that a late helper may look at it.
//   state   places left for helpers, and how many helpers are inside: one number, so that nobody enters what has been closed
//   left    blocks that nobody has begun; less than 0 where several have found none
// The rest is written by the caller while there are no places and nobody is inside, and read by those who have entered.
struct alignas(64) Loop {
    static constexpr std::uint32_t place = 1u << 16, inside_mask = place - 1;
    std::atomic<std::uint32_t> state{0};
    std::atomic<bool> taken{false};
    alignas(64) std::atomic<std::int64_t> left{0};
    alignas(64) std::size_t blocks = 0;
    parallel::Work work = nullptr;
    const void* what = nullptr;
    std::fenv_t numbers{}; // rounding and denormals of the caller
    std::mutex mutex;      // over what follows
    std::exception_ptr error;
    std::size_t failed = 0; // the block that threw it

    void fail(std::size_t block) {
        left.store(0, std::memory_order_relaxed); // blocks are begun in order: none before this one is left out
        const std::lock_guard lock(mutex);
        if (error && failed < block) return;
        error = std::current_exception();
        failed = block;
    }

    void work_on(int worker) {
        inside = true;
        for (std::int64_t n; (n = left.fetch_sub(1, std::memory_order_relaxed)) > 0;) {
            const std::size_t block = blocks - std::size_t(n);
            try {
                work(what, block, worker);
            } catch (...) {
                fail(block);
            }
        }
        inside = false;
    }

    // As a helper; false if there was no place or nothing to do.
    bool help() {
        std::uint32_t s = state.load(std::memory_order_acquire);
        do {
            if (s < place || left.load(std::memory_order_relaxed) <= 0) return false;
        } while (!state.compare_exchange_weak(s, s - place + 1, std::memory_order_acquire));
        std::fesetenv(&numbers);
        work_on(int(s / place));
        if (state.fetch_sub(1, std::memory_order_release) == 1) state.notify_one(); // closed, and the last
        return true;
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
        Taken taken;
        Time::time_point asked = Time::now();
        Time::duration pause{0}; // the last one's
        for (;;) {
            const std::uint32_t seen = calls_.load(std::memory_order_acquire);
            if (ended_.load(std::memory_order_acquire)) return;
            bool helped = false;
            for (Loop& loop : loops_) helped = loop.help() || helped;
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
        started_ = 0;
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
    std::atomic<std::uint32_t> started_{0};
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

void parallel::run(std::size_t blocks, int threads, double ns, Work work, const void* what) {
    Loop* const loop = pool.take();
    if (!loop) {
        for (std::size_t block = 0; block < blocks; ++block) work(what, block, 0);
        return;
    }
    loop->blocks = blocks;
    loop->work = work;
    loop->what = what;
    std::fegetenv(&loop->numbers);
    loop->left.store(std::int64_t(blocks), std::memory_order_relaxed);
    const auto helpers = std::uint32_t(threads - 1);
    loop->state.store(helpers * Loop::place, std::memory_order_release);
    pool.call(helpers, ns);
    loop->work_on(0);
    loop->state.fetch_and(Loop::inside_mask, std::memory_order_relaxed); // no more come
    loop->wait_for_helpers();
    const std::exception_ptr error = std::exchange(loop->error, nullptr);
    loop->taken.store(false, std::memory_order_release);
    if (error) std::rethrow_exception(error);
}

} // namespace bough
