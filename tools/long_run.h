// long_run.h: how long work will take, told beforehand where that is long.
#pragma once
#include <cstdint>
#include <functional>

namespace bough {

// Of `total` pieces of work that take about as long as each other. Once two seconds of them are done, and more than a minute is left, `say` is told
// how many seconds that is. clock: in seconds.
class LongRun {
public:
    LongRun(std::int64_t total, std::function<void(double left)> say, std::function<double()> clock);
    void at(std::int64_t done);

private:
    std::int64_t total_;
    std::function<void(double)> say_;
    std::function<double()> clock_;
    double begin_;
};

// [s] of the machine's clock.
double clock_seconds();

} // namespace bough
