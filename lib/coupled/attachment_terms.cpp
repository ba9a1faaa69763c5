#include "../base/math.h"
#include "attachment.h"

namespace bough {
namespace {

constexpr double followed = 0.2; // of what a spring's force has changed by, each step (attachment.h, digits)

} // namespace

void settle_attachments(Attachments& a) {
    for (AttachedBody& b : a.bodies) {
        b.turned = b.GJ * b.now.theta_change;
        b.spun = b.GJ * b.now.eta_change;
        b.moved.setZero();
        b.sped.setZero();
        if (b.parent < 0) continue;
        const AttachedBody& p = a.bodies[std::size_t(b.parent)];
        const Vec3 r = b.x - p.x;
        b.moved = p.moved + p.turned.cross(r);
        b.sped = p.sped + p.spun.cross(r);
        b.turned += p.turned;
        b.spun += p.spun;
    }
    for (Attached& held : a.all) {
        if (held.steps > 0) {
            held.target += (held.goal - held.target) / held.steps;
            --held.steps;
        }
        held.work = held.far_work = 0;
        if (!held.on) continue;
        Vec3 start = held.start, velocity = held.velocity, way = Vec3::Zero(), far_way = way, gained = way;
        const auto go = [&](const AttachedEnd& end, Vec3& end_way, double of) {
            const AttachedBody& b = a.bodies[end.at];
            end_way = b.moved + b.turned.cross(end.rho);
            gained += of * (b.sped + b.spun.cross(end.rho));
        };
        go(held, way, 1);
        if (held.far) {
            go(*held.far, far_way, -1);
            start -= held.far->start;
            velocity -= held.far->velocity;
        }
        const Vec3 before = held.force;
        const Vec3 spring = -held.k * (start + (way - far_way) - held.to_target);
        held.spring += followed * (spring - held.spring);
        held.force = spring - held.c * (velocity + gained - held.target_velocity - held.quicker / 2);
        held.work = (before + held.force).dot(way) / 2;
        held.far_work = -(before + held.force).dot(far_way) / 2;
    }
    for (PulledPoint& point : a.pulled) {
        if (!point.turns) continue;
        const AttachedBody& b = a.bodies[point.at];
        point.work = point.force.dot(b.moved + b.turned.cross(point.rho));
    }
}

template <class S> AttachmentTerms<S> attachment_terms(const AttachmentSums& sums, std::complex<double> p, double h) {
    using Real = typename Eigen::NumTraits<S>::Real;
    const auto in_field = [](std::complex<double> z) {
        if constexpr (Eigen::NumTraits<S>::IsComplex)
            return S(Real(z.real()), Real(z.imag()));
        else
            return S(z.real());
    };
    const std::complex<double> z1 = h / p, z2 = z1 * z1, z_slope = 1.0 / p - 0.5;
    const auto all = [&](std::complex<double> a, const auto& x, std::complex<double> b, const auto& y) {
        return (x.template cast<std::complex<double>>() * a + y.template cast<std::complex<double>>() * b)
            .unaryExpr(in_field)
            .eval();
    };
    const auto wrench = [&](const Vec3& f, const Vec3& slope, const Vec3& rate, const Vec3(&ground)[4]) {
        ComplexVec3 sum = f.cast<std::complex<double>>();
        sum += z_slope * slope.cast<std::complex<double>>() + z1 * rate.cast<std::complex<double>>();
        const std::complex<double> weights[4] = {z2, z1, z2 * z_slope, z1 * z_slope};
        for (int k = 0; k < 4; ++k) sum += weights[k] * ground[k].cast<std::complex<double>>();
        return sum.unaryExpr(in_field).eval();
    };
    AttachmentTerms<S> t;
    t.A = all(z2, sums.A_stiffness, z1, sums.A_damping);
    t.B = all(z2, cross_matrix(sums.B_stiffness), z1, cross_matrix(sums.B_damping));
    t.M = in_field(z2 * sums.stiffness + z1 * sums.damping) * Eigen::Matrix<S, 3, 3>::Identity();
    t.N = wrench(sums.N, sums.N_slope, sums.N_rate, sums.N_ground);
    t.F = wrench(sums.F, sums.F_slope, sums.F_rate, sums.F_ground);
    return t;
}

template AttachmentTerms<float> attachment_terms(const AttachmentSums&, std::complex<double>, double);
template AttachmentTerms<double> attachment_terms(const AttachmentSums&, std::complex<double>, double);
template AttachmentTerms<std::complex<float>> attachment_terms(const AttachmentSums&, std::complex<double>, double);
template AttachmentTerms<std::complex<double>> attachment_terms(const AttachmentSums&, std::complex<double>, double);

} // namespace bough
