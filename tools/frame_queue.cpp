#include "frame_queue.h"
#include "threads.h"
#include <cassert>
#include <csignal>
#include <system_error>

namespace bough {

FrameQueue::FrameQueue(FrameSink& sink, std::size_t slots) : sink_(sink), slot_(slots) {
    assert(slots >= 1);
    if (slots > 1) start();
}

// A thread begins with its creator's signal mask.
void FrameQueue::start() {
    sigset_t all, before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
        writer_ = std::thread([this] { run(); });
    } catch (const std::system_error&) { // no thread is to be had (ulimit -u, -v): push() writes, as with one slot
    } catch (...) {
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
        throw;
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

FrameQueue::~FrameQueue() {
    close();
}

void FrameQueue::write(const MotionFrame& frame) {
    sink_.write(frame);
    bytes_ = sink_.bytes();
}

void FrameQueue::run() {
    use_threads(1);
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return closed_ || written_ < pushed_; });
        if (written_ == pushed_) return;
        const MotionFrame& frame = slot_[written_ % slot_.size()];
        lock.unlock();
        std::exception_ptr error;
        try {
            write(frame);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        ++written_;
        error_ = error;
        changed_.notify_all();
        if (error) return;
    }
}

MotionFrame& FrameQueue::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return error_ || pushed_ - written_ < slot_.size(); });
    if (error_) std::rethrow_exception(error_);
    return slot_[pushed_ % slot_.size()];
}

void FrameQueue::push() {
    if (!writer_.joinable()) return write(slot_.front());
    const std::lock_guard lock(mutex_);
    ++pushed_;
    changed_.notify_all();
}

void FrameQueue::close() noexcept {
    if (!writer_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }
    writer_.join();
}

void FrameQueue::finish() {
    close();
    if (error_) std::rethrow_exception(error_);
    sink_.finish();
}

} // namespace bough
