#include "branch_mode.h"
#include <algorithm>
#include <limits>
#include <utility>

namespace bough {
namespace {

using Scalars = std::vector<double>;

// A tree of millions of bodies is not to stand beside all that is found of it on the way: what is read no more is given back.
template <class... Arrays> void give_back(Arrays&... arrays) {
    (Arrays().swap(arrays), ...);
}

// Inertia about the body's own joint, body axes: Steiner's theorem.
Mat3 joint_inertia(const Tree& tree, std::size_t i) {
    const Mat3 c = cross_matrix(tree.com[i]);
    return tree.inertia[i] - tree.mass[i] * c * c;
}

// What hangs on each joint, moved to that joint, in the axes of the joint's own body.
struct Lumps {
    Scalars mass, first, across, about; // the piece and what leaves it sideways
    Scalars all_first, all_about;       // H_k and the outboard inertia about the branch
};

Lumps make_lumps(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    Lumps lump;
    // Of the sideways part alone, body axes, about the own joint: of first moment and inertia no more than is asked for.
    lump.mass = tree.mass;
    for (Scalars* a : {&lump.first, &lump.across, &lump.about}) a->resize(n);
    {
        // Composite of the whole subtree, likewise.
        std::vector<double> m(tree.mass);
        std::vector<Vec3> h(n);
        std::vector<Mat3> J(n);
        Scalars across_y(n);
        for (std::size_t i = 0; i < n; ++i) {
            h[i] = tree.mass[i] * tree.com[i];
            J[i] = joint_inertia(tree, i);
            lump.first[i] = h[i].z();
            lump.across[i] = J[i](0, 0);
            across_y[i] = J[i](1, 1);
            lump.about[i] = J[i](2, 2);
        }
        for (std::size_t i = n; i-- > 0;) {
            if (tree.parent[i] < 0) continue;
            const auto p = std::size_t(tree.parent[i]);
            const Mat3 R = tree.joint_rotation[i].toRotationMatrix();
            const Vec3& r = tree.joint_position[i];
            const Vec3 g = R * h[i];
            const Vec3 q = g + 0.5 * m[i] * r;
            const Mat3 moved =
                R * J[i] * R.transpose() + 2 * r.dot(q) * Mat3::Identity() - r * q.transpose() - q * r.transpose();
            const Vec3 moment = g + m[i] * r;
            m[p] += m[i];
            h[p] += moment;
            J[p] += moved;
            if (continues_parent(tree, i)) continue;
            lump.mass[p] += m[i];
            lump.first[p] += moment.z();
            lump.across[p] += moved(0, 0);
            across_y[p] += moved(1, 1);
            lump.about[p] += moved(2, 2);
        }
        for (std::size_t i = 0; i < n; ++i) {
            lump.first[i] = std::max(0.0, lump.first[i]);
            lump.across[i] = 0.5 * (lump.across[i] + across_y[i]);
        }
    }
    lump.all_about = lump.about;
    lump.all_first = lump.first;
    Scalars all_mass = lump.mass;
    for (std::size_t i = n; i-- > 0;) {
        if (!continues_parent(tree, i)) continue;
        const auto p = std::size_t(tree.parent[i]);
        const double l = tree.joint_position[i].norm();
        all_mass[p] += all_mass[i];
        lump.all_first[p] += lump.all_first[i] + l * all_mass[i];
        lump.all_about[p] += lump.all_about[i];
    }
    return lump;
}

// load / K at every joint; 1 on the whole branch where one of its joints is free.
Scalars trial_shape(const Tree& tree, const std::vector<std::uint32_t>& base, const Scalars& load, const Scalars& K) {
    const std::size_t n = tree.size_bodies();
    std::vector<char> free(n, 0);
    Scalars largest(n, 0.0), kappa(n);
    for (std::size_t i = 0; i < n; ++i) {
        free[base[i]] = char(free[base[i]] || K[i] <= 0);
        largest[base[i]] = std::max(largest[base[i]], load[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        // A piece that carries nothing off its joint still needs a shape: a trace of the branch's largest load.
        const double floor = std::max(1e-9 * largest[base[i]], std::numeric_limits<double>::min());
        kappa[i] = free[base[i]] ? 1.0 : std::max(load[i], floor) / K[i];
    }
    return kappa;
}

} // namespace

BranchModes branch_modes(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    Lumps lump = make_lumps(tree);
    std::vector<std::uint32_t> base(n); // the body at its branch's base
    Scalars K_bend(n), K_twist(n);
    for (std::size_t i = 0; i < n; ++i) {
        base[i] = continues_parent(tree, i) ? base[std::size_t(tree.parent[i])] : std::uint32_t(i);
        const Vec3& K = tree.stiffness[i];
        K_bend[i] = tree.kind[i] == Kind::branch ? 0.5 * (K.x() + K.y()) : std::min(K.x(), K.y());
        K_twist[i] = K.z();
    }
    const Scalars bend = trial_shape(tree, base, lump.all_first, K_bend);
    give_back(lump.all_first);
    const Scalars twist = trial_shape(tree, base, lump.all_about, K_twist);

    // Forward: rates and velocities of the trial shapes. Backward: momenta P (linear), L (angular), T (twist).
    Scalars rate(n), velocity(n, 0.0), spin(n), P(n), L(n), T(n), deflection(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const bool on = continues_parent(tree, i);
        const auto p = on ? std::size_t(tree.parent[i]) : i;
        rate[i] = bend[i] + (on ? rate[p] : 0.0);
        spin[i] = twist[i] + (on ? spin[p] : 0.0);
        velocity[i] = on ? velocity[p] + rate[p] * tree.joint_position[i].norm() : 0.0;
        const double reach = tree.kind[i] == Kind::fruit ? tree.size[i][0] + tree.size[i][1] : tree.size[i][0];
        deflection[base[i]] = std::max(deflection[base[i]], velocity[i] + rate[i] * reach);
        P[i] = lump.mass[i] * velocity[i] + lump.first[i] * rate[i];
        L[i] = lump.first[i] * velocity[i] + lump.across[i] * rate[i];
        T[i] = lump.about[i] * spin[i];
    }
    give_back(rate, velocity, spin, lump.about);
    Scalars M(std::move(lump.across)), mass(std::move(lump.mass)), first(std::move(lump.first));
    for (std::size_t i = n; i-- > 0;) {
        if (!continues_parent(tree, i)) continue;
        const auto p = std::size_t(tree.parent[i]);
        const double l = tree.joint_position[i].norm();
        P[p] += P[i];
        L[p] += L[i] + l * P[i];
        T[p] += T[i];
        M[p] += M[i] + l * (2 * first[i] + l * mass[i]);
        first[p] += first[i] + l * mass[i];
        mass[p] += mass[i];
    }
    give_back(P, mass, first);
    Scalars stiff_bend(n, 0.0), stiff_twist(n, 0.0), mass_bend(n, 0.0), mass_twist(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        stiff_bend[base[i]] += K_bend[i] * bend[i] * bend[i];
        mass_bend[base[i]] += bend[i] * L[i];
        stiff_twist[base[i]] += K_twist[i] * twist[i] * twist[i];
        mass_twist[base[i]] += twist[i] * T[i];
    }
    give_back(K_bend, K_twist);
    const auto quotient = [](double a, double b) { return b > 0 ? std::sqrt(a / b) : 0.0; };
    const auto factor = [](double momentum, double inertia) {
        return inertia > 0 ? std::max(1.0, momentum / inertia) : 1.0;
    };
    BranchModes modes;
    for (Scalars* a : {&modes.omega_bend, &modes.omega_twist, &modes.factor_bend, &modes.factor_twist, &modes.weight})
        a->resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        modes.omega_bend[i] = quotient(stiff_bend[base[i]], mass_bend[base[i]]);
        modes.omega_twist[i] = quotient(stiff_twist[base[i]], mass_twist[base[i]]);
        modes.factor_bend[i] = factor(L[i], M[i] * bend[i]);
        modes.factor_twist[i] = factor(T[i], lump.all_about[i] * twist[i]);
        modes.weight[i] = deflection[base[i]] > 0 ? bend[i] / deflection[base[i]] : 1.0;
    }
    return modes;
}

} // namespace bough
