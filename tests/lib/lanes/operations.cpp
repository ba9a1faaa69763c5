// The kernels' own algebra, compiled to be counted.
#define BOUGH_TARGET counted
#define BOUGH_COUNTED
#include "lib/lanes/wide_algebra.h"
#undef BOUGH_TARGET

#include "lib/lanes/operations.h"
#include "tests/support/lanes_support.h"
#include "tests/support/make_tree.h"

using namespace bough;
using namespace bough::fast;

namespace {

struct Count {
    std::uint64_t additions, multiplications, divisions, roots;
    friend bool operator==(const Count&, const Count&) = default;
};
std::ostream& operator<<(std::ostream& out, const Count& c) {
    return out << c.additions << " " << c.multiplications << " " << c.divisions << " " << c.roots;
}

template <class Work> Count counted_in(Work&& work) {
    counted_operations() = {};
    work();
    const Operations& done = counted_operations();
    return {done.additions, done.multiplications, done.divisions, done.roots};
}

// Operations of one step of a chain of rods, one lane: the second.
Count of_chain(int rods, const Scene& scene) {
    lanes::Case c{"chain", make_tree::chain(rods, 0.1 * rods, 0.03, 0.02), scene};
    lanes::LanesRun<double> run(c, counted_target);
    run.steps(1);
    return counted_in([&] { run.steps(1); });
}

} // namespace

TEST_CASE("operations of vectors and matrices are those of the book") {
    using W = WideDouble;
    const V3<W> v{W(1.0), W(2.0), W(3.0)};
    const M3<W> m{v, v, v};
    const Complex<W> z{W(1.0), W(2.0)};
    CHECK(counted_in([&] { (void)dot(v, v); }) == Count{2, 3, 0, 0});
    CHECK(counted_in([&] { (void)cross(v, v); }) == Count{3, 6, 0, 0});
    CHECK(counted_in([&] { (void)(m * v); }) == Count{6, 9, 0, 0});
    CHECK(counted_in([&] { (void)(m * m); }) == Count{18, 27, 0, 0});
    CHECK(counted_in([&] { (void)(z * z); }) == Count{2, 4, 0, 0});
    CHECK(counted_in([&] { (void)inverse(z); }) == Count{1, 4, 1, 0});
    CHECK(counted_in([&] { (void)root(dot(v, v)); }) == Count{2, 3, 0, 1});
    CHECK(counted_in([&] { (void)(-v); }) == Count{0, 0, 0, 0});
    CHECK(counted_in([&] { (void)larger(v.x, v.y); }) == Count{0, 0, 0, 0});
    CHECK(counted_in([&] { (void)all(1.0); }) == Count{0, 0, 0, 0});
    W sum(0.0);
    CHECK(counted_in([&] { sum += v.x, sum -= v.y, sum *= v.z; }) == Count{2, 1, 0, 0});
    CHECK(sum[0] == -3);
}

TEMPLATE_TEST_CASE("the step that is counted is baseline's, bit for bit", "", float, double) {
    Scene rooted = lanes::everything();
    rooted.root_motion.clear();
    for (lanes::Case& c :
         std::vector<lanes::Case>{{"grown", lanes::grown(1500), lanes::everything(), 0.3, 2},
                                  {"still", lanes::grown(700), Scene{}, 0.1, 1},
                                  {"grown, analytic", lanes::grown(1500), rooted, 0.3, 2, {}, Solver::analytic}}) {
        CAPTURE(c.name);
        lanes::LanesRun<TestType> baseline(c, Target::baseline), counting(c, counted_target);
        REQUIRE(counting.plan.stepper->in_lanes());
        baseline.steps(5);
        counting.steps(5);
        CHECK(baseline.hash() == counting.hash());
    }
}

TEST_CASE("operations go with the rows: each further part of a chain adds as many") {
    for (const bool wind : {false, true}) {
        Scene scene;
        if (wind) scene.wind = *wind_preset("breeze");
        const Count one = of_chain(16, scene), two = of_chain(32, scene), four = of_chain(64, scene);
        CAPTURE(wind, one, two, four);
        CHECK(two.additions - one.additions == (four.additions - two.additions) / 2);
        CHECK(two.multiplications - one.multiplications == (four.multiplications - two.multiplications) / 2);
        CHECK(two.divisions - one.divisions == (four.divisions - two.divisions) / 2);
        CHECK(two.additions > one.additions);
    }
}

TEST_CASE("no machine is the target that counts") {
    for (const Target target : all_targets) CHECK(target != counted_target);
    CHECK_FALSE(target_named("counted"));
    CHECK(best_target().value() != counted_target);
}
