// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "coupled_sweeps.h"
#include "coupled_accelerate.h"
#include "coupled_in.h"
#include "coupled_out.h"
#include <algorithm>

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

template <class T, bool field = false> struct Sweep {
    static constexpr int L = lanes<T>;
    const CoupledRows<T>& rows;
    const CoupledOut<T, field> out{rows};
    const CoupledIn<T> in{rows};

    static std::size_t first_loaded(const Block& block, const Group& g) {
        return std::size_t(g.first_row - block.first_row) * loaded::count * L;
    }

    template <bool wind, bool gravity> void block_out(const Block& block, T* scratch, SweepFlags& flags) const {
        T* forks = rows.inward_records + block.first_fork * record(inward::count, L);
        std::memset(forks, 0, (block.end_fork - block.first_fork) * record(inward::count, L) * sizeof(T));
        for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
            const Group& g = rows.groups[k];
            // A terminal group is done with before the next one begins: all of them take the same place.
            T* loaded_rows = scratch + first_loaded(block, rows.groups[std::min(k, block.terminal_group)]);
            if constexpr (!wind)
                out.template group_out<wind, gravity, Kind::branch>(g, loaded_rows, flags);
            else if (g.kind == Kind::branch)
                out.template group_out<wind, gravity, Kind::branch>(g, loaded_rows, flags);
            else if (stands_for_many(g.kind) && rows.facing)
                out.template group_out<wind, gravity, Kind::clump>(g, loaded_rows, flags);
            else if (!is_flat(g.kind))
                out.template group_out<wind, gravity, Kind::fruit>(g, loaded_rows, flags);
            else
                out.template group_out<wind, gravity, Kind::leaf>(g, loaded_rows, flags);
            if (k >= block.terminal_group) in.template group_in<wind, gravity>(g, loaded_rows);
        }
    }

    template <bool wind, bool gravity> void block_in(const Block& block, const T* scratch) const {
        for (std::uint32_t k = block.terminal_group; k-- > block.first_group;)
            in.template group_in<wind, gravity>(rows.groups[k], scratch + first_loaded(block, rows.groups[k]));
    }
};

template <class T, bool wind, bool gravity, bool field = false>
void outward_sweep(const CoupledRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
    const FlushToZero flush;
    Sweep<T, field>{rows}.template block_out<wind, gravity>(block, scratch, flags);
}
template <class T, bool wind, bool gravity>
void inward_sweep(const CoupledRows<T>& rows, const Block& block, const T* scratch) {
    const FlushToZero flush;
    Sweep<T>{rows}.template block_in<wind, gravity>(block, scratch);
}
template <class T> void accelerate_sweep(const CoupledRows<T>& rows, const Block& block, SweepFlags& flags) {
    const FlushToZero flush;
    const CoupledAccelerate<T> sweep(rows);
    for (std::uint32_t k = block.first_group; k < block.end_group; ++k) sweep.group_accelerate(rows.groups[k], flags);
}

} // namespace

template <class T> CoupledSweeps<T> coupled_sweeps(SweepLoads loads) {
    if (loads.field) return {outward_sweep<T, true, true, true>, inward_sweep<T, true, true>, accelerate_sweep<T>};
    if (loads.wind)
        return loads.gravity
                   ? CoupledSweeps<T>{outward_sweep<T, true, true>, inward_sweep<T, true, true>, accelerate_sweep<T>}
                   : CoupledSweeps<T>{outward_sweep<T, true, false>, inward_sweep<T, true, false>, accelerate_sweep<T>};
    return loads.gravity
               ? CoupledSweeps<T>{outward_sweep<T, false, true>, inward_sweep<T, false, true>, accelerate_sweep<T>}
               : CoupledSweeps<T>{outward_sweep<T, false, false>, inward_sweep<T, false, false>, accelerate_sweep<T>};
}

template CoupledSweeps<float> coupled_sweeps(SweepLoads);
template CoupledSweeps<double> coupled_sweeps(SweepLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
