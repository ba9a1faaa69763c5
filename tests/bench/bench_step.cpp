// One step of 10 000 bodies in a gusty wind, on one thread; in lanes also of apples of other sizes, on one and two, by the clock; and what the fast
// path is laid out by. Items are bodies.
#include "bench_tree.h"
#include "formats/files.h"
#include "lib/base/parallel.h"
#include "lib/lanes/layout.h"
#include "lib/lanes/target.h"
#include "lib/study/solvers.h"
#include "tests/support/solver_parts.h"
#include <benchmark/benchmark.h>

namespace {

using namespace bough;

enum class Path { lanes, plain };

// path: lanes where they hold the solver; the label says which it was.
template <class T> void steps(benchmark::State& benchmark, const Tree& tree, Solver solver, Path path) {
    Scene scene;
    scene.wind = *wind_preset("gusty");
    const std::optional<fast::Target> simd = path == Path::lanes ? fast::best_target() : std::optional<fast::Target>();
    const Plan<T> plan =
        make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver, Scheme::p12, simd);
    State<T> state = make_state(plan);
    for (auto _ : benchmark) advance(plan, state);
    benchmark.SetItemsProcessed(benchmark.iterations() * std::int64_t(plan.bodies));
    benchmark.SetLabel(plan.stepper->in_lanes() ? fast::target_name(parts::lanes(plan).target) : "plain");
}

template <class T> void step_of(benchmark::State& benchmark, Solver solver, Path path) {
    const ThreadLimit one(1);
    steps<T>(benchmark, bench::tree(), solver, path);
}

// By range(0) bodies and range(1) threads. One tree of a size is kept for those after it.
void step_of_size(benchmark::State& benchmark, Solver solver) {
    static std::pair<std::int64_t, Tree> kept;
    if (kept.first != benchmark.range(0))
        kept = {benchmark.range(0), convert(grow("apple", {.bodies = benchmark.range(0), .seed = 1}))};
    const ThreadLimit threads(int(benchmark.range(1)));
    steps<float>(benchmark, kept.second, solver, Path::lanes);
}

void layout(benchmark::State& benchmark) {
    const Tree& tree = bench::tree();
    for (auto _ : benchmark)
        benchmark::DoNotOptimize(fast::make_layout(tree.parent, tree.kind, {0}, 1, int(benchmark.range(0))));
    benchmark.SetItemsProcessed(benchmark.iterations() * std::int64_t(tree.size_bodies()));
}

const bool registered = [] {
    using benchmark::RegisterBenchmark;
    RegisterBenchmark("step/coupled/lanes/float", step_of<float>, Solver::coupled, Path::lanes);
    RegisterBenchmark("step/coupled/lanes/double", step_of<double>, Solver::coupled, Path::lanes);
    RegisterBenchmark("step/coupled/plain/double", step_of<double>, Solver::coupled, Path::plain);
    RegisterBenchmark("step/analytic/lanes/float", step_of<float>, Solver::analytic, Path::lanes);
    RegisterBenchmark("step/analytic/lanes/double", step_of<double>, Solver::analytic, Path::lanes);
    RegisterBenchmark("step/analytic/plain/double", step_of<double>, Solver::analytic, Path::plain);
    for (const std::int64_t bodies : {10000, 100000, 1000000})
        for (const Solver solver : {Solver::coupled, Solver::analytic})
            for (const std::int64_t threads : {1, 2})
                RegisterBenchmark(("step/" + std::string(solver_name(solver)) + "/size").c_str(), step_of_size, solver)
                    ->Args({bodies, threads})
                    ->ArgNames({"", "threads"})
                    ->Unit(benchmark::kMicrosecond)
                    ->UseRealTime();
    RegisterBenchmark("layout", layout)->Arg(16)->Arg(8)->ArgName("lanes");
    return true;
}();

} // namespace
