#include "attachment_lanes.h"
#include "attachment.h"
#include "energy_guard.h"
#include <algorithm>

namespace bough::fast {
namespace {

// The last that begins at or before a row.
template <class Of> std::size_t holder(const std::vector<Of>& all, std::uint32_t row) {
    const auto after =
        std::upper_bound(all.begin(), all.end(), row, [](std::uint32_t r, const Of& one) { return r < one.first_row; });
    return std::size_t(after - all.begin()) - 1;
}

template <class T> Vec3 three(const Row<T>* rows, std::size_t lane) {
    return {double(rows[0].lane[lane]), double(rows[1].lane[lane]), double(rows[2].lane[lane])};
}

} // namespace

template <class T> void place_attached_rows(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    constexpr std::uint32_t L = Row<T>::lanes;
    const Layout& layout = own.lanes.layout;
    AttachedRows<T>& rows = work.attached;
    rows.of_row.assign(work.attachments.any() ? layout.rows : 0, -1);
    std::int32_t count = 0;
    for (AttachedBody& b : work.attachments.bodies) {
        b.slot = layout.slot[b.body];
        const std::uint32_t row = b.slot / L;
        // Blocks without rows begin where the next one does.
        b.block = std::uint32_t(holder(layout.blocks, row));
        b.base = layout.groups[holder(layout.groups, row)].first_base + b.slot % L;
        if (rows.of_row[row] < 0) rows.of_row[row] = count++;
    }
    rows.terms.assign(std::size_t(count) * inward::count, Row<T>{});
}

template <class T> void read_attached(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, bool end) {
    constexpr std::size_t L = Row<T>::lanes;
    for (AttachedBody& b : work.attachments.bodies) {
        const Block& block = own.lanes.layout.blocks[b.block];
        const CoupledPlaces places = places_of(own, work, block);
        const auto row = std::uint32_t(b.slot / L);
        const Row<T>* at = &work.lanes.table[std::size_t((end ? places.next : places.now).at(row - block.first_row))];
        const std::size_t lane = b.slot % L;
        b.now = {three(at + motion::theta, lane), three(at + motion::theta_dot, lane),
                 three(at + motion::theta_change, lane), three(at + motion::theta_dot_change, lane)};
    }
}

template <class T>
void put_attachments(const Plan<T>& plan, CoupledLanesState<T>& work, std::complex<double> p, CoupledRows<T>& to) {
    if (!work.attachments.any()) return;
    constexpr std::size_t L = Row<T>::lanes;
    AttachedRows<T>& rows = work.attached;
    for (const AttachedBody& b : work.attachments.bodies) {
        const AttachmentTerms<std::complex<T>> t = attachment_terms<std::complex<T>>(b.sums, p, plan.dt);
        Row<T>* at = &rows.terms[std::size_t(rows.of_row[b.slot / L]) * inward::count];
        const std::size_t lane = b.slot % L;
        const auto put = [&](int quantity, std::complex<T> z) {
            at[quantity].lane[lane] = z.real();
            at[quantity + 1].lane[lane] = z.imag();
        };
        int k = 0;
        for (int r = 0; r < 3; ++r)
            for (int c = r; c < 3; ++c, k += 2) {
                put(inward::A + k, t.A(r, c));
                put(inward::M + k, t.M(r, c));
            }
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 3; ++r) put(inward::B + 6 * c + 2 * r, t.B(r, c));
            put(inward::N + 2 * c, t.N[c]);
            put(inward::F + 2 * c, t.F[c]);
        }
    }
    to.attached_of_row = rows.of_row.data();
    to.attached = rows.terms.front().lane;
}

template <class T>
void book_attachments(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    constexpr std::size_t L = Row<T>::lanes;
    for (const Attached& held : work.attachments.all) {
        const AttachedBody& b = work.attachments.bodies[held.at];
        const std::uint32_t tree = own.lanes.layout.tree[b.base];
        work.account[tree].gained -= std::max(0.0, held.work);
        if (is_end(plan, held.body)) work.lanes.energy_fast[b.slot / L].lane[b.slot % L] = 1;
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void place_attached_rows(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);                              \
    template void read_attached(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, bool);                              \
    template void put_attachments(const Plan<T>&, CoupledLanesState<T>&, std::complex<double>, CoupledRows<T>&);       \
    template void book_attachments(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough::fast
