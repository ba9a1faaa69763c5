#include "lib/model/sway.h"
#include "lib/growth/segment.h"
#include "tests/support/make_tree.h"
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

using namespace bough;

namespace {

// An upright rod of 4 m, base radius r, tip radius r_tip, cut into n pieces.
Tree rod(double r, double r_tip, int n) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {{0, 0, 0}, {0, 4, 0}};
    s.radius = {r, r_tip};
    SegmentOptions options;
    options.segment_length = 4.0 / n;
    return segment(s, wood_presets().front(), options);
}

using Dense = Eigen::MatrixXd;
using Coordinates = Eigen::VectorXd; // three angles a joint, about its own axes

struct Pose {
    std::vector<Eigen::Matrix3d> R_wb;
    std::vector<Eigen::Vector3d> com;
};

Pose posed(const Tree& tree, const Coordinates& angles) {
    Pose pose;
    std::vector<Eigen::Vector3d> joint;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Eigen::Vector3d turn = angles.segment<3>(Eigen::Index(3 * i));
        const Eigen::AngleAxisd own(turn.norm(), turn.norm() > 0 ? turn.normalized() : Eigen::Vector3d::UnitX());
        Eigen::Matrix3d R = tree.joint_rotation[i].toRotationMatrix();
        Eigen::Vector3d at = tree.joint_position[i];
        if (tree.parent[i] >= 0) {
            const auto p = std::size_t(tree.parent[i]);
            at = joint[p] + pose.R_wb[p] * at;
            R = pose.R_wb[p] * R;
        }
        joint.push_back(at);
        pose.R_wb.push_back(R * own.toRotationMatrix());
        pose.com.push_back(at + pose.R_wb.back() * tree.com[i]);
    }
    return pose;
}

// By differences of poses: M, the springs' K, K_g of the weight (one more difference), the force of a steady sideways
// acceleration.
struct Linear {
    Dense M, K, K_g;
    Coordinates force;
};

Linear linear(const Tree& tree, const Vec3& direction, double gravity) {
    const auto n = Eigen::Index(3 * tree.size_bodies());
    const Linear zero{Dense::Zero(n, n), Dense::Zero(n, n), Dense::Zero(n, n), Coordinates::Zero(n)};
    Linear result = zero;
    const double h = 1e-5;
    const auto at = [&](Eigen::Index k, double angle) { return posed(tree, angle * Coordinates::Unit(n, k)); };
    const Pose drawn = posed(tree, Coordinates::Zero(n));
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        result.K.diagonal().segment<3>(Eigen::Index(3 * i)) = tree.stiffness[i];
    std::vector<Dense> moved(tree.size_bodies(), Dense(3, n)), turned(tree.size_bodies(), Dense(3, n));
    for (Eigen::Index k = 0; k < n; ++k) {
        const Pose more = at(k, h), less = at(k, -h);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            moved[i].col(k) = (more.com[i] - less.com[i]) / (2 * h);
            const Eigen::Matrix3d spin =
                drawn.R_wb[i].transpose() * (more.R_wb[i] - less.R_wb[i]) / (2 * h); // in the body's axes
            turned[i].col(k) = Eigen::Vector3d(spin(2, 1), spin(0, 2), spin(1, 0));
        }
    }
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        result.M +=
            tree.mass[i] * moved[i].transpose() * moved[i] + turned[i].transpose() * tree.inertia[i] * turned[i];
        result.force += tree.mass[i] * moved[i].transpose() * direction;
    }
    if (gravity == 0) return result;
    const auto energy = [&](const Coordinates& angles) {
        const Pose pose = posed(tree, angles);
        double sum = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            sum += gravity * tree.mass[i] * (pose.com[i] - drawn.com[i]).y();
        return sum;
    };
    const double step = 1e-3;
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b <= a; ++b) {
            const Coordinates x = step * Coordinates::Unit(n, a), y = step * Coordinates::Unit(n, b);
            result.K_g(a, b) = result.K_g(b, a) =
                (energy(x + y) - energy(x - y) - energy(y - x) + energy(-x - y)) / (4 * step * step);
        }
    return result;
}

// omega^2 of the shape under the steady acceleration, and the lowest of all.
std::pair<double, double> dense_sway(const Tree& tree, const Vec3& direction, double gravity) {
    const Linear l = linear(tree, direction, gravity);
    const Coordinates u = l.K.diagonal().cwiseInverse().cwiseProduct(l.force);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Dense> modes(l.K + l.K_g, l.M, Eigen::EigenvaluesOnly);
    return {u.dot((l.K + l.K_g) * u) / u.dot(l.M * u), modes.eigenvalues()(0)};
}

double squared_pulsation(const Tree& tree, const Vec3& direction, double gravity) {
    return std::pow(2 * M_PI * sway_frequency(tree, direction, gravity), 2);
}

} // namespace

TEST_CASE("The sway of branched trees is Rayleigh's quotient of matrices assembled by differences") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Tree tree = make_tree::random_tree(30, seed);
        for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(0.6, 0, -0.8)}) {
            const auto [quotient, lowest] = dense_sway(tree, direction, 0);
            CHECK(squared_pulsation(tree, direction, 0) == Approx(quotient).epsilon(1e-6));
            CHECK(squared_pulsation(tree, direction, 0) >= lowest * (1 - 1e-6));
        }
    }
}

TEST_CASE("In a plane the weight's part is the second difference of its energy") {
    // A trunk of four pieces that leans, a side branch off its axis and a twig, all in the plane of x and y.
    Tree tree;
    const Vec3 across = Vec3::UnitY(); // out of the plane, once the trunk is upright
    for (int i = 0; i < 4; ++i)
        make_tree::add_piece(tree, i - 1, i == 0 ? Vec3::Zero() : Vec3(0, 0, 0.5),
                             i == 0 ? Quat(make_tree::upright() * make_tree::turn(0.2, across))
                                    : make_tree::turn(0.1, across),
                             0.5, 0.014 - 0.001 * i, 0.013 - 0.001 * i, 0, 0, 0.25 * i);
    make_tree::add_piece(tree, 1, {-0.01, 0, 0.3}, make_tree::turn(-1, across), 0.4, 0.008, 0.006, 1, 1, 0);
    make_tree::add_piece(tree, 4, {0, 0, 0.4}, make_tree::turn(0.3, across), 0.4, 0.006, 0.004, 1, 1, 0.5);
    make_tree::add_piece(tree, 4, {0, 0, 0.2}, make_tree::turn(-0.8, across), 0.3, 0.005, 0.003, 2, 2, 0);
    const double still = squared_pulsation(tree, Vec3::UnitX(), 0);
    for (const double gravity : {9.81, -9.81}) {
        const auto [quotient, lowest] = dense_sway(tree, Vec3::UnitX(), gravity);
        CHECK(squared_pulsation(tree, Vec3::UnitX(), gravity) == Approx(quotient).epsilon(1e-4));
        CHECK(squared_pulsation(tree, Vec3::UnitX(), gravity) >= lowest * (1 - 1e-4));
        CHECK(std::abs(quotient / still - 1) > 0.01); // the weight counts
    }
}

TEST_CASE("A rod's sway is the cantilever's first frequency") {
    const Material& wood = wood_presets().front();
    const double beam = 2 * 0.03 / 16 * std::sqrt(wood.youngs_modulus / wood.density);
    // Rayleigh's quotient of the static shape is 0.4 % above for the uniform rod; 80 pieces add less than 0.1 %.
    CHECK(sway_frequency(rod(0.03, 0.03, 80), Vec3::UnitX(), 0) == Approx(0.1399 * beam).epsilon(0.008));
    CHECK(sway_frequency(rod(0.03, 0.03, 80), Vec3::UnitZ(), 0) == Approx(0.1399 * beam).epsilon(0.008));
    const double cone = sway_frequency(rod(0.03, 3e-4, 160), Vec3::UnitX(), 0) / (0.3469 * beam);
    CHECK(cone > 1);
    CHECK(cone < 1.04);
}

TEST_CASE("Weight slows a standing rod and quickens a hanging one") {
    // Ritz with the shape of a uniform load: omega^2 falls by the weight over the buckling weight 7.84 E I / L^2, to 2 %.
    const Material& wood = wood_presets().front();
    const double radius = 0.006, length = 4, area = M_PI * radius * radius;
    const double weight = wood.density * area * length * 9.81;
    const double buckling = 7.837 * wood.youngs_modulus * M_PI / 4 * std::pow(radius, 4) / (length * length);
    REQUIRE(weight < 0.9 * buckling);
    REQUIRE(weight > 0.3 * buckling);
    Tree tree = rod(radius, radius, 80);
    const double still = sway_frequency(tree, Vec3::UnitX(), 0);
    const double standing = std::pow(sway_frequency(tree, Vec3::UnitX()) / still, 2);
    CHECK(standing == Approx(1 - weight / buckling).margin(0.02));
    tree.joint_rotation[0] = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())); // hanging from the ceiling
    CHECK(std::pow(sway_frequency(tree, Vec3::UnitX()) / still, 2) == Approx(1 + weight / buckling).margin(0.02));
    CHECK(sway_frequency(rod(0.002, 0.002, 80), Vec3::UnitX()) == 0); // longer than it can stand
}
