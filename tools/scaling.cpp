#include "scaling.h"
#include "formats/files.h"
#include "lib/base/caches.h"
#include "lib/base/hash_text.h"
#include "lib/growth/segment.h"
#include "lib/model/append.h"
#include "lib/study/machine_limits.h"
#include "lib/study/resident.h"
#include "lib/study/timed_steps.h"
#include "threads.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace bough {
namespace {

constexpr double orchard = 20; // [m] from tree to tree

double median(std::vector<double> values) {
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// By which target's limits a run is held.
fast::Target target_of(const RunOptions& way) {
    if (const auto simd = chosen_simd(way)) return *simd;
    if (fast::available(fast::Target::baseline)) return fast::Target::baseline; // what the plain step is compiled for
    if (const auto best = fast::best_target()) return *best;
    throw UsageError(
        "--simd off: of this build's SIMD code, with which the machine's limits are measured, none runs here");
}

class Measurement {
public:
    Measurement(const std::vector<ScalingTree>& t, const ScalingChoice& c,
                const std::function<void(std::int64_t, std::int64_t)>& tick)
        : trees(t), choice(c), tick_(tick) {}

    ScalingReport run() {
        report.repeat = choice.repeat;
        report.array = double(choice.array);
        report.last_cache = double(last_cache());
        report.core_cache = double(core_cache());
        for (round = 0; round < choice.repeat; ++round) {
            at = 0;
            limits_once();
            for (const ScalingTree& tree : trees)
                for (const RunOptions& way : choice.ways) plan_once(tree, way);
        }
        finish();
        return std::move(report);
    }

private:
    const std::vector<ScalingTree>& trees;
    const ScalingChoice& choice;
    const std::function<void(std::int64_t, std::int64_t)>& tick_;
    ScalingReport report;
    std::map<std::pair<fast::Target, int>, std::vector<MachineLimits>> limits;
    std::vector<std::vector<double>> ns; // of report.runs
    std::vector<std::size_t> cost;       // of report.runs: index in report.costs
    std::vector<fast::Target> target;    // of report.runs
    std::size_t at = 0;                  // the run's place in this round
    int round = 0;

    void limits_once() {
        for (const RunOptions& way : choice.ways)
            for (const int threads : choice.threads) {
                std::vector<MachineLimits>& of = limits[{target_of(way), threads}];
                if (of.size() == std::size_t(round))
                    of.push_back(measure_limits(target_of(way), threads, choice.array));
            }
    }

    void plan_once(const ScalingTree& tree, const RunOptions& way) {
        const std::optional<std::size_t> before = resident();
        const bool counts_peak = before && forget_peak();
        use_threads(choice.threads.front());
        RunOptions named = way; // for what is said of the tree
        named.input = tree.shape;
        Simulation run = started(std::make_shared<Setting>(tree.setting), named, choice.threads.front(),
                                 {}); // as treesim --no-output
        const std::size_t first = at;
        for (const int threads : choice.threads) {
            time_once(tree, way, run, threads);
            if (round == 0 && counts_peak && at == first + 1)
                report.runs[first].memory = double(*peak_resident() - *before);
        }
        if (round > 0) return;
        const RunAccount account = run.account();
        ScalingCost c;
        static_cast<StepCost&>(c) = step_cost(run, report.runs[first].frames);
        c.shape = tree.shape;
        c.solver = way.solver;
        c.precision = way.precision;
        c.simd = account.simd;
        c.bodies = std::int64_t(account.bodies);
        for (std::size_t k = first; k < at; ++k) {
            cost.push_back(report.costs.size());
            report.runs[k].memory = report.runs[first].memory;
        }
        report.costs.push_back(c);
    }

    void time_once(const ScalingTree& tree, const RunOptions& way, Simulation& run, int threads) {
        tick_(std::int64_t(std::size_t(round) * all_runs() + at),
              std::int64_t(std::size_t(choice.repeat) * all_runs()));
        const RunAccount account = run.account();
        const auto bodies = std::int64_t(account.bodies);
        const std::int64_t frames = choice.frames > 0 ? choice.frames : scaling_frames(bodies);
        use_threads(threads);
        begin_again(run);
        timed_step(run);
        require_finite(run, 1);
        double seconds = 0;
        for (std::int64_t f = 0; f < frames; ++f) {
            seconds += timed_step(run);
            require_finite(run, f + 2);
        }
        const std::string hash = hash_text(run.hash());
        if (round == 0) {
            ScalingRun made;
            made.shape = tree.shape;
            made.solver = way.solver;
            made.scheme = scheme_name(way);
            made.precision = way.precision;
            made.simd = account.simd;
            made.threads = threads;
            made.bodies = bodies;
            made.frames = frames;
            made.hash = hash;
            report.runs.push_back(made);
            ns.emplace_back();
            target.push_back(target_of(way));
            const ScalingRun& first = report.runs[at - at % choice.threads.size()];
            if (hash != first.hash)
                throw PromiseError(tree.shape + ", " + std::to_string(bodies) + " bodies: " + std::to_string(threads) +
                                   " threads gave hash " + hash + ", " + std::to_string(first.threads) + " gave " +
                                   first.hash);
        } else if (hash != report.runs[at].hash) {
            throw PromiseError(tree.shape + ", " + std::to_string(bodies) + " bodies: two runs of the same gave hash " +
                               report.runs[at].hash + " and " + hash);
        }
        ns[at++].push_back(1e9 * seconds / double(bodies) / double(frames));
    }

    std::size_t all_runs() const { return trees.size() * choice.ways.size() * choice.threads.size(); }

    void finish() {
        const auto of = [](const std::vector<MachineLimits>& all, double MachineLimits::*figure) {
            std::vector<double> values;
            for (const MachineLimits& l : all) values.push_back(l.*figure);
            return median(values);
        };
        const auto limits_of = [&](fast::Target simd, int threads) {
            const std::vector<MachineLimits>& all = limits[{simd, threads}];
            ScalingLimits l;
            l.simd = fast::target_name(simd);
            l.threads = threads;
            l.read = of(all, &MachineLimits::read);
            l.write = of(all, &MachineLimits::write);
            l.copy = of(all, &MachineLimits::copy);
            l.peak_float = of(all, &MachineLimits::peak_float);
            l.peak_double = of(all, &MachineLimits::peak_double);
            return l;
        };
        for (const auto& [key, all] : limits) report.limits.push_back(limits_of(key.first, key.second));
        for (std::size_t k = 0; k < report.runs.size(); ++k) {
            ScalingRun& run = report.runs[k];
            run.ns = median(ns[k]);
            run.ns_least = *std::min_element(ns[k].begin(), ns[k].end());
            run.ns_most = *std::max_element(ns[k].begin(), ns[k].end());
            hold_against_limits(run, report.costs[cost[k]], limits_of(target[k], run.threads), report.core_cache);
        }
        find_memory_slopes(report);
    }
};

} // namespace

Tree scaling_tree(const std::string& shape, std::int64_t bodies) {
    if (shape == "chain") {
        constexpr double height = 20, radius = 0.2;
        Splines pole;
        pole.parent = {-1};
        pole.parent_at = {0};
        pole.level = {0};
        pole.first_point = {0, 2};
        pole.point = {Vec3::Zero(), Vec3(0, height, 0)};
        pole.radius = {radius, radius};
        pole.name = shape;
        SegmentOptions options;
        options.segment_length = height / (double(bodies) - 0.5); // the least number of even pieces no longer than this
        return segment(pole, wood_presets().front(), options);
    }
    try {
        Splines splines = grow(shape == "willow" ? "willow" : "apple", {.seed = 1});
        const std::int64_t whole = count_bodies(splines, {});
        const std::int64_t trees = (bodies + whole - 1) / whole,
                           row = std::llround(std::ceil(std::sqrt(double(trees))));
        ask_for_bodies(splines, std::max<std::int64_t>(bodies / trees, 1));
        const Tree one = convert(splines);
        Tree all = one;
        for (std::int64_t k = 1; k < trees; ++k)
            append(all, one, orchard * Vec3(double(k % row), 0, double(k / row)), 0);
        return all;
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("--") + error.what());
    }
}

std::int64_t scaling_frames(std::int64_t bodies) {
    return std::clamp<std::int64_t>(4000000 / bodies, 4, 240);
}

ScalingReport measure_scaling(const std::vector<ScalingTree>& trees, const ScalingChoice& choice,
                              const std::function<void(std::int64_t, std::int64_t)>& tick) {
    return Measurement(trees, choice, tick).run();
}

} // namespace bough
