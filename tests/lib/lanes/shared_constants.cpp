// Instances of one tree share their constants: what each row reads is what it reads where nothing is shared, nothing more is kept than is different,
// and runs are the same to the last bit. Beside each park stands the same one under names of files of its own for each tree, which shares nothing.
#include "lib/lanes/shared_constants.h"
#include "lib/analytic/analytic_rows.h"
#include "lib/coupled/coupled_rows.h"
#include "lib/model/append.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"
#include <cstring>
#include <numbers>
#include <set>

using namespace bough;
using namespace lanes;

namespace {

const Tree& small() { // a stand, and a block, of its own
    static const Tree tree = firm(grown(300));
    return tree;
}

// Trees one behind the other, as many degrees apart; file[k]: which tree is the same as which.
struct Park {
    Case c;
    explicit Park(const std::vector<Tree>& trees, const std::vector<std::string>& files, double degrees = 0,
                  Solver solver = Solver::coupled) {
        c.solver = solver;
        std::int32_t branch = 0;
        for (std::size_t k = 0; k < trees.size(); ++k) {
            const double yaw = degrees * double(k);
            const Vec3 at(3.0 * double(k % 40), 0, 3.0 * double(k / 40));
            const std::size_t first = append(c.tree, trees[k], at, yaw * std::numbers::pi / 180);
            c.ranges.push_back({first, trees[k].size_bodies(), branch});
            branch += *std::max_element(trees[k].branch.begin(), trees[k].branch.end()) + 1;
            c.scene.trees.push_back({files[k], at, yaw, 0});
        }
    }
    static std::vector<std::string> one_file(std::size_t trees) { return std::vector<std::string>(trees, "tree"); }
    Case unshared() const {
        Case other = c;
        for (std::size_t k = 0; k < other.scene.trees.size(); ++k) other.scene.trees[k].file += std::to_string(k);
        return other;
    }
};

template <class T> std::size_t quantities(const Plan<T>& plan) {
    return std::size_t(plan.stepper->kind().name == std::string(solver_name(Solver::analytic))
                           ? fast::analytic::constants(plan.wind)
                           : int(fast::constant::count));
}

// What a row of the layout reads.
template <class T> std::string read_by(const Plan<T>& plan, std::size_t row) {
    const std::size_t q = quantities(plan),
                      at = parts::lanes(plan).sharing.on ? parts::lanes(plan).sharing.row[row] : row;
    return {reinterpret_cast<const char*>(&parts::lanes(plan).constants[at * q]), q * sizeof(fast::Row<T>)};
}

template <class T> std::set<std::string> different_rows(const Plan<T>& unshared) {
    std::set<std::string> rows;
    for (std::size_t r = 0; r < parts::lanes(unshared).layout.rows; ++r) rows.insert(read_by(unshared, r));
    return rows;
}

template <class T> void check_read_alike(const Plan<T>& shared, const Plan<T>& unshared) {
    REQUIRE_FALSE(parts::lanes(unshared).sharing.on);
    REQUIRE(parts::lanes(unshared).constants.size() == parts::lanes(unshared).layout.rows * quantities(unshared));
    REQUIRE(parts::lanes(shared).layout.rows == parts::lanes(unshared).layout.rows);
    for (std::size_t r = 0; r < parts::lanes(shared).layout.rows; ++r) {
        CAPTURE(r);
        REQUIRE(read_by(shared, r) == read_by(unshared, r));
    }
}

template <class T> std::size_t kept(const Plan<T>& plan) {
    return parts::lanes(plan).constants.size() / quantities(plan);
}

} // namespace

// A tree of R different rows, one of which has its root: in n places R - 1 + n.
TEMPLATE_TEST_CASE("a thousand instances keep one tree's constants, and a row each for their roots", "", float,
                   double) {
    using T = TestType;
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    Case alone{"alone", small(), {}};
    alone.solver = solver;
    const LanesRun<T> one(alone, fast::best_target());
    const std::size_t rows = parts::lanes(one.plan).layout.rows;
    REQUIRE(one.plan.bodies >= 256);
    REQUIRE(different_rows(one.plan).size() == rows);
    REQUIRE(parts::lanes(one.plan).sharing.reason == "one tree");

    constexpr std::size_t places = 1000;
    const Park park(std::vector<Tree>(places, small()), Park::one_file(places), 0, solver);
    const LanesRun<T> run(park.c, fast::best_target(), Scheme::p12, {false, false, false});
    CHECK(parts::lanes(run.plan).layout.rows == places * rows);
    REQUIRE(parts::lanes(run.plan).sharing.on);
    CHECK(kept(run.plan) == rows - 1 + places);
    CHECK(fast::shared_rows(parts::lanes(run.plan)) == rows - 1 + places);
    CHECK(parts::lanes(run.plan).constants.capacity() == parts::lanes(run.plan).constants.size());
}

// Two files, their trees among each other; trees of ten bodies, some thirty in a stand.
TEMPLATE_TEST_CASE("each row reads what it reads where nothing is shared, and none is kept twice", "", float, double) {
    using T = TestType;
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    const bool wind = GENERATE(true, false);
    const Tree other = firm(grown(700)), tiny = make_tree::branched();
    std::vector<Park> parks{Park({small(), other, small(), small(), other}, {"a", "b", "a", "a", "b"}, 0, solver),
                            Park(std::vector<Tree>(120, tiny), Park::one_file(120), 0, solver),
                            Park({small(), tiny, other, small(), tiny}, {"a", "b", "c", "a", "b"}, 40, solver)};
    for (Park& park : parks) {
        if (wind) park.c.scene.wind = gusts();
        const LanesRun<T> shared(park.c, fast::best_target()), unshared(park.unshared(), fast::best_target());
        CAPTURE(park.c.tree.size_bodies());
        CHECK(parts::lanes(unshared.plan).sharing.reason == "no tree stands at two places");
        check_read_alike(shared.plan, unshared.plan);
        CHECK(kept(shared.plan) == different_rows(unshared.plan).size());
        // Rounded to float, yaws do not show.
        if (&park != &parks.back() || sizeof(T) == 4) CHECK(kept(shared.plan) < parts::lanes(shared.plan).layout.rows);
        CHECK(parts::lanes(shared.plan).sharing.on == (kept(shared.plan) < parts::lanes(shared.plan).layout.rows));
    }
}

// One spring of one instance is another: that instance moves as the plain step, whose constants are no rows, says.
TEMPLATE_TEST_CASE("an instance of which one body differs has constants of its own there, and moves by them", "", float,
                   double) {
    using T = TestType;
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    Tree changed = small();
    const std::size_t body = 200;
    changed.stiffness[body] *= 0.25;
    Park park({small(), changed, small()}, Park::one_file(3), 0, solver);
    park.c.scene.wind = gusts();
    park.c.scene.pose = Pose::rest; // else what is above takes another rest angle, too
    LanesRun<T> shared(park.c, fast::best_target()), unshared(park.unshared(), fast::best_target());
    REQUIRE(parts::lanes(shared.plan).sharing.on);
    check_read_alike(shared.plan, unshared.plan);
    Case plain_case = park.c;
    LanesRun<> plain(plain_case, std::nullopt);
    LanesRun<> lanes_double(park.c, fast::best_target());
    const Apart d = run_apart(plain, lanes_double, 30);
    CHECK(d.theta < 1e-9);
    CHECK(d.x < 1e-9);
    // And that is something else than the others do.
    const std::size_t n = small().size_bodies();
    CHECK((plain.state.theta[n + body] - plain.state.theta[body]).norm() > 1e-4);
    shared.steps(30), unshared.steps(30);
    CHECK(shared.hash() == unshared.hash());
}

// Gusts over the ground, pulls, moved roots, what turns fast (the energy guard), sleep, several blocks a tree.
TEMPLATE_TEST_CASE("shared constants change no bit of a run", "", float, double) {
    using T = TestType;
    struct Way {
        std::string name;
        Case c;
        double sleep = 0;
    };
    std::vector<Way> ways;
    const Tree large = firm(grown(4500)); // several blocks
    for (const Solver solver : {Solver::coupled, Solver::analytic}) {
        Park windy({small(), small(), small(), large, large}, {"a", "a", "a", "b", "b"}, 0, solver);
        windy.c.scene.wind = gusts();
        windy.c.scene.pulls = pulls();
        if (solver == Solver::coupled) windy.c.scene.root_motion = {carried_about(1)};
        ways.push_back({"wind and pulls", windy.c});
        windy.c.scene.root_motion.clear();
        windy.c.scene.wind->swirl.emplace();
        windy.c.scene.wind->swirl->angle = {20};
        windy.c.scene.trees[1].start = 3;
        ways.push_back({"wind over the ground", windy.c});
        Park fast_ones(std::vector<Tree>(6, small()), Park::one_file(6), 0, solver);
        fast_ones.c.angle = 0.1;
        fast_ones.c.rate = 20;
        ways.push_back({"fast", fast_ones.c});
        Park still(std::vector<Tree>(6, small()), Park::one_file(6), 0, solver);
        still.c.angle = 0.05;
        ways.push_back({"still", still.c, 1e-2});
    }
    for (const Way& way : ways)
        for (const Target target : targets()) {
            CAPTURE(way.name, solver_name(way.c.solver), fast::target_name(target));
            Park park({}, {});
            park.c = way.c;
            LanesRun<T> shared(way.c, target, Scheme::p12, {}, std::nullopt, way.sleep);
            LanesRun<T> unshared(park.unshared(), target, Scheme::p12, {}, std::nullopt, way.sleep);
            REQUIRE(parts::lanes(shared.plan).sharing.on);
            REQUIRE_FALSE(parts::lanes(unshared.plan).sharing.on);
            const int steps = way.sleep > 0 ? 45 : 8; // a second, and blocks may sleep
            shared.steps(steps), unshared.steps(steps);
            CHECK(shared.hash() == unshared.hash());
            CHECK(shared.state.flags.fast_turns == unshared.state.flags.fast_turns);
        }
}

TEST_CASE("nothing is shared where nothing can be, and the plan says why") {
    const auto reason = [](const Case& c) {
        const LanesRun<float> run(c, fast::best_target());
        CHECK_FALSE(parts::lanes(run.plan).sharing.on);
        CHECK(parts::lanes(run.plan).sharing.row.empty());
        CHECK(kept(run.plan) == parts::lanes(run.plan).layout.rows);
        CHECK(fast::shared_rows(parts::lanes(run.plan)) == 0);
        return parts::lanes(run.plan).sharing.reason;
    };
    Park park({small(), small()}, Park::one_file(2));
    park.c.scene.fracture.emplace();
    CHECK(reason(park.c) == "/fracture");
    CHECK(reason(Park({small()}, {"a"}).c) == "one tree");
    CHECK(reason(Park({small(), small()}, {"a", "b"}).c) == "no tree stands at two places");
    CHECK(reason(Park({small(), firm(grown(500))}, {"a", "a"}).c) == "no tree stands at two places"); // one was cut
    Tree softer = small();
    for (Vec3& K : softer.stiffness) K *= 0.5;
    CHECK(reason(Park({small(), softer}, {"a", "a"}).c) == "no two rows are equal");
    // Without names of files as many bodies will do.
    Case nameless = Park({small(), small()}, Park::one_file(2)).c;
    nameless.scene.trees.clear();
    CHECK(parts::lanes(LanesRun<float>(nameless, fast::best_target()).plan).sharing.on);
}
