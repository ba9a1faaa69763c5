#include "lib/study/step_bytes.h"
#include "lib/lanes/shared_constants.h"
#include "lib/model/append.h"
#include "tests/support/lanes_support.h"
#include "tests/support/make_tree.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace bough::fast;

namespace {

// By hand: a top of one row, a block of three rows that waits for it, and one of two rows, a whole tree. 16 lanes.
Layout by_hand() {
    Layout layout;
    layout.lanes = 16;
    layout.rows = 6;
    layout.grounds = 1;
    layout.joints = 4; // the ground, two forks, a port
    layout.groups = {{0, 1, 0}, {1, 3, 16}, {4, 2, 32}};
    layout.blocks = {{0, 1, 1, 1, 2, 0, 1, false}, {1, 2, 1, 2, 3, 1, 4, false}, {2, 3, 2, 3, 3, 4, 6, true}};
    layout.base.resize(48);
    layout.landing.resize(48);
    layout.fork_of_row = {0, -1, 1, -1, -1, -1};
    layout.fork.resize(32);
    return layout;
}

} // namespace

TEST_CASE("bytes of a layout made by hand") {
    const Layout layout = by_hand();
    const StepBytes all = coupled_step_bytes(layout, true, true, 4, true);
    CHECK(all.constants.in == 6 * 28 * 64);
    CHECK(all.constants.out == 0);
    CHECK(all.now.in == (6 * 12 + 4 * 6) * 64); // the four rows that wait read theta and theta_dot again
    CHECK(all.now.out == 0);
    CHECK(all.next.in == 2 * 12 * 64); // fetched before it is written, but where what was solved has been read
    CHECK(all.next.out == 6 * 12 * 64);
    CHECK(all.solved.out == 4 * 54 * 64);
    CHECK(all.solved.in == 4 * 54 * 64); // streamed: only read
    // Whole rows of 16: 34 -> 48, 54 -> 64, 12 -> 16 reals of 4 bytes.
    CHECK(all.records.in == 4 * (48 + 64 + 16) * 4);
    CHECK(all.records.out == all.records.in);
    // fork_of_row outward, inward, and again in the four rows that wait (the whole tree's two stand in the cache); base and landing;
    // base again; fork.
    CHECK(all.indices.in == 4 * (6 + 4 + 2 * 48 + 32 + 32));
    CHECK(all.total().in ==
          all.constants.in + all.now.in + all.next.in + all.solved.in + all.records.in + all.indices.in);
    CHECK(all.total().out == all.next.out + all.solved.out + all.records.out);

    CHECK(coupled_step_bytes(layout, true, true, 4, false).solved.in == 2 * 4 * 54 * 64); // fetched, and read
    CHECK(coupled_step_bytes(layout, false, true, 4, true).constants.in ==
          6 * 24 * 64); // no drag_area, no carried drag
    CHECK(coupled_step_bytes(layout, true, false, 4, true).constants.in == 6 * 25 * 64); // no carried moment
    // Constants of three rows, shared by all six: in once, by a table of six rows and one more; past the caches as if not.
    const StepBytes shared = coupled_step_bytes(layout, true, true, 4, true, 3);
    CHECK(shared.constants.in == 3 * 28 * 64);
    CHECK(shared.indices.in == all.indices.in + 4 * 7);
    CHECK(shared.tables == all.tables - 3 * 28 * 64 + 4 * 7);
    CHECK(shared.total().out == all.total().out);
    CHECK(coupled_step_bytes(layout, true, true, 4, true, 18724).constants.in == 18724 * 28 * 64); // just below 32 MB
    CHECK(coupled_step_bytes(layout, true, true, 4, true, 18725).constants.in == 6 * 28 * 64);
    Layout wide = layout; // in double 8 lanes: 34 -> 40, 54 -> 56, 12 -> 16 reals of 8 bytes
    wide.lanes = 8;
    CHECK(coupled_step_bytes(wide, true, true, 8, true).records.in == 4 * (40 + 56 + 16) * 8);
    constexpr std::size_t cache = std::size_t(32) << 20;
    CHECK_FALSE(streams(layout, cache)); // 36 kB
    wide.rows = 5500;                    // 66 + 28 lines of 64 bytes each: 33.1 MB, less than 32 x 1024^2
    CHECK_FALSE(streams(wide, cache));
    wide.rows = 5600; // 33.7 MB
    CHECK(streams(wide, cache));
    CHECK_FALSE(streams(wide, 2 * cache));
    wide.blocks = {wide.blocks[2]};
    CHECK_FALSE(streams(wide, cache)); // nothing waits
}

TEMPLATE_TEST_CASE("the tables that are counted are those that a run has allocated", "", float, double) {
    using T = TestType;
    const auto row = [](const auto& rows) { return rows.size() * sizeof(rows[0]); };
    for (const std::int64_t bodies : {300, 20000}) {
        lanes::Case c{"grown", lanes::grown(bodies), lanes::everything()};
        lanes::LanesRun<T> run(c, Target::baseline);
        run.steps(1);
        const Layout& layout = parts::lanes(run.plan).layout;
        const Lanes<T>& l = parts::lanes(run.state);
        const StepBytes bytes = coupled_step_bytes(layout, true, true, sizeof(T), false);
        CAPTURE(bodies);
        CHECK(bytes.tables == row(parts::lanes(run.plan).constants) + row(l.table) + row(l.outward) + row(l.inward) +
                                  row(l.accelerated) + row(layout.fork_of_row) + row(layout.fork) + row(layout.base) +
                                  row(layout.landing));
        CHECK(bytes.constants.in == row(parts::lanes(run.plan).constants));
        CHECK(bytes.next.out == layout.rows * 12 * 64);
    }
}

TEMPLATE_TEST_CASE("of shared constants, too", "", float, double) {
    using T = TestType;
    const auto row = [](const auto& rows) { return rows.size() * sizeof(rows[0]); };
    lanes::Case c{"instances", lanes::grown(300), lanes::everything()};
    const std::size_t n = c.tree.size_bodies();
    append(c.tree, Tree(c.tree), Vec3(3, 0, 0), 0);
    c.ranges = {{0, n, 0}, {n, n, 1000}};
    lanes::LanesRun<T> run(c, Target::baseline);
    REQUIRE(parts::lanes(run.plan).sharing.on);
    const Layout& layout = parts::lanes(run.plan).layout;
    const Lanes<T>& l = parts::lanes(run.state);
    const StepBytes bytes =
        coupled_step_bytes(layout, true, true, sizeof(T), false, shared_rows(parts::lanes(run.plan)));
    CHECK(bytes.tables == row(parts::lanes(run.plan).constants) + row(parts::lanes(run.plan).sharing.row) +
                              row(l.table) + row(l.outward) + row(l.inward) + row(l.accelerated) +
                              row(layout.fork_of_row) + row(layout.fork) + row(layout.base) + row(layout.landing));
    CHECK(bytes.constants.in == row(parts::lanes(run.plan).constants));
}

// Of by_hand(): 6 rows, of which the top's one is visited twice.
TEST_CASE("bytes of the analytic step over a layout made by hand") {
    const StepBytes all = analytic_step_bytes(by_hand(), true, true, true, 4);
    CHECK(all.constants.in == 7 * 29 * 64);
    CHECK(all.now.in == 7 * 9 * 64);
    CHECK(all.next.in == 0); // where it was read
    CHECK(all.next.out == 6 * 9 * 64);
    CHECK(all.solved.in + all.solved.out == 0);
    CHECK(all.records.in == 4 * (16 + 32) * 4); // 16, 28 -> 32 reals of 4 bytes
    CHECK(all.indices.in == 4 * (7 + 48 + 48 + 32));
    const StepBytes shared = analytic_step_bytes(by_hand(), true, true, true, 4, false, 3);
    CHECK(shared.constants.in == 3 * 29 * 64);
    CHECK(shared.indices.in == all.indices.in + 4 * 7);
    CHECK(shared.tables == all.tables - 3 * 29 * 64 + 4 * 7);
    CHECK(analytic_step_bytes(by_hand(), false, true, false, 4).constants.in == 7 * 23 * 64);
    CHECK(analytic_step_bytes(by_hand(), false, false, true, 4).records.in == 4 * (16 + 16) * 4);
}
