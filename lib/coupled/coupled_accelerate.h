// coupled_accelerate.h: the coupled step's second sweep outward over lanes (coupled_sweeps.h): accelerations, and with them the step's end
// (resolvent.h). It is written a second time because the plain one goes over all bodies' arrays, while here a row's solution and motion are read
// once, and asked for a row ahead. tests/lib/coupled/lanes.cpp holds the two together.
//
// Reads   solved, now, records of accelerations of the joints that chains begin on
// Writes  next; records of accelerations of forks
// Cost    bound by memory: about 180 arithmetic instructions a row for 54 + 6 lines in and 12 out. Errors none: half turns are counted, non-finite
//         numbers flagged.
#pragma once
#include "coupled_parts.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class T> struct CoupledAccelerate : CoupledParts<T> {
    using Parts = CoupledParts<T>;
    using Parts::about_half_turn2;
    using Parts::constants;
    using Parts::fast2;
    using Parts::L;
    using Parts::mark;
    using Parts::next;
    using Parts::now;
    using Parts::number;
    using Parts::Parts;
    using Parts::rows;
    using Parts::solved_row;
    using Parts::still_finite2;
    using typename Parts::C;
    using typename Parts::W;

    [[gnu::noinline]] void turn_back(const Rows<T>& out, SweepFlags& flags, W mass) const {
        for (int l = 0; l < width<T>; ++l) {
            T v[motion::count];
            for (int k = 0; k < motion::count; ++k) v[k] = out.at[k * L + l];
            if (!(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > about_half_turn2)) continue;
            if (!rows.shorten(v + motion::theta, v + motion::theta_dot, v + motion::theta_change,
                              v + motion::theta_dot_change, rows.h))
                continue;
            if (mass[l] > 0) ++flags.half_turns;
            for (int k = 0; k < motion::count; ++k) out.at[k * L + l] = v[k];
        }
    }

    void group_accelerate(const Group& g, SweepFlags& flags) const {
        const C of_rate = number(rows.of_rate), of_angle = number(rows.of_angle);
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, accelerated::count> base;
            base.gather(rows.accelerated_records, &rows.base[g.first_base + std::size_t(lane)]);
            W sizes{};
            V3<C> alpha = base.rows().complex_vector(accelerated::alpha),
                  a = base.rows().complex_vector(accelerated::a);
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                const Rows<T> s = solved_row(row, lane);
                const T *const next_row = solved_row(row + 1, lane).at, *const next_motion = now(row + 1, lane).at;
                a = a - cross(s.vector(solved::r), alpha);
                // Column by column, with what the next row reads asked for in between.
                const auto add = [&](const V3<C>& sum, int column, const C& by) {
                    const V3<C> m = s.complex_vector(column);
                    return V3<C>{plus(sum.x, m.x, by), plus(sum.y, m.y, by), plus(sum.z, m.z, by)};
                };
                prefetch<0, 6>(next_row);
                const V3<C> EAx = s.complex_vector(solved::EA);
                V3<C> of_alpha{EAx.x * alpha.x, EAx.y * alpha.x, EAx.z * alpha.x};
                prefetch<6, 12>(next_row);
                of_alpha = add(of_alpha, solved::EA + 6, alpha.y);
                prefetch<12, 18>(next_row);
                of_alpha = add(of_alpha, solved::EA + 12, alpha.z);
                prefetch<18, 24>(next_row);
                const V3<C> EBx = s.complex_vector(solved::EB);
                V3<C> of_a{EBx.x * a.x, EBx.y * a.x, EBx.z * a.x};
                prefetch<24, 30>(next_row);
                of_a = add(of_a, solved::EB + 6, a.y);
                prefetch<30, 36>(next_row);
                of_a = add(of_a, solved::EB + 12, a.z);
                prefetch<36, 42>(next_row);
                const V3<C> gamma = s.complex_vector(solved::Eu) - of_alpha - of_a;
                alpha = alpha + gamma;
                prefetch<42, 48>(next_row);
                const V3<C> x = s.matrix(solved::rates) * gamma;
                prefetch<48, solved::count>(next_row);
                const Rows<const T> y0 = now(row, lane);
                const V3<W> theta_0 = y0.vector(motion::theta), eta_0 = y0.vector(motion::theta_dot);
                const auto weighed = [](const C& k, const V3<C>& v) {
                    return V3<W>{k.re * v.x.re - k.im * v.x.im, k.re * v.y.re - k.im * v.y.im,
                                 k.re * v.z.re - k.im * v.z.im};
                };
                V3<W> rate_change = weighed(of_rate, x), change = weighed(of_angle, x) + rows.eta * eta_0;
                const Rows<T> y1 = next(row, lane);
                if (rows.adds) {
                    rate_change = y1.vector(motion::theta_dot_change) + rate_change;
                    change = y1.vector(motion::theta_change) + change;
                }
                prefetch<0, 2 * motion::theta_dot>(next_motion);
                const V3<W> theta = theta_0 + change, eta = eta_0 + rate_change;
                y1.set(motion::theta, theta);
                y1.set(motion::theta_dot, eta);
                y1.set(motion::theta_change, change);
                y1.set(motion::theta_dot_change, rate_change);
                const W angle2 = dot(theta, theta), rate2 = dot(eta, eta);
                if (rows.ends) {
                    // The plain step looks at theta_dot at the start plus its change; this is the same, the rate at the end.
                    const bool wood = g.kind == Kind::branch;
                    if (any_above(rate2, fast2(wood))) mark(g.first_base, lane, rate2, wood, flags);
                    sizes = sizes + (angle2 + rate2);
                    if (any_above(angle2, all(about_half_turn2)))
                        turn_back(y1, flags, constants(row, lane).real(constant::mass));
                }
                if (rows.fork_of_row[row] < 0) continue;
                Records<T, accelerated::count> forks;
                for (int k = accelerated::count; k < forks.quantities; ++k) forks.rows().set(k, W{});
                forks.rows().set(accelerated::alpha, alpha);
                forks.rows().set(accelerated::a, a);
                forks.template scatter<false>(rows.accelerated_records,
                                              &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)],
                                              0);
            }
            if (!(total(sizes) < still_finite2)) flags.finite = false; // NaN if any is
        }
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
