// coupled_in.h: the coupled step's sweep inward over lanes (coupled_sweeps.h): joint by joint the elimination of resolvent.h, and what is
// handed on to the body that carries it.
//
// Reads   loaded, mass, beta, records inward of forks, attached
// Writes  of solved Eu, EA, EB; adds to the records inward where chains land
// Cost    about 930 arithmetic instructions a row (AVX-512) among 1930. Errors none.
// What was tried on the three sweeps, time against the one before (float, gusty, one thread, AVX-512; good to about 3 %):
//   products written so that each fuses, the profile looked up in all lanes     1 000 bodies 0.88, 100 000 0.96
//   eliminated column by column, the inverse scaled by the body's own numbers   0.98, 0.94
//   rates kept where the last sweep reads them, at once                         10 000 0.96, 100 000 1.00
//   terminal groups take one place in the cache                                 1.00, 0.975
//   no solutions past the caches                                                10 000 0.81, 100 000 0.93, 1 000 000 1.45: hence step_bytes.h's streams()
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

    struct Carried {
        Symmetric<C> A, M;
        M3<C> B;
        V3<C> N, F;
    };

    BOUGH_FORCE static Carried read_carried(const Rows<T>& q) {
        return {q.complex_symmetric(inward::A), q.complex_symmetric(inward::M), q.complex_matrix(inward::B),
                q.complex_vector(inward::N), q.complex_vector(inward::F)};
    }

    template <bool wind, bool gravity>
    BOUGH_FORCE void step_in(Carried& q, std::uint32_t row, int lane, const Rows<const T>& in) const {
        const Rows<const T> k = constants(row, lane);
        const W mass = k.real(constant::mass);
        const C s1 = number(rows.s1), s2 = number(rows.s2);
        const V3<W> c = in.vector(loaded::c);
        // Own A, B, M beside those that came (resolvent.cpp, start)
        const Symmetric<W> J = in.symmetric(loaded::J), K = in.symmetric(loaded::K);
        q.A = {q.A.xx + J.xx, q.A.xy + J.xy, q.A.xz + J.xz, q.A.yy + J.yy, q.A.yz + J.yz, q.A.zz + J.zz};
        if constexpr (gravity || wind) q.A = plus(q.A, s2, in.symmetric(loaded::H));
        M3<C>& B = q.B;
        if constexpr (wind) {
            const Symmetric<W> D = in.symmetric(loaded::D);
            const M3<W> cD = cross_left(c, full(D));
            q.A = plus(q.A, s1, upper(cross_left(c, transposed(cD))));
            q.M = plus(q.M, s1, D);
            B = {plus(B.x, s1, cD.x), plus(B.y, s1, cD.y), plus(B.z, s1, cD.z)};
        }
        const V3<W> mc = mass * c;
        B.x.y = B.x.y + mc.z, B.x.z = B.x.z - mc.y;
        B.y.x = B.y.x - mc.z, B.y.z = B.y.z + mc.x;
        B.z.x = B.z.x + mc.y, B.z.y = B.z.y - mc.x;
        q.M.xx = q.M.xx + mass, q.M.yy = q.M.yy + mass, q.M.zz = q.M.zz + mass;
        q.N = q.N + in.complex_vector(loaded::N);
        q.F = q.F + in.complex_vector(loaded::F);

        const C z = k.real(constant::beta) * s1 + s2;
        const W size = J.xx + J.yy + J.zz + (magnitude(z.re) + magnitude(z.im)) * (K.xx + K.yy + K.zz);
        const Symmetric<C> E = inverse(plus(q.A, z, K), W(1 / size));
        // What goes past the caches waits here: the arithmetic is one code, whose rounding does not hang on it.
        alignas(64) T waiting[solved::rates * L];
        const Rows<T> kept{rows.stream ? waiting + lane : solved_row(row, lane).at};
        const auto keep = [&](int quantity, const auto& v) { kept.set(quantity, v); };
        // A' = Z E A, B' = Z E B, M' = M - B^T E B, column by column, so that little has to stay in registers.
        const V3<W> Kx{K.xx, K.xy, K.xz}, Ky{K.xy, K.yy, K.yz}, Kz{K.xz, K.yz, K.zz};
        const V3<C> Ax{q.A.xx, q.A.xy, q.A.xz}, Ay{q.A.xy, q.A.yy, q.A.yz}, Az{q.A.xz, q.A.yz, q.A.zz};
        const V3<C> EAx = E * Ax;
        keep(solved::EA, EAx);
        Symmetric<C> A;
        A.xx = z * dot(Kx, EAx);
        const V3<C> EAy = E * Ay;
        keep(solved::EA + 6, EAy);
        A.xy = z * dot(Kx, EAy);
        A.yy = z * dot(Ky, EAy);
        const V3<C> EAz = E * Az;
        keep(solved::EA + 12, EAz);
        A.xz = z * dot(Kx, EAz);
        A.yz = z * dot(Ky, EAz);
        A.zz = z * dot(Kz, EAz);

        Symmetric<C>& M = q.M;
        M3<C> B1;
        const V3<C> EBx = E * B.x;
        keep(solved::EB, EBx);
        B1.x = z * (K * EBx);
        M.xx = minus_dot(M.xx, B.x, EBx);
        const V3<C> EBy = E * B.y;
        keep(solved::EB + 6, EBy);
        B1.y = z * (K * EBy);
        M.xy = minus_dot(M.xy, B.x, EBy);
        M.yy = minus_dot(M.yy, B.y, EBy);
        const V3<C> EBz = E * B.z;
        keep(solved::EB + 12, EBz);
        B1.z = z * (K * EBz);
        M.xz = minus_dot(M.xz, B.x, EBz);
        M.yz = minus_dot(M.yz, B.y, EBz);
        M.zz = minus_dot(M.zz, B.z, EBz);

        const V3<C> Eu = E * (in.complex_vector(loaded::torque) - q.N);
        keep(solved::Eu, Eu);
        const V3<W> r = in.vector(loaded::r);
        q.N = {plus_dot(q.N.x, Ax, Eu), plus_dot(q.N.y, Ay, Eu), plus_dot(q.N.z, Az, Eu)};
        q.F = {plus_dot(q.F.x, B.x, Eu), plus_dot(q.F.y, B.y, Eu), plus_dot(q.F.z, B.z, Eu)};
        q.N = plus_cross(q.N, r, q.F);
        // To the parent's joint: B'' = B' + [r] M', A'' = A' + S + S^T with S = [r] (B' + B'')^T / 2.
        B = {plus_cross(B1.x, r, V3<C>{M.xx, M.xy, M.xz}), plus_cross(B1.y, r, V3<C>{M.xy, M.yy, M.yz}),
             plus_cross(B1.z, r, V3<C>{M.xz, M.yz, M.zz})};
        const M3<C> U = B1 + B;
        const V3<W> t = T(0.5) * r;
        q.A.xx = minus(plus(A.xx, r.y, U.z.x), r.z, U.y.x);
        q.A.yy = minus(plus(A.yy, r.z, U.x.y), r.x, U.z.y);
        q.A.zz = minus(plus(A.zz, r.x, U.y.z), r.y, U.x.z);
        q.A.xy = minus(plus(minus(plus(A.xy, t.y, U.z.y), t.z, U.y.y), t.z, U.x.x), t.x, U.z.x);
        q.A.xz = minus(plus(minus(plus(A.xz, t.y, U.z.z), t.z, U.y.z), t.x, U.y.x), t.y, U.x.x);
        q.A.yz = minus(plus(minus(plus(A.yz, t.z, U.x.z), t.x, U.z.z), t.x, U.y.y), t.y, U.x.y);

        if (!rows.stream) return;
        const Rows<T, true> past{solved_row(row, lane).at};
        for (int quantity = 0; quantity < solved::rates; ++quantity) past.set(quantity, kept.real(quantity));
    }

    template <bool wind, bool gravity> void group_in(const Group& g, const T* loaded_rows) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Carried q{};
            for (std::uint32_t k = g.length; k-- > 0;) {
                const std::uint32_t row = g.first_row + k;
                if (rows.fork_of_row[row] >= 0) {
                    Records<T, inward::count> forks;
                    forks.gather(rows.inward_records,
                                 &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)]);
                    const Carried more = read_carried(forks.rows());
                    q = {q.A + more.A, q.M + more.M, q.B + more.B, q.N + more.N, q.F + more.F};
                }
                if (rows.attached && rows.attached_of_row[row] >= 0) {
                    const Carried more = read_carried(
                        {rows.attached + std::size_t(rows.attached_of_row[row]) * inward::count * L + lane});
                    q = {q.A + more.A, q.M + more.M, q.B + more.B, q.N + more.N, q.F + more.F};
                }
                step_in<wind, gravity>(q, row, lane,
                                       {loaded_rows + std::size_t(row - g.first_row) * loaded::count * L + lane});
            }
            Records<T, inward::count> base;
            const Rows<T> out = base.rows();
            out.set(inward::A, q.A);
            out.set(inward::M, q.M);
            out.set(inward::B, q.B);
            out.set(inward::N, q.N);
            out.set(inward::F, q.F);
            for (int k = inward::count; k < base.quantities; ++k) out.set(k, W{});
            base.scatter(&rows.landing[g.first_base + std::size_t(lane)], nothing,
                         [&](std::uint32_t joint, int k, W w) {
                             T* at = rows.inward_records + joint * record(inward::count, L) + std::size_t(k);
                             write(at, read(at) + w);
                         });
        }
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
