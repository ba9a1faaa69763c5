// shared_constants.h: the rows of constants (coupled_rows.h, analytic_rows.h). There is a row for each row of the layout or, in a scene in which one
// tree stands at many places, one for all rows that are equal byte for byte.
//
// Each stand is laid out by itself (layout.h): two stands of the same trees hold the same bodies in the same lanes in the same order. They differ in
// the roots' rows, which have place and yaw, and in what the scene changes of one of them (its wood). Sharing goes by content, so it need know
// nothing of that and cannot be wrong. A table says which row of the constants a row of the layout reads (PlannedSharing::row). Sweeps look it up, a
// load a row among some thousand instructions. What they read is the same to the last bit.
//
// A scene pays for this only where two of its trees may be instances of one. Else there is no table, and nothing is hashed or compared. Rows are not
// shared with /fracture, which changes the constants of single bodies as they break off (clear_lanes.h).
//
// In double, trees under different yaws share almost nothing where gravity acts and `pose` is not `rest`: the start (pose.h) is found in the world's
// axes, and its last digits differ. In float they are rounded away, except for about one number in 10^8.
//
// Cost O(rows): a row is put together in the cache, hashed, and compared with the one that it may equal. There are never more rows in memory than are
// different.
#pragma once
#include "../base/parallel.h"
#include "../model/scene.h"
#include "lane_memory.h"
#include "lanes.h"
#include <unordered_map>

namespace bough::fast {

// Returns "" if two trees may be instances of one: they have as many bodies and, where the scene names files, one file.
std::string reason_against_sharing(const Scene&, const std::vector<TreeRange>&);

// Returns how many rows of constants there are, where rows share them; 0: they do not. O(rows).
template <class T> std::size_t shared_rows(const PlannedLanes<T>&);

// Takes rows one after another, as they come in the layout, and keeps each that is not yet there.
template <class T> class SharedRows {
public:
    // quantities: of a row.
    SharedRows(PlannedLanes<T>& lanes, int quantities);
    void add(const Row<T>* row);
    // Called when all have come. Where no two were equal there is no table; the plan says so.
    void finish();

private:
    PlannedLanes<T>& lanes_;
    std::size_t quantities_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> known_; // by hash
};

// Fills in lanes.constants as lanes.sharing asks. pad(slot) fills in a lane without a body, body(i, slot) that of body i; all is zero before. Rows
// that are not shared are filled in by several threads.
template <class T, class Pad, class Body>
void fill_constants(PlannedLanes<T>& lanes, int quantities, const Pad& pad, const Body& body) {
    constexpr std::size_t L = Row<T>::lanes;
    const std::vector<std::int32_t>& bodies = lanes.layout.body;
    const auto put = [&](std::size_t slot, const Slot<T>& at) {
        if (bodies[slot] < 0)
            pad(at);
        else
            body(std::size_t(bodies[slot]), at);
    };
    if (!lanes.sharing.on) {
        set_zero_rows(lanes.constants, lanes.layout.rows * std::size_t(quantities));
        parallel_for(lanes.layout.rows, 1000, [&](std::size_t row) {
            for (std::size_t slot = row * L; slot < (row + 1) * L; ++slot)
                put(slot, Slot<T>(lanes.constants, quantities, slot));
        });
        return;
    }
    SharedRows<T> shared(lanes, quantities);
    RowVector<T> row;
    for (std::size_t slot = 0; slot < bodies.size(); slot += L) {
        row.assign(std::size_t(quantities), Row<T>{});
        for (std::size_t lane = 0; lane < L; ++lane) put(slot + lane, Slot<T>(row, quantities, lane));
        shared.add(row.data());
    }
    shared.finish();
}

} // namespace bough::fast
