#include "attachment_lanes.h"
#include "attachment.h"
#include "attachment_ties.h"
#include "energy_guard.h"
#include <algorithm>
#include <numbers>

namespace bough::fast {
namespace {

constexpr int inverse_count = 12; // a complex symmetric matrix

// The last that begins at or before a row.
template <class Of> std::size_t holder(const std::vector<Of>& all, std::uint32_t row) {
    const auto after =
        std::upper_bound(all.begin(), all.end(), row, [](std::uint32_t r, const Of& one) { return r < one.first_row; });
    return std::size_t(after - all.begin()) - 1;
}

template <class T> Vec3 three(const Row<T>* rows, std::size_t lane) {
    return {double(rows[0].lane[lane]), double(rows[1].lane[lane]), double(rows[2].lane[lane])};
}

// The sweep outward has taken joints past half a turn the shorter way round (half_turn.h), and what they changed by in the step with it: as the
// solve had it, again.
void turn_on(const JointNow& before, JointNow& now) {
    if (!now.eta_change.isZero(0) || !(now.theta.norm() > 0)) return;
    const Vec3 other_way = (1 - 2 * std::numbers::pi / now.theta.norm()) * now.theta;
    if (!((other_way - before.theta).norm() < (now.theta - before.theta).norm())) return;
    now.eta = body_rate_jacobian_inverse(other_way) * (body_rate_jacobian(now.theta) * now.eta);
    now.theta = other_way;
    now.theta_change = now.theta - before.theta;
    now.eta_change = now.eta - before.eta;
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
    rows.inverses.assign(work.attachments.ties.empty() ? 0 : std::size_t(count) * inverse_count, Row<T>{});
}

template <class T> void read_attached(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, bool end) {
    constexpr std::size_t L = Row<T>::lanes;
    for (AttachedBody& b : work.attachments.bodies) {
        const Block& block = own.lanes.layout.blocks[b.block];
        const CoupledPlaces places = places_of(own, work, block);
        const auto row = std::uint32_t(b.slot / L);
        const Row<T>* at = &work.lanes.table[std::size_t((end ? places.next : places.now).at(row - block.first_row))];
        const std::size_t lane = b.slot % L;
        const JointNow before = b.now;
        b.now = {three(at + motion::theta, lane), three(at + motion::theta_dot, lane),
                 three(at + motion::theta_change, lane), three(at + motion::theta_dot_change, lane)};
        if (end) turn_on(before, b.now);
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
    if (!rows.inverses.empty()) to.inverses = rows.inverses.front().lane;
}

template <class T>
void tie_in_lanes(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work,
                  std::complex<double> p) {
    Attachments& a = work.attachments;
    if (a.ties.empty()) return;
    constexpr std::uint32_t L = Row<T>::lanes;
    const auto solved_at = [&](const AttachedBody& b) {
        const Block& block = own.lanes.layout.blocks[b.block];
        return &work.lanes.table[std::size_t(places_of(own, work, block).solved.at(b.slot / L - block.first_row))];
    };
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        const AttachedBody& b = a.bodies[i];
        SolvedBody& q = a.solved[i];
        const std::size_t lane = b.slot % L;
        const auto number = [lane](const Row<T>* rows, int quantity) {
            return std::complex<double>(rows[quantity].lane[lane], rows[quantity + 1].lane[lane]);
        };
        const Row<T>* const solved = solved_at(b);
        const Row<T>* const inverse =
            &work.attached.inverses[std::size_t(work.attached.of_row[b.slot / L]) * inverse_count];
        int next = 0;
        for (int r = 0; r < 3; ++r)
            for (int c = r; c < 3; ++c, next += 2) q.E(r, c) = q.E(c, r) = number(inverse, next);
        for (int r = 0; r < 3; ++r) {
            q.Eu[r] = number(solved, solved::Eu + 2 * r);
            for (int c = 0; c < 3; ++c) {
                q.EA(r, c) = number(solved, solved::EA + 6 * c + 2 * r);
                q.EB(r, c) = number(solved, solved::EB + 6 * c + 2 * r);
            }
        }
    }
    solve_ties(plan, work, p);
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        const AttachedBody& b = a.bodies[i];
        Row<T>* const solved = solved_at(b);
        for (int r = 0; r < 3; ++r) {
            solved[solved::Eu + 2 * r].lane[b.slot % L] += T(a.solved[i].gain[r].real());
            solved[solved::Eu + 2 * r + 1].lane[b.slot % L] += T(a.solved[i].gain[r].imag());
        }
    }
}

template <class T>
void book_attachments(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    constexpr std::size_t L = Row<T>::lanes;
    const auto book = [&](const AttachedEnd& end, double done) {
        const AttachedBody& b = work.attachments.bodies[end.at];
        work.account[own.lanes.layout.tree[b.base]].gained -= std::max(0.0, done);
        if (is_end(plan, end.body)) work.lanes.energy_fast[b.slot / L].lane[b.slot % L] = 1;
    };
    for (const Attached& held : work.attachments.all) {
        book(held, held.work);
        if (held.far) book(*held.far, held.far_work);
    }
    for (const PulledPoint& point : work.attachments.pulled)
        if (point.turns) book(point, point.work);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void place_attached_rows(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);                              \
    template void read_attached(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, bool);                              \
    template void tie_in_lanes(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&,                      \
                               std::complex<double>);                                                                  \
    template void put_attachments(const Plan<T>&, CoupledLanesState<T>&, std::complex<double>, CoupledRows<T>&);       \
    template void book_attachments(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
