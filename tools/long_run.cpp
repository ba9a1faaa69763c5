#include "long_run.h"
#include <chrono>

namespace bough {

LongRun::LongRun(std::int64_t total, std::function<void(double left)> say, std::function<double()> clock)
    : total_(total), say_(std::move(say)), clock_(std::move(clock)), begin_(clock_()) {}

void LongRun::at(std::int64_t done) {
    constexpr double enough = 2, is_long = 60; // [s]
    if (!say_ || done < 1) return;
    const double passed = clock_() - begin_;
    if (passed < enough) return;
    const double left = passed * double(total_ - done) / double(done);
    if (left > is_long) say_(left);
    say_ = nullptr;
}

double clock_seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

} // namespace bough
