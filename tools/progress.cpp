#include "progress.h"
#include "formatted.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <unistd.h>

namespace bough {
namespace {

std::atomic<bool> bar_on_screen{false};
static_assert(std::atomic<bool>::is_always_lock_free); // clear_progress is called in handlers

std::int64_t now_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

} // namespace

Progress::Progress(const CommonOptions& common, std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total), wanted_(!common.quiet && ::isatty(STDERR_FILENO) == 1),
      last_ms_(now_ms() + 400) {}

Progress::~Progress() {
    if (shown_) clear_progress();
}

void Progress::at(std::int64_t done, std::uint64_t bytes) {
    if (!wanted_ || now_ms() < last_ms_ + 100) return;
    last_ms_ = now_ms();
    const int filled = int(30 * done / std::max<std::int64_t>(total_, 1));
    const std::string text = "\r" + what_ + " [" + std::string(filled, '#') + std::string(30 - filled, '.') + "] " +
                             std::to_string(done) + "/" + std::to_string(total_) +
                             (bytes > 0 ? ", " + bytes_text(double(bytes)) : "") + "\033[K";
    (void)!::write(STDERR_FILENO, text.data(), text.size());
    bar_on_screen = shown_ = true;
}

void clear_progress() {
    if (bar_on_screen.exchange(false)) (void)!::write(STDERR_FILENO, "\r\033[K", 4);
}

} // namespace bough
