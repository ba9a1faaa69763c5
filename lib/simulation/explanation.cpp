#include "explanation.h"
#include "../base/parallel.h"
#include "../lanes/lane_tables.h"
#include "../lanes/plan_lanes.h"
#include "../lanes/shared_constants.h"
#include "../plan/explain.h"
#include <cmath>
#include <sstream>

namespace bough {
namespace {

template <class T> std::string sharing_text(const fast::PlannedLanes<T>& lanes) {
    const std::string rows = std::to_string(lanes.layout.rows) + " rows: ";
    const std::string bytes = std::to_string(lanes.constants.size() * sizeof(fast::Row<T>)) + " bytes, ";
    if (!lanes.sharing.on) return bytes + rows + "none shared, " + lanes.sharing.reason;
    return bytes + rows + "shared by instances, " + std::to_string(fast::shared_rows(lanes)) + " kept";
}

// How many threads the largest loop of a step runs on.
template <class T> std::string threads_text(const Plan<T>& plan) {
    const std::string most = "of at most " + std::to_string(thread_limit()) + ": ";
    const auto* const lanes = fast::planned_lanes(plan);
    if (!lanes) return most + "as many as each stage's loop over bodies pays for";
    const fast::Layout& layout = lanes->layout;
    const std::size_t blocks = layout.blocks.size() - 1;
    const double ns = fast::block_cost(layout) * double(blocks);
    return std::to_string(threads_for(blocks, ns)) + " " + most + std::to_string(blocks) + " blocks, about " +
           std::to_string(std::llround(ns / 1000)) + " us of work";
}

} // namespace

template <class T> std::string explanation(const Plan<T>& plan, const std::vector<std::string>& changes) {
    const PlanAccount account = explain(plan);
    std::ostringstream text;
    text << "plan: " << plan.bodies << " bodies, " << (std::is_same_v<T, float> ? "float" : "double") << ", step "
         << plan.dt << " s, solver " << plan.stepper->kind().name;
    if (const std::string scheme = plan.stepper->kind().scheme; !scheme.empty()) text << ", scheme " << scheme;
    text << "\n";
    for (const std::string& change : changes) text << "tree changed by " << change << "\n";
    for (const PlannedStage& stage : account.stages)
        text << "stage " << stage_name(stage.stage) << (stage.on ? " on: " : " left out: ") << stage.reason << "\n";
    std::size_t used = 0, left = 0;
    for (const PlannedArray& array : account.arrays) {
        text << "array " << array.name << (array.on ? " on, " : " left out, ") << array.bytes
             << " bytes: " << array.reason << "\n";
        (array.on ? used : left) += array.bytes;
    }
    text << "constants of bodies in document order " << (plan.pose ? "on: " : "left out: ") << pose_reason(plan)
         << "\n";
    text << "constants of stresses "
         << (plan.stress_of_moment.empty() ? "left out: no output field stress" : "on: output field stress") << "\n";
    if (const auto* lanes = fast::planned_lanes(plan))
        text << "constants of rows in lanes " << sharing_text(*lanes) << "\n";
    text << "threads " << threads_text(plan) << "\n";
    text << "state: " << used << " bytes, left out " << left << " bytes\n";
    return text.str();
}

#define BOUGH_INSTANTIATE(T) template std::string explanation(const Plan<T>&, const std::vector<std::string>&);
#include "../base/instantiate.inc"

} // namespace bough
