// coupled_in.h: the coupled step's sweep inward over lanes (coupled_sweeps.h): the elimination of resolvent.h joint by joint, and what is handed on
// to the carrying body. It is written a second time because a row hands on to the next in registers, symmetric matrices are kept as their halves, and
// what is solved goes past the caches where it is read only after the whole sweep. tests/lib/coupled/lanes.cpp holds the two together.
//
// Reads   loaded, mass, beta, records inward of forks, attached
// Writes  of solved Eu, EA, EB; adds to the records inward where chains land
// Cost    about 930 arithmetic instructions a row (AVX-512) among 1300. Errors none.
// Tried on the three sweeps, time against the one before (float, gusty, one thread, AVX-512; good to about 3 %):
//   products written so that each fuses, the profile looked up in all lanes     1 000 bodies 0.88, 100 000 0.96
//   eliminated column by column, the inverse scaled by the body's own numbers   0.98, 0.94
//   rates kept where the last sweep reads them, at once                         10 000 0.96, 100 000 1.00
//   terminal groups take one place in the cache                                 1.00, 0.975
//   no solutions past the caches                                                10 000 0.81, 100 000 0.93, 1 000 000 1.45: hence streams() of
//                                                                               coupled_tables.h
//   next rows asked for among the arithmetic, not all at once                   10 000 0.98, 100 000 0.94, 1 000 000 0.84
//   what is carried, and a body's frame, in memory (step_in)                    10 000 0.92, 1 000 000 0.92
//   own B made while E is on its way                                            10 000 0.98, 1 000 000 0.98
//   few terms of the joint's maps up to one radian                              10 000 0.98, 1 000 000 0.97
//   not kept: motions past the caches 1.03, 1 000 000 0.97; other prefetches or none 1.00 to 1.04; joints' records prefetched 1.02; -O2 1.42
#pragma once
#include "coupled_parts.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class T> struct CoupledIn : CoupledParts<T> {
    using Parts = CoupledParts<T>;
    using Parts::constants;
    using Parts::L;
    using Parts::number;
    using Parts::Parts;
    using Parts::rows;
    using Parts::solved_row;
    using typename Parts::C;
    using typename Parts::W;

    // Selects A, B, M, N and F of what a joint carries: nothing where its bodies are tips.
    template <bool tip, class X> BOUGH_FORCE static X came(const X& carried) {
        if constexpr (tip)
            return X{};
        else
            return carried;
    }
    static void add_carried(const Rows<T>& sum, const Rows<T>& more) {
        for (int k = 0; k < inward::count; ++k) sum.set(k, sum.real(k) + more.real(k));
    }

    // Returns A: the body's own, and what came (resolvent.cpp, start).
    template <bool wind, bool gravity, bool tip>
    BOUGH_FORCE Symmetric<C> whole_A(const Rows<T>& q, const Rows<const T>& in, const C& s1, const C& s2,
                                     const V3<W>& c) const {
        const Symmetric<W> J = in.symmetric(loaded::J);
        Symmetric<C> A = came<tip>(q.complex_symmetric(inward::A));
        A = {A.xx + J.xx, A.xy + J.xy, A.xz + J.xz, A.yy + J.yy, A.yz + J.yz, A.zz + J.zz};
        if constexpr (gravity || wind) A = plus(A, s2, in.symmetric(loaded::H));
        if constexpr (wind)
            A = plus(A, s1, upper(cross_left(c, transposed(cross_left(c, full(in.symmetric(loaded::D)))))));
        return A;
    }
    // E = (A + Z)^-1
    BOUGH_FORCE static Symmetric<C> inverse_of(const Symmetric<C>& A, const Rows<const T>& in, const C& z) {
        const Symmetric<W> J = in.symmetric(loaded::J), K = in.symmetric(loaded::K);
        const W size = J.xx + J.yy + J.zz + (magnitude(z.re) + magnitude(z.im)) * (K.xx + K.yy + K.zz);
        return inverse(plus(A, z, K), W(1 / size));
    }

    // Used for attachments between bodies (attachment_ties.h), before step_in, which computes the inverse a second time: 1 % of a step with three
    // ties. An inverse kept from within step_in would round otherwise for every tree in wind.
    template <bool wind, bool gravity>
    [[gnu::noinline]] void keep_inverse(const Rows<T>& q, std::uint32_t row, int lane, const Rows<const T>& in) const {
        const C s1 = number(rows.s1), s2 = number(rows.s2), z = constants(row, lane).real(constant::beta) * s1 + s2;
        const Symmetric<C> A = whole_A<wind, gravity, false>(q, in, s1, s2, in.vector(loaded::c));
        const Rows<T> to{rows.inverses + std::size_t(rows.attached_of_row[row]) * 12 * L + lane};
        to.set(0, inverse_of(A, in, z));
    }

    // q: first what the bodies carry, then what they are to their carriers. It stays in memory, where each part waits until its turn. As local
    // numbers, the compiler would store most of them on its stack as well (381 stores a row, where now there are some 165).
    template <bool wind, bool gravity, bool tip>
    BOUGH_FORCE void step_in(const Rows<T>& q, std::uint32_t row, int lane, const Rows<const T>& in) const {
        const Rows<const T> k = constants(row, lane);
        const W mass = k.real(constant::mass);
        const C s1 = number(rows.s1), s2 = number(rows.s2), z = k.real(constant::beta) * s1 + s2;
        const V3<W> c = in.vector(loaded::c);
        // What goes past the caches waits here. The arithmetic is one code, so its rounding does not depend on it.
        alignas(64) T waiting[solved::rates * L];
        const Rows<T> kept{rows.stream ? waiting + lane : solved_row(row, lane).at};

        Symmetric<C> E;
        {
            const Symmetric<C> A = whole_A<wind, gravity, tip>(q, in, s1, s2, c);
            q.set(inward::A, A);
            E = inverse_of(A, in, z);
        }
        const V3<W> mc = mass * c;
        Symmetric<W> D{};
        if constexpr (wind) D = in.symmetric(loaded::D);
        const auto own_B = [&](int column, const V3<W>& Dk) {
            V3<C> B = came<tip>(q.complex_vector(inward::B + 6 * column));
            if constexpr (wind) B = plus(B, s1, cross(c, Dk));
            return B;
        };
        const auto own_M = [&](int k_, const W& d) {
            C M = came<tip>(q.number(inward::M + 2 * k_));
            if constexpr (wind) M = plus(M, s1, d);
            return M;
        };
        {
            V3<C> Bx = own_B(0, {D.xx, D.xy, D.xz}), By = own_B(1, {D.xy, D.yy, D.yz}),
                  Bz = own_B(2, {D.xz, D.yz, D.zz});
            Bx.y = Bx.y + mc.z, Bx.z = Bx.z - mc.y;
            By.x = By.x - mc.z, By.z = By.z + mc.x;
            Bz.x = Bz.x + mc.y, Bz.y = Bz.y - mc.x;
            q.set(inward::B, M3<C>{Bx, By, Bz});
        }
        forget_memory();
        {
            const V3<C> N = came<tip>(q.complex_vector(inward::N)) + in.complex_vector(loaded::N);
            const V3<C> Eu = E * (in.complex_vector(loaded::torque) - N);
            kept.set(solved::Eu, Eu);
            const Symmetric<C> A = q.complex_symmetric(inward::A);
            q.set(inward::N,
                  V3<C>{plus_dot(N.x, V3<C>{A.xx, A.xy, A.xz}, Eu), plus_dot(N.y, V3<C>{A.xy, A.yy, A.yz}, Eu),
                        plus_dot(N.z, V3<C>{A.xz, A.yz, A.zz}, Eu)});
        }
        forget_memory();
        // A' = Z E A, B' = Z E B, M' = M - B^T E B, column by column, so that few values have to stay in registers.
        {
            const Symmetric<C> A = q.complex_symmetric(inward::A);
            const Symmetric<W> K = in.symmetric(loaded::K);
            const V3<W> Kx{K.xx, K.xy, K.xz}, Ky{K.xy, K.yy, K.yz}, Kz{K.xz, K.yz, K.zz};
            const V3<C> EAx = E * V3<C>{A.xx, A.xy, A.xz};
            kept.set(solved::EA, EAx);
            q.set(inward::A, z * dot(Kx, EAx));
            const V3<C> EAy = E * V3<C>{A.xy, A.yy, A.yz};
            kept.set(solved::EA + 6, EAy);
            q.set(inward::A + 2, z * dot(Kx, EAy));
            q.set(inward::A + 6, z * dot(Ky, EAy));
            const V3<C> EAz = E * V3<C>{A.xz, A.yz, A.zz};
            kept.set(solved::EA + 12, EAz);
            q.set(inward::A + 4, z * dot(Kx, EAz));
            q.set(inward::A + 8, z * dot(Ky, EAz));
            q.set(inward::A + 10, z * dot(Kz, EAz));
        }
        forget_memory();
        {
            const V3<C> B = q.complex_vector(inward::B);
            const V3<C> EB = E * B;
            kept.set(solved::EB, EB);
            q.set(inward::M, minus_dot(own_M(0, D.xx) + mass, B, EB));
            q.set(inward::F,
                  plus_dot(came<tip>(q.number(inward::F)) + in.number(loaded::F), B, kept.complex_vector(solved::Eu)));
        }
        forget_memory();
        {
            const V3<C> B = q.complex_vector(inward::B + 6);
            const V3<C> EB = E * B;
            kept.set(solved::EB + 6, EB);
            q.set(inward::M + 2, minus_dot(own_M(1, D.xy), B, kept.complex_vector(solved::EB)));
            q.set(inward::M + 6, minus_dot(own_M(3, D.yy) + mass, B, EB));
            q.set(inward::F + 2, plus_dot(came<tip>(q.number(inward::F + 2)) + in.number(loaded::F + 2), B,
                                          kept.complex_vector(solved::Eu)));
        }
        forget_memory();
        {
            const V3<C> B = q.complex_vector(inward::B + 12);
            const V3<C> EB = E * B;
            kept.set(solved::EB + 12, EB);
            q.set(inward::M + 4, minus_dot(own_M(2, D.xz), B, kept.complex_vector(solved::EB)));
            q.set(inward::M + 8, minus_dot(own_M(4, D.yz), B, kept.complex_vector(solved::EB + 6)));
            q.set(inward::M + 10, minus_dot(own_M(5, D.zz) + mass, B, EB));
            q.set(inward::F + 4, plus_dot(came<tip>(q.number(inward::F + 4)) + in.number(loaded::F + 4), B,
                                          kept.complex_vector(solved::Eu)));
        }
        forget_memory();
        const V3<W> r = in.vector(loaded::r);
        q.set(inward::N, plus_cross(q.complex_vector(inward::N), r, q.complex_vector(inward::F)));
        // To the parent's joint: B'' = B' + [r] M', A'' = A' + S + S^T with S = [r] (B' + B'')^T / 2, U = B' + B''.
        {
            const Symmetric<W> K = in.symmetric(loaded::K);
            const Symmetric<C> M = q.complex_symmetric(inward::M);
            Symmetric<C> A = q.complex_symmetric(inward::A);
            const V3<W> t = T(0.5) * r;
            const auto hand_on = [&](int column, const V3<C>& Mk) { // and U's column
                const V3<C> B1 = z * (K * kept.complex_vector(solved::EB + 6 * column)), B = plus_cross(B1, r, Mk);
                q.set(inward::B + 6 * column, B);
                return B1 + B;
            };
            {
                const V3<C> U = hand_on(0, {M.xx, M.xy, M.xz});
                A.yy = plus(A.yy, r.z, U.y);
                A.zz = minus(A.zz, r.y, U.z);
                A.xy = plus(A.xy, t.z, U.x);
                A.xz = minus(A.xz, t.y, U.x);
                A.yz = minus(plus(A.yz, t.z, U.z), t.y, U.y);
            }
            {
                const V3<C> U = hand_on(1, {M.xy, M.yy, M.yz});
                A.xx = minus(A.xx, r.z, U.x);
                A.zz = plus(A.zz, r.x, U.z);
                A.xy = minus(A.xy, t.z, U.y);
                A.xz = plus(minus(A.xz, t.z, U.z), t.x, U.x);
                A.yz = plus(A.yz, t.x, U.y);
            }
            const V3<C> U = hand_on(2, {M.xz, M.yz, M.zz});
            A.xx = plus(A.xx, r.y, U.x);
            A.yy = minus(A.yy, r.x, U.y);
            A.xy = minus(plus(A.xy, t.y, U.y), t.x, U.x);
            A.xz = plus(A.xz, t.y, U.z);
            A.yz = minus(A.yz, t.x, U.z);
            q.set(inward::A, A);
        }

        if (!rows.stream) return;
        const Rows<T, true> past{solved_row(row, lane).at};
        for (int quantity = 0; quantity < solved::rates; ++quantity) past.set(quantity, kept.real(quantity));
    }

    template <bool wind, bool gravity> void group_in(const Group& g, const T* loaded_rows) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, inward::count> base;
            const Rows<T> q = base.rows();
            bool tip = true;
            for (std::uint32_t k = g.length; k-- > 0;) {
                const std::uint32_t row = g.first_row + k;
                if (rows.fork_of_row[row] >= 0) {
                    const std::uint32_t* joints =
                        &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)];
                    if (tip)
                        base.gather(rows.inward_records, joints);
                    else {
                        Records<T, inward::count> forks;
                        forks.gather(rows.inward_records, joints);
                        add_carried(q, forks.rows());
                    }
                    tip = false;
                }
                if (rows.attached && rows.attached_of_row[row] >= 0) {
                    if (tip)
                        for (int j = 0; j < inward::count; ++j) q.set(j, W{});
                    tip = false;
                    add_carried(q, {rows.attached + std::size_t(rows.attached_of_row[row]) * inward::count * L + lane});
                }
                const Rows<const T> in{loaded_rows + std::size_t(row - g.first_row) * loaded::count * L + lane};
                if (rows.inverses && rows.attached_of_row[row] >= 0) keep_inverse<wind, gravity>(q, row, lane, in);
                if (tip)
                    step_in<wind, gravity, true>(q, row, lane, in);
                else
                    step_in<wind, gravity, false>(q, row, lane, in);
                tip = false;
            }
            for (int k = inward::count; k < base.quantities; ++k) q.set(k, W{});
            base.template scatter<true>(rows.inward_records, &rows.landing[g.first_base + std::size_t(lane)], nothing);
        }
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
