#include "step_cost.h"
#include "../base/parallel.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../lanes/operations.h"
#include "../lanes/plan_lanes.h"
#include "../lanes/shared_constants.h"
#include "../simulation/any_run.h"
#include "step_bytes.h"
#include <algorithm>

namespace bough {
namespace {

template <class T> void count_operations(Plan<T>& plan, State<T>& state, std::int64_t most, StepCost& cost) {
    fast::PlannedLanes<T>& lanes = *fast::planned_lanes(plan);
    const fast::Target target = lanes.target;
    const ThreadLimit one(1);
    advance(plan, state); // the one of warm-up
    lanes.target = fast::counted_target;
    fast::counted_operations() = {};
    const std::int64_t steps = std::clamp<std::int64_t>(400000 / std::int64_t(plan.bodies), 1, most);
    for (std::int64_t k = 0; k < steps; ++k) advance(plan, state);
    lanes.target = target;
    const fast::Operations& done = fast::counted_operations();
    const double each = 1 / (double(plan.bodies) * double(steps));
    cost.additions = double(done.additions) * each;
    cost.multiplications = double(done.multiplications) * each;
    cost.divisions = double(done.divisions) * each;
    cost.roots = double(done.roots) * each;
}

template <class T> void count_bytes(const Plan<T>& plan, StepCost& cost) {
    const fast::PlannedLanes<T>& lanes = *fast::planned_lanes(plan);
    const fast::Layout& layout = lanes.layout;
    // wide.h writes past the caches where a register is a line.
    const bool streamed = lanes.target == fast::Target::avx512 && fast::streams(layout);
    const std::uint64_t shared = fast::shared_rows(lanes);
    const fast::StepBytes bytes =
        fast::coupled_plan(plan)
            ? fast::coupled_step_bytes(layout, plan.wind, plan.gravity, sizeof(T), streamed, shared)
            : fast::analytic_step_bytes(layout, plan.wind, plan.pushes(), plan.gravity, sizeof(T), plan.field, shared);
    const auto each = [&](std::uint64_t all) { return double(all) / double(plan.bodies); };
    cost.slots = each(std::uint64_t(layout.rows) * std::uint64_t(layout.lanes));
    cost.constants_in = each(bytes.constants.in);
    cost.now_in = each(bytes.now.in);
    cost.next_in = each(bytes.next.in);
    cost.next_out = each(bytes.next.out);
    cost.solved_in = each(bytes.solved.in);
    cost.solved_out = each(bytes.solved.out);
    cost.records_in = each(bytes.records.in);
    cost.records_out = each(bytes.records.out);
    cost.indices_in = each(bytes.indices.in);
    cost.tables = double(bytes.tables);
}

} // namespace

bool counts_steps() {
    return fast::available(fast::counted_target);
}

StepCost step_cost(Simulation& simulation, std::int64_t steps) {
    StepCost cost;
    AnyRun& any = run_of(simulation);
    any.begin_again();
    visit_run(any, [&](auto& run) {
        if (!fast::planned_lanes(run.plan)) return;
        count_operations(run.plan, run.state, steps, cost);
        count_bytes(run.plan, cost);
    });
    return cost;
}

} // namespace bough
