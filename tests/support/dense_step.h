// dense_step.h: one step of the coupled solver (coupled_step.h) by dense algebra in long double: a truth for its sweeps
// that shares with them the statement of the step alone.
//
// At y* = (theta*, eta*), t* = t + h/2, over all joints at once, a system with constant coefficients in d = (theta - theta_0,
// eta - eta_0):  d' = L d + f~ + (t - h/2)/h slope.  From dense_dynamics.h: accelerations and mass matrix. From here:
//   rates of turning Phi_b and of moving V_b of body b with eta, in y*'s pose; D = sum V^T D_b V, H = sum Phi^T H_b Phi
//   H_b    gravity's, by second differences of the potential of what body b turns; the air's bound on plates (air.h)
//   attachments: k P^T P in K, c P^T P in C, P the rates of the point (less those of the other's), and what turning resists by their force
//   pulls (coupled/pulled_points.h): what they resist turning by, in K; of those that turn, what they and their moments change by as their body turns
//   slope  M^-1 of what wind and pulls change by, and of what D makes of the ground's going on
// The step is R(h W) of the matrix W that makes the system autonomous, R by its polynomials: no poles, no residues.
// For grounds of steady acceleration and angular velocity, turning about the world's origin.
#pragma once
#include "tests/support/dense_dynamics.h"
#include "tests/support/rational.h"
#include <Eigen/LU>

namespace dense {

// Products of few types, for the compiler's time.
inline Matrix times(const Matrix& A, const Matrix& B) {
    Matrix product = Matrix::Zero(A.rows(), B.cols());
    for (Eigen::Index c = 0; c < B.cols(); ++c)
        for (Eigen::Index k = 0; k < A.cols(); ++k)
            for (Eigen::Index r = 0; r < A.rows(); ++r) product(r, c) += A(r, k) * B(k, c);
    return product;
}
inline Matrix transposed_times(const Matrix& A, const Matrix& B) {
    return times(Matrix(A.transpose()), B);
}
// A^T S B
inline Matrix sandwich(const Matrix& A, const M3& S, const Matrix& B) {
    return transposed_times(A, times(S, B));
}
inline Vector transposed_times(const Matrix& A, const V3& x) {
    return transposed_times(A, Matrix(x)).col(0);
}
inline M3 block(const Matrix& A, Eigen::Index row, Eigen::Index column) {
    return A.block<3, 3>(row, column);
}

inline Matrix polynomial(const std::vector<Real>& c, const Matrix& W) {
    Matrix sum = c.back() * Matrix::Identity(W.rows(), W.cols());
    for (std::size_t k = c.size() - 1; k-- > 0;) {
        sum = times(sum, W);
        sum.diagonal().array() += c[k];
    }
    return sum;
}

// A spring and a damper at a point (coupled/attachment.h), its target over the step; quicker: what the target's velocity gains.
struct Held {
    std::size_t body;
    V3 point_b;
    Real k, c;
    V3 from, to, quicker, force; // force: of the last step's end
    std::int64_t far = -1;       // the other body, from whose point the targets are seen
    V3 far_point_b = V3::Zero();
};

// A pull that turns with its body, at y*; change: of its force over the step, in y*'s axes.
struct Turning {
    std::size_t body;
    V3 point_b, force, change;
};

struct Step {
    Problem middle;               // at y*, t*: theta, and rate = J eta*, body axes; h = 0
    std::vector<bough::Vec3> eta; // eta*
    std::vector<bough::Vec3> theta_0, eta_0;
    V3 wind_change = V3::Zero();   // over the step
    std::vector<V3> pull_change{}; // of middle.pulls
    Real h = 0;
    std::vector<Held> held{};
    std::vector<Turning> turning{};
};

// theta(t + h) - theta_0, then eta(t + h) - eta_0.
inline Vector take(const Step& taken, bough::Scheme scheme) {
    const Problem& p = taken.middle;
    const bough::Tree& tree = p.tree;
    const std::size_t n = tree.size_bodies();
    const auto N = 3 * Eigen::Index(n);
    const Pose pose = pose_at(p, 0);
    const Vector v = first_derivative([&](Real s) { return centres(p, s); });
    const Solved solved = solve(p);

    // The chart: body rates J eta, and their change J_dot eta.
    Matrix J = Matrix::Zero(N, N);
    Vector bias(N), theta_ahead(N), eta_ahead(N), eta_0(N), stiffness(N), damping(N);
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Index at = 3 * Eigen::Index(i);
        const V3 theta = p.theta[i].cast<Real>(), eta = taken.eta[i].cast<Real>();
        const auto back = turned(theta).conjugate();
        const auto turning = [&](const V3& along) {
            return [&theta, back, along](Real s) { return logarithm(back * turned(V3(theta + s * along))); };
        };
        for (int k = 0; k < 3; ++k) J.block<3, 1>(at, at + k) = first_derivative(turning(V3::Unit(k)));
        bias.segment<3>(at) = second_derivative(turning(eta));
        theta_ahead.segment<3>(at) = theta - taken.theta_0[i].cast<Real>();
        eta_0.segment<3>(at) = taken.eta_0[i].cast<Real>();
        eta_ahead.segment<3>(at) = eta - taken.eta_0[i].cast<Real>();
        stiffness.segment<3>(at) = tree.stiffness[i].cast<Real>() * Real(p.plan.scene.stiffness_scale);
        damping.segment<3>(at) = stiffness.segment<3>(at) * Real(tree.damping[i]) * Real(p.plan.scene.damping_scale);
    }

    // What each body turns: its own first moment and its children's places times the mass outboard.
    std::vector<Real> outboard(n);
    std::vector<V3> carried(n, V3::Zero());
    bool leaves = false;
    const std::vector<V3> drag = p.air ? drag_moments(p, pose, leaves) : std::vector<V3>();
    for (std::size_t i = n; i-- > 0;) {
        outboard[i] += tree.mass[i];
        carried[i] += Real(tree.mass[i]) * (pose.c[i] - pose.x[i]);
        if (tree.parent[i] < 0) continue;
        const auto q = std::size_t(tree.parent[i]);
        outboard[q] += outboard[i];
        carried[q] += outboard[i] * (pose.x[i] - pose.x[q]);
    }

    Matrix K = stiffness.asDiagonal(), C = damping.asDiagonal();
    Vector slope = Vector::Zero(N), force = Vector::Zero(N);
    const V3 g = p.plan.scene.gravity.cast<Real>();
    for (std::size_t b = 0; b < n; ++b) {
        Matrix turn = Matrix::Zero(3, N), move = Matrix::Zero(3, N);
        for (std::int32_t k = std::int32_t(b); k >= 0; k = tree.parent[std::size_t(k)]) {
            const auto q = std::size_t(k);
            turn.block<3, 3>(0, 3 * k) = pose.R[q] * block(J, 3 * k, 3 * k);
            move.block<3, 3>(0, 3 * k) = -cross(pose.c[b] - pose.x[q]) * block(turn, 0, 3 * k);
        }
        const auto curvature = [&](const V3& along) { // of -g . (turned P) as it turns
            const auto potential = [&](Real s) {
                return Vector::Constant(1, -g.dot(turned(V3(s * along)) * carried[b]));
            };
            return Real(second_derivative(potential)[0]);
        };
        M3 H = M3::Zero(), D = M3::Zero();
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                H(r, c) = (curvature(V3::Unit(r) + V3::Unit(c)) - curvature(V3::Unit(r) - V3::Unit(c))) / 4;
        if (p.air) {
            const Real area = p.plan.drag_area[b];
            const V3 u = p.wind - v.segment<3>(3 * Eigen::Index(b));
            D = area * air_damping(tree.kind[b], pose.R[b], u);
            if (bough::is_flat(tree.kind[b])) {
                const V3 x = pose.R[b].col(0);
                H += Real(1.5) / (1 + u.norm() / 7.5) * area * Real(tree.com[b].norm()) * u.squaredNorm() * x *
                     x.transpose();
            }
            H += streaming(drag[b], u, leaves);
            const M3 I = pose.R[b] * tree.inertia[b].cast<Real>() * pose.R[b].transpose();
            C += sandwich(turn, spin_rate(tree.kind[b], area, tree.mass[b], u) * I, turn);
        }
        K += sandwich(turn, H, turn);
        C += sandwich(move, D, move);
        slope += transposed_times(move, V3(D * (taken.wind_change - p.ground.a * taken.h)));
        for (std::size_t k = 0; k < p.pulls.size(); ++k) {
            if (p.plan.pulls[k].body != b) continue;
            const V3 arm = pose.R[b] * (p.plan.pulls[k].point_b - tree.com[b]).cast<Real>();
            slope += transposed_times(Matrix(move - times(cross(arm), turn)), taken.pull_change[k]);
        }
    }
    // Attachments: the force at y0 is that of the point's own place there.
    Matrix K_turning = K;
    const Matrix C_moving = C;
    Problem start = p;
    start.theta = taken.theta_0;
    start.time = p.time - taken.h / 2;
    const Pose before = pose_at(start, 0);
    for (const Held& held : taken.held) {
        const M3 R_0 = p.ground.R(start.time), R_1 = p.ground.R(start.time + taken.h);
        V3 x_apart = V3::Zero(), to = held.to, quicker = held.quicker;
        Matrix P = Matrix::Zero(3, N);
        struct Carrier {
            std::size_t body;
            V3 to_end, to_next;
            std::vector<std::size_t> carried_by; // it and all between it and the ground
        };
        std::vector<Carrier> paths;
        const auto add_end = [&](std::size_t body, const V3& point_b, Real sign) {
            const V3 x = pose.x[body] + pose.R[body] * point_b, x_0 = before.x[body] + before.R[body] * point_b;
            x_apart += sign * x_0;
            const V3 on_ground = R_0.transpose() * (x_0 - p.ground.x(start.time));
            to -= sign * (p.ground.x(start.time + taken.h) + R_1 * on_ground - x_0);
            const V3 spun = p.ground.omega.cross(V3((R_1 - R_0) * on_ground));
            const V3 pivot = p.ground.omega.cross(V3((R_1 - R_0) * p.ground.pivot));
            quicker -= sign * (p.ground.a * taken.h - pivot + spun);
            V3 next = x;
            for (std::int32_t k = std::int32_t(body); k >= 0; k = tree.parent[std::size_t(k)]) {
                const auto q = std::size_t(k);
                P.block<3, 3>(0, 3 * k) -= sign * (cross(x - pose.x[q]) * pose.R[q] * block(J, 3 * k, 3 * k));
                Carrier link{q, x - pose.x[q], next - pose.x[q], {}};
                for (std::int32_t i = k; i >= 0; i = tree.parent[std::size_t(i)])
                    link.carried_by.push_back(std::size_t(i));
                paths.push_back(link);
                next = pose.x[q];
            }
        };
        add_end(held.body, held.point_b, 1);
        if (held.far >= 0) add_end(std::size_t(held.far), held.far_point_b, -1);
        const V3 rate = times(P, eta_0).col(0);
        const V3 f = -held.k * (x_apart - (held.from + to) / 2) - held.c * (rate - (to - held.from) / taken.h);
        K += sandwich(P, held.k * M3::Identity(), P);
        C += sandwich(P, held.c * M3::Identity(), P);
        force += transposed_times(P, f);
        slope += transposed_times(P, V3(held.k * (to - held.from) + held.c * quicker));
        // By how much the paths' springs and inertias alone would turn for what is more than the last step's force.
        const Real per_metre = held.k + held.c / taken.h;
        const auto own = [&](std::size_t b) {
            const M3 I = p.plan.inertia_joint[b].cast<Real>();
            return std::min(stiffness[3 * Eigen::Index(b)], stiffness[3 * Eigen::Index(b) + 1]) *
                       (1 + Real(tree.damping[b]) * Real(p.plan.scene.damping_scale) / taken.h) +
                   std::min(I(0, 0), I(1, 1)) / (taken.h * taken.h);
        };
        M3 give = M3::Identity() / per_metre;
        for (const Carrier& link : paths) give -= cross(link.to_end) * cross(link.to_end) / own(link.body);
        const V3 answer = give.inverse() * V3((f - held.force) / per_metre);
        Real turns = 0;
        for (const Carrier& link : paths) turns = std::max(turns, link.to_end.cross(answer).norm() / own(link.body));
        const Real strain = std::min(Real(1), turns / Real(0.1L));
        for (const Carrier& link : paths) {
            const V3& arm = link.to_next;
            const Real pull = held.force.norm(),
                       cosine = pull > 0 ? held.force.dot(arm) / (pull * arm.norm()) : Real(1),
                       more = std::max(Real(0), strain * strain * f.norm() - pull);
            const M3 about = arm * arm.transpose() / arm.squaredNorm(), across = M3::Identity() - about;
            const M3 H = arm.norm() *
                         (pull * across + pull * (1 - cosine * cosine) / 2 * about + more * across + more / 2 * about);
            Matrix turn = Matrix::Zero(3, N);
            for (const std::size_t b : link.carried_by) {
                const auto at = 3 * Eigen::Index(b);
                turn.block<3, 3>(0, at) = pose.R[b] * block(J, at, at);
            }
            const Matrix more_turning = sandwich(turn, H, turn);
            K += more_turning;
            K_turning += more_turning;
        }
    }
    // Pulls. H of every body that carries a force at a place, as long as the sum over them is small what a potential's is (by differences of it).
    struct Carried {
        std::size_t body;
        V3 P, f;
    };
    std::vector<V3> acting(n, V3::Zero()); // at the joint: of all that it carries
    std::vector<Carried> carried_forces;
    const auto turn_of = [&](std::size_t body) {
        Matrix turn = Matrix::Zero(3, N);
        for (auto k = std::int32_t(body); k >= 0; k = tree.parent[std::size_t(k)])
            turn.block<3, 3>(0, 3 * k) = pose.R[std::size_t(k)] * block(J, 3 * k, 3 * k);
        return turn;
    };
    for (std::size_t k = 0; k < p.pulls.size(); ++k) {
        const std::size_t body = p.plan.pulls[k].body;
        acting[body] += p.pulls[k];
        carried_forces.push_back({body, pose.R[body] * p.plan.pulls[k].point_b.cast<Real>(), p.pulls[k]});
    }
    for (const Turning& pull : taken.turning) {
        acting[pull.body] += pull.force;
        const Matrix turn = turn_of(pull.body);
        Matrix joint = Matrix::Zero(3, N); // rates of the joint's place
        for (std::int32_t k = tree.parent[pull.body]; k >= 0; k = tree.parent[std::size_t(k)])
            joint.block<3, 3>(0, 3 * k) = -cross(pose.x[pull.body] - pose.x[std::size_t(k)]) * block(turn, 0, 3 * k);
        const V3 arm = pose.R[pull.body] * pull.point_b, m = arm.cross(pull.force), f = pull.force;
        force += transposed_times(joint, f) + transposed_times(turn, m);
        slope += transposed_times(joint, pull.change) + transposed_times(turn, V3(arm.cross(pull.change)));
        const Matrix more = sandwich(joint, cross(f), turn) + sandwich(turn, cross(m) / 2, turn);
        K += more;
        K_turning += more;
    }
    std::vector<Real> give(n);
    for (std::size_t b = 0; b < n; ++b) {
        const M3 I = p.plan.inertia_joint[b].cast<Real>();
        const auto at = 3 * Eigen::Index(b);
        give[b] = 1 / (std::min(stiffness[at], stiffness[at + 1]) *
                           (1 + Real(tree.damping[b]) * Real(p.plan.scene.damping_scale) / taken.h) +
                       std::min(I(0, 0), I(1, 1)) / (taken.h * taken.h));
        if (tree.parent[b] >= 0) give[b] += give[std::size_t(tree.parent[b])];
    }
    for (std::size_t b = n; b-- > 1;) {
        const auto q = std::size_t(tree.parent[b]);
        acting[q] += acting[b];
        carried_forces.push_back({q, pose.x[b] - pose.x[q], acting[b]});
    }
    Real share = 0;
    for (const Carried& on : carried_forces) share += on.P.norm() * on.f.norm() * give[on.body];
    const Real w = std::min(Real(1), share * share);
    for (const Carried& on : carried_forces) {
        const auto curvature = [&](const V3& along) { // of -f . (turned P) as it turns
            const auto potential = [&](Real s) { return Vector::Constant(1, -on.f.dot(turned(V3(s * along)) * on.P)); };
            return Real(second_derivative(potential)[0]);
        };
        M3 H;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                H(r, c) = (curvature(V3::Unit(r) + V3::Unit(c)) - curvature(V3::Unit(r) - V3::Unit(c))) / 4;
        H *= 1 - w;
        const Real size = on.f.norm() * on.P.norm(), cosine = size > 0 ? on.f.dot(on.P) / size : Real(1);
        const M3 about = on.P * on.P.transpose() / on.P.squaredNorm();
        H += w * size * (M3::Identity() - about + (1 - cosine * cosine) / 2 * about);
        const Matrix turn = turn_of(on.body), more = sandwich(turn, H, turn);
        K += more;
        K_turning += more;
    }
    const Matrix M = times(transposed_times(J, solved.M), J);
    const auto inverse = M.partialPivLu();
    const Vector eta_dot = J.partialPivLu().solve(solved.rate_dot - bias);

    Matrix W = Matrix::Zero(2 * N + 2, 2 * N + 2);
    W.block(0, N, N, N).setIdentity();
    W.block(N, 0, N, N) = -inverse.solve(K);
    W.block(N, N, N, N) = -inverse.solve(C);
    const Vector rise = inverse.solve(slope);
    W.block(N, 2 * N, N, 1) = rise;
    W.block(0, 2 * N + 1, N, 1) = eta_0;
    W.block(N, 2 * N + 1, N, 1) =
        eta_dot + inverse.solve(Vector(times(K_turning, theta_ahead) + times(C_moving, eta_ahead) + force)) - rise / 2;
    W(2 * N, 2 * N + 1) = 1 / taken.h;
    W *= taken.h;
    const rational::Function R = rational::of(scheme);
    const Vector last = polynomial(R.N, W).col(2 * N + 1);
    return polynomial(R.D, W).partialPivLu().solve(last).head(2 * N);
}

} // namespace dense
