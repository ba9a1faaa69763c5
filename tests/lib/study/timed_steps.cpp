// Steps by the clock are the steps: the same motion, from the same start.
#include "lib/study/timed_steps.h"
#include "tests/support/simulations.h"
#include <numeric>

using namespace bough;
using namespace simulations;

TEST_CASE("a run that is timed moves as one that is not, again from its start, and its stages take no longer than its "
          "steps") {
    Simulation plain(one(leafy(), "gusty"), {}), timed(one(leafy(), "gusty"), {});
    const std::uint64_t hash = run(plain, 12);
    run(timed, 5);
    for (int again = 0; again < 2; ++again) {
        begin_again(timed);
        CHECK(timed.steps() == 0);
        StageClock clock;
        double seconds = 0;
        for (int k = 0; k < 12; ++k) seconds += timed_step(timed, &clock);
        CHECK(non_finite(timed) == "");
        CHECK(timed.hash() == hash);
        const double inside = std::accumulate(clock.seconds.begin(), clock.seconds.end(), 0.0);
        CHECK(inside > 0);
        CHECK(inside <= seconds);
    }
}
