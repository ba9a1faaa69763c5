#include "small_motion.h"
#include "../base/cholesky.h"
#include "../plan/sag.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

Vec3 times(const double (&s)[6], const Vec3& v) {
    return {s[0] * v.x() + s[1] * v.y() + s[2] * v.z(), s[1] * v.x() + s[3] * v.y() + s[4] * v.z(),
            s[2] * v.x() + s[4] * v.y() + s[5] * v.z()};
}
Vec3 solve_lower(const double (&l)[6], const Vec3& b) {
    const double x = b.x() / l[0], y = (b.y() - l[1] * x) / l[2];
    return {x, y, (b.z() - l[3] * x - l[4] * y) / l[5]};
}
Vec3 solve_upper(const double (&l)[6], const Vec3& b) { // L^T x = b
    const double z = b.z() / l[5], y = (b.y() - l[4] * z) / l[2];
    return {(b.x() - l[1] * y - l[3] * z) / l[0], y, z};
}

// t2 = (1 - (a/2) cot(a/2)) / a^2 and t2' / a. Bernoulli's series up to a = 1: its terms fall by (a / 2 pi)^2.
struct InverseTerm {
    double t2, slope;
};
InverseTerm inverse_term(double a) {
    if (a > 1) {
        const double s = std::sin(a / 2), c = std::cos(a / 2), half = a / 2 * c / s;
        const double half_slope = c / (2 * s) - a / (4 * s * s);
        return {(1 - half) / (a * a), (-half_slope / (a * a) - 2 * (1 - half) / (a * a * a)) / a};
    }
    // |B_2n| / (2n)!, n = 1 ..
    static constexpr double series[] = {1. / 12,          1. / 720,
                                        1. / 30240,       1. / 1209600,
                                        1. / 47900160,    691. / 1307674368000,
                                        1. / 74724249600, 3617. / 10670622842880000};
    InverseTerm term{0, 0};
    double power = 1, before = 0; // a^2k, a^2(k-1)
    for (int k = 0; k < 8; ++k) {
        term.t2 += series[k] * power;
        term.slope += 2 * k * series[k] * before;
        before = power;
        power *= a * a;
    }
    return term;
}

// S in the joint frame, as above.
Mat3 spring_curvature(const Vec3& K, const Vec3& theta) {
    const Mat3 F = body_rate_jacobian_inverse(theta).transpose(), X = cross_matrix(theta);
    const InverseTerm term = inverse_term(theta.norm());
    const Vec3 torque = K.cwiseProduct(theta);
    Mat3 more; // column b: gradient of torque . F(theta) e along F e_b
    for (int b = 0; b < 3; ++b) {
        const Vec3 v = F.col(b);
        const Mat3 V = cross_matrix(v);
        const Mat3 dF = -0.5 * V + term.t2 * (V * X + X * V) + term.slope * theta.dot(v) * X * X;
        more.col(b) = dF.transpose() * torque;
    }
    return F.transpose() * K.asDiagonal() * F + (more + more.transpose()) / 2;
}

} // namespace

SmallMotion::SmallMotion(const Tree& tree, const Vec3& gravity, Pose pose)
    : gravity_(gravity), pose_(start_pose(tree, gravity, pose == Pose::rest ? Pose::settled : pose)) {
    body_.resize(tree.size_bodies());
    stand(tree);
    if (factor(tree, false) >= 0) go_over(tree);
}

void SmallMotion::stand(const Tree& tree) {
    const std::size_t n = body_.size();
    R_.resize(n);
    x_.resize(n);
    rates_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto p = std::size_t(tree.parent[i]);
        const bool root = tree.parent[i] < 0;
        R_[i] = frame_of(tree, pose_.joint_rotation, i, R_, pose_.theta[i]);
        const Mat3 R_pj = pose_.joint_rotation[i].toRotationMatrix(), R_j = root ? R_pj : Mat3(R_[p] * R_pj);
        rates_[i] = body_rate_jacobian_inverse(pose_.theta[i]).transpose() * R_j.transpose();
        Body& body = body_[i];
        body.parent = tree.parent[i];
        body.arm = root ? Vec3(Vec3::Zero()) : Vec3(R_[p] * tree.joint_position[i]);
        x_[i] = root ? tree.joint_position[i] : Vec3(x_[p] + body.arm);
        body.mass = tree.mass[i];
        const Vec3 c = R_[i] * tree.com[i];
        body.moment = body.mass * c;
        const Mat3 J = R_[i] * tree.inertia[i] * R_[i].transpose() +
                       body.mass * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
        const double six[6] = {J(0, 0), J(0, 1), J(0, 2), J(1, 1), J(1, 2), J(2, 2)};
        std::copy(six, six + 6, body.J);
    }
}

std::int64_t SmallMotion::factor(const Tree& tree, bool lift) {
    const std::size_t n = body_.size();
    const std::vector<Vec3> H = carried_moments();
    std::vector<Mat3> A(n, Mat3::Zero());
    std::int64_t soft = -1;
    for (std::size_t i = n; i-- > 0;) {
        Body& body = body_[i];
        const Mat3 R_j = R_[i] * rotation_from_vector<double>(-pose_.theta[i]);
        const Mat3 gH = gravity_ * H[i].transpose();
        const Mat3 level = gravity_.dot(H[i]) * Mat3::Identity();
        const Mat3 S = R_j * spring_curvature(tree.stiffness[i], pose_.theta[i]) * R_j.transpose();
        Mat3 W = S + level - (gH + gH.transpose()) / 2 + A[i];
        Cholesky<double> factored(W);
        if (!factored.positive) {
            soft = std::int64_t(i);
            if (!lift) return soft;
            const Eigen::SelfAdjointEigenSolver<Mat3> block(W);
            soft_axis_ = block.eigenvectors().col(0);
            const double more = 1e-3 * S.trace() - 1.5 * std::min(block.eigenvalues()[0], 0.0);
            A[i].diagonal().array() += more;
            W.diagonal().array() += more;
            factored = Cholesky<double>(W);
        }
        const Mat3& L = factored.L;
        const double six[6] = {L(0, 0), L(1, 0), L(1, 1), L(2, 0), L(2, 1), L(2, 2)};
        std::copy(six, six + 6, body.L);
        const Mat3 C = level - gH + A[i];
        body.W_C = C;
        solve_lower(L, body.W_C);
        solve_lower_transposed(L, body.W_C);
        if (body.parent >= 0) A[std::size_t(body.parent)] += A[i] - C.transpose() * body.W_C;
    }
    return soft;
}

std::vector<Vec3> SmallMotion::carried_moments() const {
    std::vector<Vec3> H(body_.size(), Vec3::Zero());
    std::vector<double> carried(body_.size());
    for (std::size_t i = body_.size(); i-- > 0;) { // children before their parent
        H[i] += body_[i].moment;
        carried[i] += body_[i].mass;
        if (body_[i].parent < 0) continue;
        const auto p = std::size_t(body_[i].parent);
        H[p] += H[i] + carried[i] * body_[i].arm;
        carried[p] += carried[i];
    }
    return H;
}

std::vector<Vec3> SmallMotion::unbalanced(const Tree& tree) const {
    std::vector<Vec3> torque = carried_moments();
    for (std::size_t i = 0; i < torque.size(); ++i)
        torque[i] =
            torque[i].cross(gravity_).eval() - rates_[i].transpose() * tree.stiffness[i].cwiseProduct(pose_.theta[i]);
    return torque;
}

double SmallMotion::energy(const Tree& tree) const {
    double energy = 0;
    for (std::size_t i = 0; i < body_.size(); ++i)
        energy += pose_.theta[i].dot(tree.stiffness[i].cwiseProduct(pose_.theta[i])) / 2 -
                  gravity_.dot(body_[i].mass * x_[i] + body_[i].moment);
    return energy;
}

std::vector<Vec3> SmallMotion::softest(std::size_t body) const {
    std::vector<Vec3> a(body_.size(), Vec3::Zero()), phi(body_.size(), Vec3::Zero());
    a[body] = phi[body] = 0.05 * soft_axis_;
    for (std::size_t i = body + 1; i < body_.size(); ++i) {
        if (body_[i].parent < 0) continue;
        const Vec3& base = phi[std::size_t(body_[i].parent)];
        a[i] = -body_[i].W_C * base;
        phi[i] = base + a[i];
    }
    return a;
}

// Where a branch buckles, downhill.
void SmallMotion::go_over(const Tree& tree) {
    const auto refuse = [&](std::int64_t i, const std::string& why) {
        throw std::domain_error("body " + std::to_string(i) + " of branch " +
                                std::to_string(tree.branch[std::size_t(i)]) + why);
    };
    Eigen::VectorXd y(rows());
    double now = energy(tree);
    // Takes a step of a in half turns at most, halved until the energy falls. False where it does not.
    const auto step = [&](const std::vector<Vec3>& a) {
        const StartPose before = pose_;
        double largest = 0;
        for (const Vec3& turn : a) largest = std::max(largest, turn.norm());
        std::vector<Mat3> to_joint(a.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            to_joint[i] = rotation_from_vector<double>(before.theta[i]) * R_[i].transpose();
        const double first = std::min(1.0, 0.5 / largest);
        for (double scale = first; scale > 1e-9 * first; scale /= 2) {
            for (std::size_t i = 0; i < a.size(); ++i)
                pose_.theta[i] =
                    vector_from_quaternion<double>(quaternion_from_vector<double>(Vec3(scale * (to_joint[i] * a[i]))) *
                                                   quaternion_from_vector<double>(before.theta[i]));
            stand(tree);
            if (const double then = energy(tree); then < now) {
                now = then;
                return true;
            }
        }
        pose_ = before;
        stand(tree);
        return false;
    };
    for (int iteration = 0; iteration < 3000; ++iteration) {
        const std::int64_t soft = factor(tree, true);
        inward(unbalanced(tree), y.data());
        std::vector<Vec3> a = turns(y.data());
        double largest = 0;
        for (const Vec3& turn : a) largest = std::max(largest, turn.norm());
        if (!std::isfinite(largest)) break;
        if (soft < 0 && largest < 1e-9) return;
        if (soft >= 0 && largest < 1e-3) { // a balance, but none that stands
            if (!(tree.stiffness[std::size_t(soft)].minCoeff() > 0))
                refuse(soft, " has a free axis (K = 0): the tree does not stand");
            if (buckled_.empty() || buckled_.back() != std::size_t(soft)) buckled_.push_back(std::size_t(soft));
            const std::vector<Vec3> worst = softest(std::size_t(soft));
            for (std::size_t i = 0; i < a.size(); ++i) a[i] += worst[i];
        }
        if (!step(a)) break;
    }
    if (const std::int64_t soft = factor(tree, false); soft >= 0)
        refuse(soft, std::string(" buckles under what it carries, and no pose is found in which the tree stands; ") +
                         buckling_remedy);
}

std::vector<Vec3> SmallMotion::turns(const double* y) const {
    std::vector<Vec3> a(body_.size()), phi(body_.size());
    for (std::size_t i = 0; i < body_.size(); ++i) {
        const Body& body = body_[i];
        a[i] = solve_upper(body.L, Eigen::Map<const Vec3>(y + 3 * i));
        phi[i] = a[i];
        if (body.parent < 0) continue;
        const Vec3& base = phi[std::size_t(body.parent)];
        a[i] -= body.W_C * base;
        phi[i] = base + a[i];
    }
    return a;
}

std::vector<SmallMotion::Motion> SmallMotion::motion(const std::vector<Vec3>& a) const {
    std::vector<Motion> moved(body_.size());
    for (std::size_t i = 0; i < body_.size(); ++i) {
        const Body& body = body_[i];
        Motion& m = moved[i];
        m.turn = a[i];
        m.joint = Vec3::Zero();
        if (body.parent >= 0) {
            const Motion& base = moved[std::size_t(body.parent)];
            m.turn += base.turn;
            m.joint = base.joint + base.turn.cross(body.arm);
        }
        m.com = m.joint + m.turn.cross(body.moment) / body.mass;
    }
    return moved;
}

void SmallMotion::inward(const std::vector<Vec3>& torque, double* out) const {
    std::vector<Vec3> dual(body_.size(), Vec3::Zero()); // of phi, by what the children's y have of it
    for (std::size_t i = body_.size(); i-- > 0;) {
        const Body& body = body_[i];
        const Vec3 of_turn = torque[i] + dual[i];
        Eigen::Map<Vec3>(out + 3 * i) = solve_lower(body.L, of_turn);
        if (body.parent >= 0) dual[std::size_t(body.parent)] += dual[i] - body.W_C.transpose() * of_turn;
    }
}

void SmallMotion::inward(std::vector<Moving>& work, double* out) const {
    for (Moving& m : work) m.turn.setZero(); // from here on what the children's y have of it
    for (std::size_t i = body_.size(); i-- > 0;) {
        const Body& body = body_[i];
        const Moving& m = work[i];
        const Vec3 of_turn = m.angular + m.turn;
        Eigen::Map<Vec3>(out + 3 * i) = solve_lower(body.L, of_turn);
        if (body.parent < 0) continue;
        Moving& base = work[std::size_t(body.parent)];
        base.linear += m.linear;
        base.angular += m.angular + body.arm.cross(m.linear);
        base.turn += m.turn - body.W_C.transpose() * of_turn;
    }
}

void SmallMotion::operate(const double* y, double* out, std::vector<Moving>& work) const {
    work.resize(body_.size());
    for (std::size_t i = 0; i < body_.size(); ++i) {
        const Body& body = body_[i];
        Moving& m = work[i];
        m.turn = solve_upper(body.L, Eigen::Map<const Vec3>(y + 3 * i));
        m.shift = Vec3::Zero();
        if (body.parent >= 0) {
            const Moving& base = work[std::size_t(body.parent)];
            m.turn += base.turn - body.W_C * base.turn;
            m.shift = base.shift + base.turn.cross(body.arm);
        }
        m.linear = body.mass * m.shift + m.turn.cross(body.moment);
        m.angular = times(body.J, m.turn) + body.moment.cross(m.shift);
    }
    inward(work, out);
}

Eigen::VectorXd SmallMotion::excited(const Vec3& direction) const {
    std::vector<Moving> work(body_.size());
    for (std::size_t i = 0; i < body_.size(); ++i) {
        work[i].linear = body_[i].mass * direction;
        work[i].angular = body_[i].moment.cross(direction);
    }
    Eigen::VectorXd out(rows());
    inward(work, out.data());
    return out;
}

} // namespace bough
