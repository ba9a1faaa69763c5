#include "energy_lanes.h"
#include "../base/parallel.h"
#include "attachment_lanes.h"
#include "coupled_tables.h"
#include "coupled_targets.h"
#include "energy_guard.h"

namespace bough::fast {
namespace {

// Which trees a fast body belongs to, and which blocks have part in one.
template <class T> const std::vector<std::uint8_t>& watch(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    const Layout& layout = own.lanes.layout;
    for (EnergyAccount& account : work.account) account = {};
    for (std::size_t k = 0; k < layout.tree.size(); ++k) {
        if (!work.lanes.watched[k] || layout.tree[k] == nothing) continue;
        const std::uint32_t ground = layout.ground[layout.tree[k]];
        if (ground != 0 && turns(&work.ground[ground - 1])) continue;
        EnergyAccount& account = work.account[layout.tree[k]];
        account.watched = true;
        account.wood = account.wood || (work.lanes.watched[k] & 1);
    }
    std::vector<std::uint8_t>& blocks = work.lanes.weighed;
    blocks.assign(layout.blocks.size(), 0);
    for (std::size_t b = 0; b < layout.blocks.size(); ++b)
        for (std::uint32_t g = layout.blocks[b].first_group; g < layout.blocks[b].end_group && !blocks[b]; ++g)
            for (std::size_t l = 0; l < std::size_t(layout.lanes); ++l) {
                const std::uint32_t tree = layout.tree[layout.groups[g].first_base + l];
                if (tree != nothing && work.account[tree].watched) blocks[b] = 1;
            }
    return blocks;
}

template <class T> EnergyRows<T> make_room(const Plan<T>& plan, const CoupledLanesPlan<T>& own, Lanes<T>& lanes) {
    const Layout& layout = own.lanes.layout;
    if (lanes.energy_records.empty()) {
        const std::size_t size = record(energy::count, Row<T>::lanes);
        set_zero_rows(lanes.energy_records, layout.joints * size / Row<T>::lanes);
        lanes.energy_sums.resize(layout.base.size() / Row<T>::lanes * energy::sums);
        lanes.energy_fast.resize(layout.rows);
        T* rest = lanes.energy_records.front().lane; // the resting ground: no turn, no motion
        for (const int R : {int(energy::start), int(energy::end), int(energy::R)})
            for (int k = 0; k < 3; ++k) rest[R + 4 * k] = 1;
        if (plan.root_motion) set_zero_rows(lanes.energy_ground, layout.base.size() / Row<T>::lanes * 6);
    }
    return {lanes.energy_records.front().lane, lanes.energy_sums.front().lane, lanes.energy_fast.front().lane,
            lanes.energy_ground.empty() ? nullptr : lanes.energy_ground.front().lane};
}

// The moved grounds as the step takes them: their records, and what each lane's is.
template <class T> void place_grounds(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    const Layout& layout = own.lanes.layout;
    constexpr std::size_t L = Row<T>::lanes;
    const std::size_t size = record(energy::count, int(L));
    T* records = work.lanes.energy_records.front().lane;
    for (std::size_t joint = 1; joint < layout.grounds; ++joint) {
        const GroundStep<T>& g = work.ground[joint - 1];
        T* at = records + joint * size;
        for (int k = 0; k < 9; ++k) // by columns, as Eigen has them
            at[energy::start + k] = at[energy::end + k] = at[energy::R + k] = g.R.data()[k];
        at[energy::x] = g.x.x();
        at[energy::y] = g.x.y();
        at[energy::z] = g.x.z();
        for (int k = 0; k < 3; ++k) {
            at[energy::omega + k] = g.omega[k];
            at[energy::v + k] = g.v[k];
        }
    }
    T* lanes = work.lanes.energy_ground.front().lane;
    for (std::size_t k = 0; k < layout.tree.size(); ++k) {
        if (layout.tree[k] == nothing) continue;
        const std::uint32_t joint = layout.ground[layout.tree[k]];
        if (joint == 0) continue;
        const GroundStep<T>& g = work.ground[joint - 1];
        const Vector3<T> carried = carried_by(g, T(plan.dt));
        T* at = lanes + k / L * L * 6 + k % L;
        for (std::size_t j = 0; j < 3; ++j) {
            at[j * L] = carried[Eigen::Index(j)];
            at[(3 + j) * L] = g.a[Eigen::Index(j)];
        }
    }
}

// A group's bodies: the rates of those that their tree's account, or their own, takes from.
template <class T>
std::uint64_t scale(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, const Block& block,
                    const Group& g) {
    constexpr std::size_t L = Row<T>::lanes;
    const Layout& layout = own.lanes.layout;
    const T h = T(plan.dt);
    const Run next = places_of(own, work, block).next;
    std::uint64_t count = 0;
    for (std::size_t l = 0; l < L; ++l) {
        const std::uint32_t tree = layout.tree[g.first_base + l];
        if (tree == nothing) continue;
        const EnergyAccount& account = work.account[tree];
        if (!account.watched) continue;
        for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
            const T said = work.lanes.energy_fast[row].lane[l]; // of ends of branches, what is kept
            const double keep = g.kind != Kind::branch ? double(said) * account.keep_slow
                                : said > 0             ? account.keep_fast
                                                       : account.keep_slow;
            if (!(keep < 1) || layout.body[row * L + l] < 0) continue;
            Row<T>* motion = &work.lanes.table[std::size_t(next.at(row - block.first_row))];
            for (std::size_t k = 0; k < 3; ++k) {
                T& rate = motion[motion::theta_dot + k].lane[l];
                rate *= T(keep);
                motion[motion::theta_change + k].lane[l] = h * rate;
                motion[motion::theta_dot_change + k].lane[l] = 0;
            }
            ++count;
        }
    }
    return count;
}

} // namespace

template <class T>
void guard_lanes(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state, CoupledLanesState<T>& work,
                 const CoupledRows<T>& rows) {
    const Layout& layout = own.lanes.layout;
    const std::vector<std::uint8_t>& blocks = watch(own, work);
    const EnergyRows<T> energies = make_room(plan, own, work.lanes);
    if (plan.root_motion) place_grounds(plan, own, work);
    const EnergySweepOf<T> weigh = energy_sweep_for<T>(own.lanes.target, sweep_loads(plan));
    const auto weigh_block = [&](const Block& block) {
        CoupledRows<T> mine = rows;
        place_block(own, work, block, mine);
        weigh(mine, energies, block);
    };
    if (blocks[0]) weigh_block(layout.blocks[0]);
    const double part = double(std::count(blocks.begin(), blocks.end(), 1)) / double(blocks.size());
    parallel_blocks(layout.blocks.size() - 1, block_cost(layout) * part / 4, [&](std::size_t k, int) {
        if (blocks[1 + k]) weigh_block(layout.blocks[1 + k]);
    });
    constexpr std::size_t L = Row<T>::lanes;
    for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
        if (!blocks[b]) continue;
        for (std::uint32_t k = layout.blocks[b].first_group; k < layout.blocks[b].end_group; ++k)
            for (std::size_t l = 0; l < L; ++l) {
                const std::uint32_t base = layout.groups[k].first_base;
                const std::uint32_t tree = layout.tree[base + l];
                if (tree == nothing || !work.account[tree].watched) continue;
                const T* sum = energies.sums + base * std::size_t(energy::sums) + l;
                EnergyAccount& account = work.account[tree];
                account.kinetic += double(sum[energy::kinetic * L]);
                account.gained += double(sum[energy::gained * L]);
                account.slow += double(sum[energy::slow * L]);
                account.mixed += double(sum[energy::mixed * L]);
                account.fast += double(sum[energy::fast * L]);
            }
    }
    book_attachments(plan, own, work);
    for (EnergyAccount& account : work.account)
        if (account.watched) settle(account, plan.foliage);
    for (std::size_t b = 0; b < layout.blocks.size(); ++b)
        if (blocks[b])
            for (std::uint32_t k = layout.blocks[b].first_group; k < layout.blocks[b].end_group; ++k)
                state.flags.energy_guard += scale(plan, own, work, layout.blocks[b], layout.groups[k]);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void guard_lanes(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&,            \
                              const CoupledRows<T>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
