#include "sleep.h"
#include "../plan/attachment_course.h"
#include "../plan/pushes.h"
#include "coupled_tables.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bough::fast {
namespace {

constexpr double settled_time = 1;   // [s] below the rate before a block sleeps
constexpr double settled_steps = 10; // and so many steps, which something at rest takes to be seen moving
constexpr double carried_time = 10;  // [s] of the rate that what carries sleepers may turn by

template <class T> std::string reason_against(const Plan<T>& plan, const CoupledLanesPlan<T>& own) {
    const Scene& scene = plan.scene;
    // What a sleeper hands inward would be one record a pole.
    if (scheme_of(own.scheme).poles > 1) return std::string("scheme ") + scheme_of(own.scheme).name;
    if (scene.wind && scene.wind->turbulence > 0) return "/wind/turbulence";
    if (scene.wind && scene.wind->gust_factor > 1) return "/wind/gust_factor";
    if (scene.wind && !steady(*scene.wind)) {
        Wind without = *scene.wind;
        without.swirl.reset();
        return steady(without) ? "/wind/swirl" : "/wind/grid";
    }
    if (!scene.root_motion.empty()) return "/root_motion";
    if (plan.pairs) return "/attachments with another body";
    if (!plan.followers.empty()) return "/pulls in bodies' axes";
    if (has_free_bodies(scene)) return free_part(scene); // whatever breaks, hits or treads would have to wake it
    if (plan.loads) return "forces of the caller";       // likewise
    return {};
}

// Of what this step and the last one are loaded with (coupled_lanes_step.cpp, rows_of).
bool changes(const Pull& pull, double time, double h) {
    const Vec3 now = pull_force(pull, time);
    for (const double t : {time - h, time - h / 2, time + h / 2, time + h})
        if (now != pull_force(pull, t)) return true;
    return false;
}

bool empty(const Block& block) {
    return block.first_row == block.end_row;
}

// On the top, directly or not.
bool carried(const Block& block) {
    return !block.whole && !empty(block);
}

// At the step's end.
template <class T>
void set_rates_to_zero(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, const Block& block) {
    const Run next = places_of(own, work, block).next;
    for (std::uint32_t k = 0; k < block.end_row - block.first_row; ++k)
        std::fill_n(work.lanes.table.begin() + next.at(k) + motion::theta_dot, motion::count - motion::theta_dot,
                    Row<T>{});
}

// A port's record stands for its block until it wakes; awake, the block adds to it anew.
template <class LanesType> auto port_record(LanesType& lanes, std::uint32_t joint) {
    auto& rows = lanes.inward;
    auto* const first = rows.front().lane;
    return first + joint * record(inward::count, int(std::size(rows.front().lane)));
}
template <class Visit>
void visit_ports(const PlannedSleep& sleep, const Layout& layout, std::size_t block, Visit&& visit) {
    for (std::size_t p = 0; p < layout.ports.size(); ++p)
        if (sleep.block_of_port[p] == block) visit(layout.ports[p].joint);
}

template <class T> void wake(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, std::size_t b) {
    BlockRest& rest = work.lanes.rest[b];
    if (rest.rest != Rest::awake)
        visit_ports(own.lanes.sleep, own.lanes.layout, b, [&](std::uint32_t joint) {
            std::fill_n(port_record(work.lanes, joint), int(inward::count), T(0));
        });
    rest = {};
}

} // namespace

std::uint32_t steps_to_settle(double dt) {
    return std::uint32_t(std::max(settled_steps, std::ceil(settled_time / dt)));
}

template <class T> void plan_sleep(const Plan<T>& plan, CoupledLanesPlan<T>& own, double rate) {
    PlannedSleep& sleep = own.lanes.sleep;
    sleep.reason = rate > 0 ? reason_against(plan, own) : "not asked for";
    sleep.on = sleep.reason.empty();
    if (!sleep.on) return;
    sleep.rate = rate;
    sleep.steps = steps_to_settle(plan.dt);
    const Layout& layout = own.lanes.layout;
    sleep.block_of_port.resize(layout.ports.size());
    std::vector<std::uint32_t> block_of_row(layout.rows);
    for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
        const Block& block = layout.blocks[b];
        std::fill(block_of_row.begin() + block.first_row, block_of_row.begin() + block.end_row, std::uint32_t(b));
        const auto first = layout.body.begin() + std::ptrdiff_t(block.first_row) * layout.lanes,
                   end = layout.body.begin() + std::ptrdiff_t(block.end_row) * layout.lanes;
        sleep.bodies.push_back(std::uint32_t(std::count_if(first, end, [](std::int32_t body) { return body >= 0; })));
    }
    for (std::size_t b = 1; b < layout.blocks.size(); ++b)
        for (std::uint32_t g = layout.blocks[b].first_group; g < layout.blocks[b].end_group; ++g)
            for (int lane = 0; lane < layout.lanes; ++lane) {
                const std::uint32_t joint = layout.landing[layout.groups[g].first_base + std::size_t(lane)];
                const std::uint32_t first = layout.joints - std::uint32_t(layout.ports.size()); // ports come last
                if (joint != nothing && joint >= first) sleep.block_of_port[joint - first] = std::uint32_t(b);
            }
    for (const PlannedPull<T>& pull : plan.pulls)
        sleep.block_of_pull.push_back(block_of_row[layout.slot[pull.body] / std::uint32_t(layout.lanes)]);
}

template <class T>
void wake_blocks(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state, CoupledLanesState<T>& work,
                 double time) {
    const PlannedSleep& sleep = own.lanes.sleep;
    if (!sleep.on) return;
    const std::vector<Block>& blocks = own.lanes.layout.blocks;
    std::vector<BlockRest>& rest = work.lanes.rest;
    for (std::size_t k = 0; k < sleep.block_of_pull.size(); ++k)
        if (changes(plan.scene.pulls[plan.pulls[k].source], time, plan.dt)) wake(own, work, sleep.block_of_pull[k]);
    for (const Attached& held : work.attachments.all)
        if (changes(plan, held, time)) wake(own, work, work.attachments.bodies[held.at].block);
    BlockRest& top = rest[0];
    for (std::size_t b = 1; b < blocks.size(); ++b)
        if (carried(blocks[b]) && rest[b].rest == Rest::awake) top.rest = Rest::awake;
    if (top.settled < sleep.steps)
        for (std::size_t b = 1; b < blocks.size(); ++b)
            if (carried(blocks[b]) && rest[b].rest != Rest::awake) wake(own, work, b);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (rest[b].rest == Rest::asleep) state.flags.asleep += sleep.bodies[b];
}

template <class T> void wake_all(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    for (std::size_t b = 0; b < work.lanes.rest.size(); ++b) wake(own, work, b);
    work.lanes.carried_turn = 0;
}

template <class T>
void rest_blocks(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work,
                 const std::vector<SweepFlags>& met) {
    const PlannedSleep& sleep = own.lanes.sleep;
    if (!sleep.on) return;
    const std::vector<Block>& blocks = own.lanes.layout.blocks;
    Lanes<T>& lanes = work.lanes;
    const double most = sleep.rate * sleep.rate;
    bool all_asleep = true, some_rest = false; // of what the top carries
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        BlockRest& block = lanes.rest[b];
        if (block.rest != Rest::awake) continue;
        // A block that holds nothing is at rest for ever.
        if (empty(blocks[b]) || met[b].omega2 < most)
            block.settled = std::min(block.settled + 1, sleep.steps);
        else
            block.settled = 0;
    }
    BlockRest& top = lanes.rest[0];
    for (std::size_t b = 1; b < blocks.size(); ++b) {
        BlockRest& block = lanes.rest[b];
        if (block.rest == Rest::settling) block.rest = Rest::asleep;
        const bool ready = block.settled >= sleep.steps && (blocks[b].whole || top.settled >= sleep.steps);
        if (block.rest == Rest::awake && ready) {
            block.rest = Rest::settling;
            set_rates_to_zero(own, work, blocks[b]);
        }
        if (!carried(blocks[b])) continue;
        all_asleep = all_asleep && block.rest == Rest::asleep;
        some_rest = some_rest || block.rest != Rest::awake;
    }
    lanes.carried_turn =
        some_rest && top.rest == Rest::awake ? lanes.carried_turn + std::sqrt(met[0].omega2) * plan.dt : 0;
    if (lanes.carried_turn > carried_time * sleep.rate) top.settled = 0; // wakes what it carries
    if (top.rest == Rest::settling) top.rest = Rest::asleep;
    if (top.rest == Rest::awake && top.settled >= sleep.steps && all_asleep) {
        top.rest = Rest::settling;
        set_rates_to_zero(own, work, blocks[0]);
    }
}

template <class T> void keep_motion(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, const Block& block) {
    const CoupledPlaces places = places_of(own, work, block);
    const auto table = work.lanes.table.begin();
    for (std::uint32_t k = 0; k < block.end_row - block.first_row; ++k)
        std::copy_n(table + places.now.at(k), int(motion::count), table + places.next.at(k));
}

template <class T> std::vector<double> saved_sleep(const CoupledLanesPlan<T>& own, const CoupledLanesState<T>& work) {
    const Layout& layout = own.lanes.layout;
    const Lanes<T>& lanes = work.lanes;
    std::vector<double> saved;
    if (std::none_of(lanes.rest.begin(), lanes.rest.end(), [](const BlockRest& r) { return r.settled > 0; }))
        return saved;
    saved.push_back(lanes.carried_turn);
    for (const BlockRest& rest : lanes.rest) {
        saved.push_back(double(rest.rest));
        saved.push_back(rest.settled);
    }
    for (std::size_t b = 1; b < layout.blocks.size(); ++b)
        if (lanes.rest[b].rest == Rest::asleep)
            visit_ports(own.lanes.sleep, layout, b, [&](std::uint32_t joint) {
                const T* record = port_record(lanes, joint);
                saved.insert(saved.end(), record, record + inward::count);
            });
    return saved;
}

template <class T>
void restore_sleep(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, const std::vector<double>& saved) {
    if (saved.empty()) return;
    const Layout& layout = own.lanes.layout;
    Lanes<T>& lanes = work.lanes;
    std::size_t next = 0;
    const auto take = [&] {
        if (next == saved.size())
            throw std::invalid_argument("has " + std::to_string(saved.size()) + " numbers, this run needs more");
        return saved[next++];
    };
    if (lanes.rest.empty()) throw std::invalid_argument("is there, but in this run nothing sleeps");
    lanes.carried_turn = take();
    if (!(lanes.carried_turn >= 0 && lanes.carried_turn <= carried_time * own.lanes.sleep.rate))
        throw std::invalid_argument("number 0 is no angle from 0 to " + std::to_string(carried_time) +
                                    " s of this run's rate");
    for (BlockRest& rest : lanes.rest) {
        const double phase = take(), settled = take();
        if (!(phase == 0 || phase == 1 || phase == 2))
            throw std::invalid_argument("number " + std::to_string(next - 2) + " is none of 0, 1, 2");
        if (!(settled >= 0 && settled <= own.lanes.sleep.steps && settled == std::floor(settled)))
            throw std::invalid_argument("number " + std::to_string(next - 1) + " is no count of steps up to " +
                                        std::to_string(own.lanes.sleep.steps));
        if (phase != 0 && settled != own.lanes.sleep.steps)
            throw std::invalid_argument("number " + std::to_string(next - 1) + " is " + std::to_string(settled) +
                                        " steps, but its block rests, which takes " +
                                        std::to_string(own.lanes.sleep.steps));
        rest = {std::uint32_t(settled), Rest(int(phase))};
    }
    for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
        if (lanes.rest[b].rest != Rest::asleep) continue;
        keep_motion(own, work, layout.blocks[b]);
        if (b == 0) continue;
        visit_ports(own.lanes.sleep, layout, b, [&](std::uint32_t joint) {
            T* record = port_record(lanes, joint);
            for (int k = 0; k < inward::count; ++k) {
                record[k] = T(take());
                if (!std::isfinite(record[k]))
                    throw std::invalid_argument("number " + std::to_string(next - 1) +
                                                " is more than this precision holds");
            }
        });
    }
    if (next != saved.size())
        throw std::invalid_argument("has " + std::to_string(saved.size()) + " numbers, this run needs " +
                                    std::to_string(next));
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void plan_sleep(const Plan<T>&, CoupledLanesPlan<T>&, double);                                            \
    template void wake_all(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);                                         \
    template void wake_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&, double);   \
    template void rest_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&,                       \
                              const std::vector<SweepFlags>&);                                                         \
    template void keep_motion(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&);                        \
    template std::vector<double> saved_sleep(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&);                 \
    template void restore_sleep(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const std::vector<double>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
