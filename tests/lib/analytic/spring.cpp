// One joint's step against closed forms of its linear system, Jacobi's eigenvectors against Eigen's solver, energy.
#include "lib/analytic/spring.h"
#include "lib/analytic/composite.h"
#include "lib/analytic/joint.h"
#include "lib/base/symmetric_eigen.h"
#include "lib/plan/spring_torque.h"
#include "lib/study/solvers.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <complex>
#include <unsupported/Eigen/MatrixFunctions>

using namespace bough;
using namespace solver;

namespace {

using Wide = long double;
using Complex = std::complex<Wide>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// A rod with three different springs.
Tree rod() {
    Tree tree = make_tree::chain(1, 1.2, 0.02, 0.01);
    tree.stiffness[0] = {40, 55, 12};
    tree.damping[0] = 0.004;
    return tree;
}

// A body without symmetry: axes of inertia turned against the joint's, centre of mass off the axis.
Tree lump() {
    Tree tree = rod();
    const Mat3 R = make_tree::turn(0.8, {1, 2, 3}).toRotationMatrix();
    tree.mass[0] = 1.7;
    tree.com[0] = {0.05, -0.1, 0.4};
    tree.inertia[0] = R * Vec3(0.05, 0.08, 0.11).asDiagonal() * R.transpose();
    return tree;
}

Mat3 about_joint(const Tree& tree) {
    const Vec3& c = tree.com[0];
    return tree.inertia[0] + tree.mass[0] * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
}

// Angle and rate of one joint, with the rate that the springs carry (theta_dot and theta along one axis, or tiny).
void set_joint(const Plan<double>& plan, State<double>& state, const Vec3& theta, const Vec3& rate,
               const Mat3& inertia) {
    state.theta[0] = theta;
    state.theta_dot[0] = rate;
    parts::scaled_rate(state)[0] = Mat3(inertia.llt().matrixL()).transpose() * rate;
    state_update(plan, state);
}

} // namespace

TEST_CASE("a joint about one of its axes follows the closed form of a damped oscillator") {
    const Tree tree = rod();
    const Mat3 S = about_joint(tree);
    const auto paper_or_branch = GENERATE(JointInertia::paper, JointInertia::branch);
    const auto beta = GENERATE(0.0, 0.004, 0.5);
    for (int axis = 0; axis < 3; ++axis) {
        Scene scene = empty_scene();
        scene.joint_inertia = paper_or_branch;
        Tree damped = tree;
        damped.damping[0] = beta;
        const double h = 1.0 / 30;
        const auto plan = plan_of(damped, scene, h);
        State<double> state = make_state(plan);
        const double q0 = 0.9, v0 = -3;
        set_joint(plan, state, q0 * Vec3::Unit(axis), v0 * Vec3::Unit(axis), S);
        const Wide l = tree.stiffness[0][axis] / Wide(S(axis, axis)), g = beta * l / 2;
        const Complex mu = std::sqrt(Complex(g * g - l));
        for (int k = 1; k <= 300; ++k) {
            advance(plan, state);
            const Wide t = k * Wide(h);
            const Complex r1 = -g + mu, r2 = -g - mu;
            const Complex a = (Complex(v0) - r2 * Complex(q0)) / (Complex(2) * mu), b = Complex(q0) - a;
            const Wide q = (a * std::exp(r1 * t) + b * std::exp(r2 * t)).real();
            const Wide v = (a * r1 * std::exp(r1 * t) + b * r2 * std::exp(r2 * t)).real();
            // Inertia is known to some rounding errors of its trace (joint.h), which shift the phase in proportion to time.
            const Wide blur = 8 * std::numeric_limits<double>::epsilon() * S.trace() / S(axis, axis);
            const Wide limit = 1e-12L + blur * std::abs(mu) * t;
            const Wide amplitude = q0 + std::abs(v0) / std::sqrt(l);
            CAPTURE(axis, beta, k);
            REQUIRE(std::abs(state.theta[0][axis] - q) < limit * amplitude);
            REQUIRE(std::abs(state.theta_dot[0][axis] - v) < limit * amplitude * std::sqrt(l));
            REQUIRE(state.theta[0].cwiseAbs().sum() - std::abs(state.theta[0][axis]) < 1e-12);
        }
    }
}

TEST_CASE("tiny turns of an unsymmetric body under a pull follow the matrix exponential") {
    const Tree tree = lump();
    const Mat3 S = about_joint(tree), K = tree.stiffness[0].asDiagonal();
    const auto plan_for = [&](double h) {
        Scene scene = empty_scene();
        Pull pull; // at the centre of mass
        pull.time = {0, 100};
        pull.force = {Vec3(3e-6, -2e-6, 5e-6), Vec3(3e-6, -2e-6, 5e-6)};
        scene.pulls.push_back(pull);
        return plan_of(tree, scene, h);
    };
    const Mat3 R = tree.joint_rotation[0].toRotationMatrix();
    const Vec3 tau = tree.com[0].cross(Vec3(R.transpose() * Vec3(3e-6, -2e-6, 5e-6)));
    Matrix6 A = Matrix6::Zero();
    A.topRightCorner<3, 3>().setIdentity();
    A.bottomLeftCorner<3, 3>() = -S.inverse() * K;
    A.bottomRightCorner<3, 3>() = -tree.damping[0] * S.inverse() * K;
    const Vec3 rest = K.inverse() * tau, theta(1e-7, -0.7e-7, 0.4e-7), rate(2e-6, 1e-6, -3e-6);
    for (double h : {1.0 / 240, 1.0 / 30, 0.3}) {
        const auto plan = plan_for(h);
        State<double> state = make_state(plan);
        set_joint(plan, state, theta, rate, S);
        Vector6 y;
        y << theta - rest, rate;
        const Matrix6 propagator = (A * h).exp();
        for (int k = 0; k < 100; ++k) {
            advance(plan, state);
            y = propagator * y;
            CAPTURE(h, k);
            // What is left out is of second order in the angle.
            REQUIRE((state.theta[0] - rest - y.head<3>()).norm() < 1e-12);
            REQUIRE((state.theta_dot[0] - y.tail<3>()).norm() < 3e-11);
        }
    }
}

TEST_CASE("without damping a joint keeps its energy at any angle") {
    Tree tree = lump();
    tree.damping[0] = 0;
    const auto plan = plan_of(tree, empty_scene());
    for (double size : {1e-6, 0.3}) {
        State<double> state = make_state(plan);
        set_joint(plan, state, size * Vec3(1, -0.5, 0.3), size * Vec3(3, 2, -4), about_joint(tree));
        const auto energy = [&] {
            return state.theta[0].dot(tree.stiffness[0].cwiseProduct(state.theta[0])) / 2 +
                   parts::scaled_rate(state)[0].squaredNorm() / 2;
        };
        const double start = energy();
        for (int k = 0; k < 10000; ++k) advance(plan, state);
        CAPTURE(size);
        CHECK(std::abs(energy() / start - 1) * 1e12 < (size < 1e-3 ? 1 : 10)); // rounding, 1e4 times
    }
}

TEST_CASE("what is carried is the kinetic energy of the joint's inertia") {
    const Tree tree = lump();
    const auto plan = plan_of(tree, empty_scene());
    State<double> state = make_state(plan);
    set_joint(plan, state, Vec3(1e-7, 0, 2e-7), Vec3(1, 2, -1) * 1e-3, about_joint(tree));
    advance(plan, state);
    const Vec3 omega = body_rate_jacobian(state.theta[0]) * state.theta_dot[0];
    CHECK(parts::scaled_rate(state)[0].squaredNorm() == Approx(omega.dot(about_joint(tree) * omega)).epsilon(1e-12));
}

TEST_CASE("a single body has one inertia, the paper's and the branch's") {
    const Tree tree = lump();
    Scene paper = empty_scene(), branch = empty_scene();
    paper.joint_inertia = JointInertia::paper;
    branch.joint_inertia = JointInertia::branch;
    const auto one = plan_of(tree, paper), other = plan_of(tree, branch);
    State<double> a = make_state(one), b = make_state(other);
    set_joint(one, a, {0.3, 0.2, -0.1}, {1, 2, 3}, about_joint(tree));
    set_joint(other, b, {0.3, 0.2, -0.1}, {1, 2, 3}, about_joint(tree));
    for (int k = 0; k < 50; ++k) advance(one, a), advance(other, b);
    CHECK((a.theta[0] - b.theta[0]).norm() < 1e-12);
    CHECK(a.theta[0].norm() > 1e-3);
}

TEST_CASE("the torque of spring and damper is the energy's gradient for turns in the joint frame") {
    const Tree tree = lump();
    const auto plan = plan_of(tree, empty_scene(), 1.0 / 30, Wishes{false, true});
    State<double> state = make_state(plan);
    const Vec3 theta(0.8, -0.5, 0.3);
    state.theta[0] = theta;
    spring_torque(plan, state);
    const auto elastic = [&](const Vec3& turn_j) { // the body turned on by a small rotation in joint axes
        const Vec3 t = vector_from_quaternion<double>(quaternion_from_vector(turn_j) * quaternion_from_vector(theta));
        return t.dot(tree.stiffness[0].cwiseProduct(t)) / 2;
    };
    const double e = 1e-5;
    for (int k = 0; k < 3; ++k) {
        const double slope = (elastic(e * Vec3::Unit(k)) - elastic(-e * Vec3::Unit(k))) / (2 * e);
        CHECK(state.torque_j[0][k] == Approx(-slope).epsilon(1e-8));
    }
}

TEMPLATE_TEST_CASE("symmetric_eigen finds what Eigen's solver finds", "", float, double) {
    using T = TestType;
    const T e = std::numeric_limits<T>::epsilon();
    for (const Vec3& values : {Vec3(1, 2, 3), Vec3(1, 1, 1), Vec3(2, 2, 5), Vec3(1e-3, 1, 1e3), Vec3(-4, 0.5, 9),
                               Vec3(0, 0, 0), Vec3(0, 0, 7), Vec3(1, 1 + 1e-12, 1 + 2e-12), Vec3(1e-18, 1, 1e18)})
        for (unsigned seed = 0; seed < 20; ++seed) {
            make_tree::Dice dice{std::mt19937(seed)};
            const Quat q(dice(-1, 1), dice(-1, 1), dice(-1, 1), dice(-1, 1));
            const Mat3 R = seed == 0 ? Mat3(Mat3::Identity()) : q.normalized().toRotationMatrix();
            const Mat3 wide = R * values.asDiagonal() * R.transpose();
            const Matrix3<T> A = Mat3((wide + wide.transpose()) / 2).cast<T>();
            Matrix3<T> X;
            Vector3<T> found;
            symmetric_eigen(A, X, found);
            const T size = A.cwiseAbs().maxCoeff();
            CAPTURE(values.transpose(), seed);
            CHECK((X.transpose() * X - Matrix3<T>::Identity()).cwiseAbs().maxCoeff() < 10 * e);
            CHECK((A * X - X * found.asDiagonal()).cwiseAbs().maxCoeff() <= 10 * e * size);
            const Eigen::SelfAdjointEigenSolver<Matrix3<T>> expected(A, Eigen::EigenvaluesOnly);
            std::sort(found.data(), found.data() + 3);
            CHECK((found - expected.eigenvalues()).cwiseAbs().maxCoeff() <= 10 * e * size);
        }
}

TEST_CASE("small eigenvalues of a scaled matrix keep their relative accuracy") {
    // D A D with A well conditioned: Jacobi's are accurate to A's condition, however wide D spreads them.
    const Vec3 D(1e-8, 1, 1e8);
    Mat3 A;
    A << 2, 0.3, -0.2, 0.3, 1, 0.1, -0.2, 0.1, 3;
    Mat3 X;
    Vec3 found;
    symmetric_eigen<double>(D.asDiagonal() * A * D.asDiagonal(), X, found);
    std::sort(found.data(), found.data() + 3);
    // To 1e-16, the leading one, then Schur's complements, then the determinant's rest.
    const double big = A(2, 2), middle = A(1, 1) - A(1, 2) * A(1, 2) / big, small = A.determinant() / (big * middle);
    CHECK(found[2] == Approx(1e16 * big).epsilon(1e-14));
    CHECK(found[1] == Approx(middle).epsilon(1e-14));
    CHECK(found[0] == Approx(1e-16 * small).epsilon(1e-14));
}
