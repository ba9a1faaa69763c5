// frame_queue.h: frames on their way from the simulation to the sink that writes them, so that a step is taken while the
// frames before it are written by a thread of their own.
//
// A frame is filled in one of a fixed number of slots, which are used in turn: nothing is copied, and memory is bounded
// by the slots. With two, one is filled while the other is written; with one there is nothing to overlap and no thread:
// push() writes. The sink sees every frame, once, in order, from one thread at a time, so that its bytes do not depend
// on the slots. What it throws ends the writing (frames after it are dropped) and is thrown by next() or finish().
#pragma once
#include "frame_sink.h"
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace bough {

class FrameQueue {
public:
    // Keeps a reference to the sink. slots >= 1; a thread is started for 2 or more, in which all signals are blocked
    // (they are the caller's) and loops have one thread. Where the system has none to give, push() writes.
    FrameQueue(FrameSink&, std::size_t slots);
    FrameQueue(const FrameQueue&) = delete;
    FrameQueue& operator=(const FrameQueue&) = delete;
    // Frames pushed are still written, as far as they can be; an error is lost, and the sink is not finished.
    ~FrameQueue();

    MotionFrame& next(); // a frame to fill, holding what an earlier one left there; waits until a slot is free
    void push();         // hands on the frame that next() gave
    void finish();       // waits for all frames, then finishes the sink; call once
    std::uint64_t bytes() const { return bytes_; } // that the sink has made so far of whole frames

private:
    void start();
    void write(const MotionFrame&);
    void run();
    void close() noexcept;

    FrameSink& sink_;
    std::vector<MotionFrame> slot_;
    std::mutex mutex_; // over all below but writer_
    std::condition_variable changed_;
    std::size_t pushed_ = 0, written_ = 0; // frames so far
    bool closed_ = false;                  // no more will be pushed
    std::exception_ptr error_;
    std::atomic<std::uint64_t> bytes_ = 0;
    std::thread writer_;
};

} // namespace bough
