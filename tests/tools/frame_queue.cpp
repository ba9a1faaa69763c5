// Frames between the simulation and the thread that writes them: order, bound, and where errors come out.
#include "tools/frame_queue.h"
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <pthread.h>

using namespace bough;

namespace {

// Keeps the numbers it is given, and what they were when writing ended; may be held back, and may fail at a frame.
class Recorder : public FrameSink {
public:
    void write(const MotionFrame& frame) override {
        thread = std::this_thread::get_id();
        sigset_t blocked;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        interrupt_blocked = sigismember(&blocked, SIGINT) == 1;
        inside = true;
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return !held; });
        if (frame.frame == fail_at) throw OutputError("sink", "failed at " + std::to_string(frame.frame));
        if (frame.theta.size() != 100 || frame.theta.back().x() != double(frame.frame)) whole = false;
        frames.push_back(frame.frame);
        inside = false;
    }
    void finish() override { finished = true; }
    std::uint64_t bytes() const override { return 7 * frames.size(); }
    void hold(bool on) {
        const std::lock_guard lock(mutex);
        held = on;
        changed.notify_all();
    }

    std::vector<std::int64_t> frames;
    std::int64_t fail_at = -1;
    bool whole = true, finished = false, interrupt_blocked = false;
    std::atomic<bool> inside{false};
    std::thread::id thread;

private:
    std::mutex mutex;
    std::condition_variable changed;
    bool held = false;
};

void put(FrameQueue& queue, std::int64_t number) {
    MotionFrame& frame = queue.next();
    frame.frame = number;
    frame.theta.assign(100, Vec3::Constant(double(number)));
    queue.push();
}

std::vector<std::int64_t> first(std::int64_t count) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t i = 0; i < count; ++i) numbers.push_back(i);
    return numbers;
}

} // namespace

TEST_CASE("every frame arrives once, whole and in order, for any number of slots") {
    for (const std::size_t slots : {1, 2, 3, 7}) {
        Recorder sink;
        FrameQueue queue(sink, slots);
        for (std::int64_t f = 0; f < 2000; ++f) put(queue, f);
        queue.finish();
        CHECK(queue.bytes() == 7 * 2000);
        CHECK(sink.frames == first(2000));
        CHECK(sink.whole);
        CHECK(sink.finished);
        CHECK((sink.thread == std::this_thread::get_id()) == (slots == 1));
        CHECK(sink.interrupt_blocked == (slots > 1));
    }
}

TEST_CASE("no frames, and a queue that is not finished") {
    Recorder none;
    FrameQueue(none, 2).finish();
    CHECK(none.frames.empty());
    CHECK(none.finished);
    Recorder left;
    {
        FrameQueue queue(left, 2);
        for (std::int64_t f = 0; f < 10; ++f) put(queue, f);
    }
    CHECK(left.frames == first(10));
    CHECK(!left.finished);
}

TEST_CASE("the simulation waits where all slots are full") {
    for (const std::size_t slots : {2, 3}) {
        Recorder sink;
        sink.hold(true);
        FrameQueue queue(sink, slots);
        std::atomic<std::int64_t> pushed{0};
        std::thread simulation([&] {
            for (std::int64_t f = 0; f < 20; ++f) {
                put(queue, f);
                ++pushed;
            }
        });
        while (!sink.inside || pushed < std::int64_t(slots)) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(50)); // in which it would go on, could it
        CHECK(pushed == std::int64_t(slots));
        sink.hold(false);
        simulation.join();
        queue.finish();
        CHECK(sink.frames == first(20));
    }
}

TEST_CASE("the simulation goes on while a frame is written") {
    Recorder sink;
    sink.hold(true);
    FrameQueue queue(sink, 2);
    put(queue, 0);
    put(queue, 1); // would never return, were frame 0 written first
    sink.hold(false);
    queue.finish();
    CHECK(sink.frames == first(2));
}

TEST_CASE("what the sink throws reaches the simulation, and nothing is written after it") {
    for (const std::size_t slots : {1, 2, 3}) {
        Recorder sink;
        sink.fail_at = 5;
        FrameQueue queue(sink, slots);
        std::int64_t f = 0;
        const auto run = [&] {
            for (; f < 1000; ++f) put(queue, f);
        };
        CHECK_THROWS_WITH(run(), Catch::Contains("failed at 5"));
        CHECK(f <= 5 + std::int64_t(slots));
        CHECK(sink.frames == first(5));
    }
    for (const std::size_t slots : {2, 3}) { // the last frame fails: only finish() can say so
        Recorder sink;
        sink.fail_at = 1;
        FrameQueue queue(sink, slots);
        put(queue, 0);
        put(queue, 1);
        CHECK_THROWS_AS(queue.finish(), OutputError);
        CHECK(!sink.finished);
        CHECK(sink.frames == first(1));
    }
}
