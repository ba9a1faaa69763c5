#include "engine.h"

namespace yardstick {
namespace {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Real; // 113 bits
#else
typedef long double Real; // as many on machines without the other
#endif
using V = bough::Vector3<Real>;
using M = bough::Matrix3<Real>;

// Of a quaternion of any length (no square root).
M rotation(const Quat& q) {
    const Real w = q.w(), x = q.x(), y = q.y(), z = q.z(), two = 2 / (w * w + x * x + y * y + z * z);
    M R;
    R << 1 - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y), //
        two * (x * y + w * z), 1 - two * (x * x + z * z), two * (y * z - w * x),  //
        two * (x * z - w * y), two * (y * z + w * x), 1 - two * (x * x + y * y);
    return R;
}

M cross(const V& r) {
    return bough::cross_matrix<Real>(r);
}

class DenseEngine : public Engine {
public:
    DenseEngine(const Tree& given, const Vec3& g)
        : tree(given), gravity(g.cast<Real>()), n(std::int32_t(given.size_bodies())), R(n), x(n), c(n), omega(n),
          alpha(n), a(n), a_com(n), v(n) {}
    const char* name() const override { return "dense"; }

    // Velocities, and accelerations as they are while every rate stands still.
    void move(const Motion& motion, Bodies& bodies) override {
        const V zero(0, 0, 0);
        for (std::int32_t i = 0; i < n; ++i) {
            const std::int32_t p = tree.parent[i];
            const M R_p = p < 0 ? M(M::Identity()) : R[p];
            const V omega_p = p < 0 ? zero : omega[p], alpha_p = p < 0 ? zero : alpha[p];
            const V arm = R_p * tree.joint_position[i].cast<Real>();
            R[i] = R_p * rotation(tree.joint_rotation[i]) * rotation(motion.turn[i]);
            x[i] = (p < 0 ? zero : x[p]) + arm;
            v[i] = (p < 0 ? zero : v[p]) + omega_p.cross(arm);
            a[i] = (p < 0 ? zero : a[p]) + alpha_p.cross(arm) + omega_p.cross(omega_p.cross(arm));
            const V relative = R[i] * motion.rate[i].cast<Real>();
            omega[i] = omega_p + relative;
            alpha[i] = alpha_p + omega_p.cross(relative);
            const V out = R[i] * tree.com[i].cast<Real>();
            c[i] = x[i] + out;
            a_com[i] = a[i] + alpha[i].cross(out) + omega[i].cross(omega[i].cross(out));
            bodies.R_wb[i] = R[i].cast<double>();
            bodies.joint[i] = x[i].cast<double>();
            bodies.com[i] = c[i].cast<double>();
            bodies.omega[i] = omega[i].cast<double>();
            bodies.com_velocity[i] = V(v[i] + omega[i].cross(out)).cast<double>();
        }
    }

    void accelerate(const Loads& loads, std::vector<Vec3>& acceleration) override {
        std::vector<V> force = joint_forces(loads);
        factorize(mass_matrix());
        for (std::int32_t k = n - 1; k >= 0; --k)
            for_ancestors(
                k, [&](std::int32_t i, std::size_t place) { force[i] -= V(matrix[k][place].transpose() * force[k]); });
        for (std::int32_t k = 0; k < n; ++k) {
            force[k] = V(inverse[k] * force[k]);
            for_ancestors(k, [&](std::int32_t i, std::size_t place) { force[k] -= V(matrix[k][place] * force[i]); });
            acceleration[k] = force[k].cast<double>();
        }
    }

private:
    // Row k of the mass matrix: its blocks with k itself (place 0), its parent (1), and so on to the root.
    using Rows = std::vector<std::vector<M>>;
    template <class Visit> void for_ancestors(std::int32_t k, Visit visit) const {
        std::size_t place = 1;
        for (std::int32_t i = tree.parent[k]; i >= 0; i = tree.parent[i]) visit(i, place++);
    }

    // Forces, and those of inertia, of all bodies outboard of a joint, about the joint, and the torque in it.
    std::vector<V> joint_forces(const Loads& loads) const {
        std::vector<V> f(n), moment(n), joint(n); // moment about the world's origin
        for (std::int32_t b = 0; b < n; ++b) {
            const M I = R[b] * tree.inertia[b].cast<Real>() * R[b].transpose();
            f[b] = loads.force[b].cast<Real>() + Real(tree.mass[b]) * (gravity - a_com[b]);
            moment[b] =
                c[b].cross(f[b]) + loads.moment[b].cast<Real>() - I * alpha[b] - omega[b].cross(V(I * omega[b]));
        }
        for (std::int32_t b = n - 1; b >= 0; --b) {
            joint[b] = loads.torque[b].cast<Real>() + R[b].transpose() * (moment[b] - x[b].cross(f[b]));
            const std::int32_t p = tree.parent[b];
            if (p < 0) continue;
            f[p] += f[b];
            moment[p] += moment[b];
        }
        return joint;
    }

    // Block (j, k), k on j's path: the moment about joint k of the momentum that a rate of joint j gives to all bodies
    // outboard of j, which are mass m, first moment h and inertia J about the world's origin.
    Rows mass_matrix() const {
        std::vector<Real> m(n);
        std::vector<V> h(n);
        std::vector<M> J(n);
        for (std::int32_t b = 0; b < n; ++b) {
            m[b] = tree.mass[b];
            h[b] = m[b] * c[b];
            J[b] =
                R[b] * tree.inertia[b].cast<Real>() * R[b].transpose() + m[b] * cross(c[b]) * cross(c[b]).transpose();
        }
        Rows rows(n);
        for (std::int32_t j = n - 1; j >= 0; --j) {
            const M velocity = cross(x[j]) * R[j];
            const M linear = m[j] * velocity - cross(h[j]) * R[j], angular = J[j] * R[j] + cross(h[j]) * velocity;
            rows[j].push_back(R[j].transpose() * (angular - cross(x[j]) * linear));
            for_ancestors(j, [&](std::int32_t k, std::size_t) {
                rows[j].push_back((R[k].transpose() * (angular - cross(x[k]) * linear)).transpose());
            });
            const std::int32_t p = tree.parent[j];
            if (p < 0) continue;
            m[p] += m[j];
            h[p] += h[j];
            J[p] += J[j];
        }
        return rows;
    }

    // mass = L^T D L, L unit lower triangular with the mass matrix's zeros (Featherstone 2005). Keeps L and D^-1.
    void factorize(Rows rows) {
        inverse.resize(n);
        for (std::int32_t k = n - 1; k >= 0; --k) {
            inverse[k] = rows[k][0].inverse();
            const std::vector<M> row = rows[k];
            for_ancestors(k, [&](std::int32_t i, std::size_t place) {
                rows[k][place] = inverse[k] * row[place];
                for (std::size_t q = place; q < row.size(); ++q)
                    rows[i][q - place] -= M(rows[k][place].transpose() * row[q]);
            });
        }
        matrix = std::move(rows);
    }

    // Tree's and Real's arrays are all counted by the tree's own type of index.
    template <class T> struct Array : std::vector<T> {
        explicit Array(std::int32_t size) : std::vector<T>(std::size_t(size)) {}
    };
    const Tree tree;
    const V gravity;
    const std::int32_t n;
    Array<M> R;
    Array<V> x, c, omega, alpha, a, a_com, v;
    Rows matrix;
    std::vector<M> inverse;
};

} // namespace

std::unique_ptr<Engine> make_dense(const Tree& tree, const Vec3& gravity) {
    return std::make_unique<DenseEngine>(tree, gravity);
}

} // namespace yardstick
