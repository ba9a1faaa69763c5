// Natural frequencies and shapes (modes.h), held against closed forms and against a dense eigenproblem whose matrices come another way: M of bodies'
// displacements, K of the potential energy's second derivatives by hyper-dual numbers.
#include "lib/study/modes.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/plan/pose.h"
#include "tests/support/hyper_dual.h"
#include "tests/support/lanes_support.h"
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>

using namespace bough;
using namespace hyper_dual;

namespace {

using std::numbers::pi;

// [J] of bodies `which` and their springs where joint `one` is turned by e1 about axis k1 and joint `two` by e2 about k2 (world axes).
struct ModeEnergy {
    const Tree& tree;
    Vec3 gravity;
    std::vector<Quat> rest;
    std::vector<Vec3> theta;
    std::vector<Quat> R; // world from body, standing

    Dual operator()(const std::vector<std::size_t>& path, const std::vector<std::size_t>& beyond, std::size_t one,
                    int k1, std::size_t two, int k2) const {
        std::map<std::size_t, std::pair<DualTurn, DualVector>> at;
        Dual energy;
        const auto visit = [&](std::size_t i) {
            DualTurn base{1, {}};
            DualVector place;
            const Vec3& joint = tree.joint_position[i];
            if (tree.parent[i] >= 0) {
                const auto& [turn, x] = at.at(std::size_t(tree.parent[i]));
                base = turn;
                place = x + turned(turn, joint);
            } else
                place = {joint.x(), joint.y(), joint.z()};
            // The joint's own turning in world axes of the standing pose, seen from the parent's body as it stands.
            Dual e[3];
            if (i == one) e[k1] = e[k1] + Dual(0, 1, 0);
            if (i == two) e[k2] = e[k2] + Dual(0, 0, 1);
            const Quat parent = tree.parent[i] < 0 ? Quat(Quat::Identity()) : R[std::size_t(tree.parent[i])];
            const Quat to_joint = (parent * rest[i]).conjugate();
            DualVector a{};
            for (int k = 0; k < 3; ++k) {
                const Vec3 axis = to_joint * Vec3::Unit(k); // of the joint frame
                a = a + DualVector{e[k] * axis.x(), e[k] * axis.y(), e[k] * axis.z()};
            }
            const Dual square = a.x * a.x + a.y * a.y + a.z * a.z;
            const DualTurn small{Dual(1) - Dual(0.125) * square, {Dual(0.5) * a.x, Dual(0.5) * a.y, Dual(0.5) * a.z}};
            const DualTurn own = small * dual(quaternion_from_vector<double>(theta[i]));
            // theta = 2 atan2(|v|, w) v / |v|
            const Dual vv = own.v.x * own.v.x + own.v.y * own.v.y + own.v.z * own.v.z;
            Dual factor;
            if (vv.a < 1e-20) {
                factor = Dual(2) * chain(own.w, 1 / own.w.a, -1 / (own.w.a * own.w.a), 2 / std::pow(own.w.a, 3));
            } else {
                const double s = std::sqrt(vv.a);
                const Dual length = chain(vv, s, 1 / (2 * s), -1 / (4 * s * vv.a));
                const Dual inverse = chain(length, 1 / s, -1 / (s * s), 2 / (s * s * s));
                const Dual ratio =
                    length * chain(own.w, 1 / own.w.a, -1 / (own.w.a * own.w.a), 2 / std::pow(own.w.a, 3));
                const double r = ratio.a, q = 1 + r * r;
                factor = Dual(2) * chain(ratio, std::atan(r), 1 / q, -2 * r / (q * q)) * inverse;
            }
            const Vec3& K = tree.stiffness[i];
            const Dual angle[3] = {factor * own.v.x, factor * own.v.y, factor * own.v.z};
            for (int k = 0; k < 3; ++k) energy = energy + Dual(K[k] / 2) * angle[k] * angle[k];
            const DualTurn turn = base * dual(rest[i]) * own;
            const DualVector c = place + turned(turn, tree.com[i]);
            const double m = tree.mass[i];
            energy = energy - (Dual(m * gravity.x()) * c.x + Dual(m * gravity.y()) * c.y + Dual(m * gravity.z()) * c.z);
            at[i] = {turn, place};
        };
        for (const std::size_t i : path) visit(i);
        for (const std::size_t i : beyond) visit(i);
        return energy;
    }
};

struct Dense {
    Eigen::MatrixXd K, M;
    Eigen::VectorXd hertz() const {
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
        return solver.eigenvalues().cwiseSqrt() / (2 * pi);
    }
};

Dense dense_modes(const Tree& tree, const Vec3& gravity, Pose pose) {
    const std::size_t n = tree.size_bodies();
    const StartPose start = start_pose(tree, gravity, pose);
    ModeEnergy energy{tree, gravity, start.joint_rotation, start.theta, {}};
    std::vector<Vec3> x(n), com(n);
    energy.R.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Quat own = start.joint_rotation[i] * quaternion_from_vector<double>(start.theta[i]);
        const std::int32_t p = tree.parent[i];
        energy.R[i] = p < 0 ? own : Quat(energy.R[std::size_t(p)] * own);
        x[i] = p < 0 ? tree.joint_position[i]
                     : Vec3(x[std::size_t(p)] + energy.R[std::size_t(p)] * tree.joint_position[i]);
        com[i] = x[i] + energy.R[i] * tree.com[i];
    }
    const auto path_of = [&](std::size_t i) {
        std::vector<std::size_t> path;
        for (std::int64_t k = std::int64_t(i); k >= 0; k = tree.parent[std::size_t(k)])
            path.insert(path.begin(), std::size_t(k));
        return path;
    };
    std::vector<std::vector<std::size_t>> beyond(n);
    for (std::size_t i = 0; i < n; ++i)
        for (const std::size_t k : path_of(i))
            if (k != i) beyond[k].push_back(i);
    const auto size = Eigen::Index(3 * n);
    Dense matrices{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
    for (std::size_t i = 0; i < n; ++i) {
        const std::vector<std::size_t> path = path_of(i);
        for (const std::size_t j : path)
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) {
                    const Dual v = energy(path, beyond[i], j, a, i, b);
                    matrices.K(Eigen::Index(3 * j) + a, Eigen::Index(3 * i) + b) = v.d;
                    matrices.K(Eigen::Index(3 * i) + b, Eigen::Index(3 * j) + a) = v.d;
                }
        // Body i's part of M.
        const Mat3 R = energy.R[i].toRotationMatrix(), I = R * tree.inertia[i] * R.transpose();
        for (const std::size_t j : path)
            for (const std::size_t k : path) {
                const Mat3 J_j = -cross_matrix<double>(com[i] - x[j]), J_k = -cross_matrix<double>(com[i] - x[k]);
                matrices.M.block<3, 3>(Eigen::Index(3 * j), Eigen::Index(3 * k)) +=
                    tree.mass[i] * J_j.transpose() * J_k + I;
            }
    }
    return matrices;
}

Scene still(Pose pose = Pose::drawn, const Vec3& gravity = Vec3(0, -9.81, 0)) {
    Scene scene;
    scene.gravity = gravity;
    scene.pose = pose;
    return scene;
}

std::vector<NaturalMode> modes_of(const Tree& tree, const Scene& scene, const ModeOptions& options) {
    return natural_modes(SmallMotion(tree, scene.gravity, scene.pose), tree, scene, options);
}

// One upright rod on a spring.
Tree rod(const Vec3& K, double mass = 2, double length = 1.5) {
    Tree tree;
    tree.resize(1);
    tree.parent = {-1};
    tree.kind = {Kind::branch};
    tree.mass = {mass};
    tree.com = {Vec3(0, 0, length / 2)};
    tree.inertia = {Vec3(mass * length * length / 12, mass * length * length / 12, 0.003).asDiagonal()};
    tree.joint_position = {Vec3::Zero()};
    tree.joint_rotation = {shortest_turn(Vec3::UnitZ(), Vec3::UnitY())};
    tree.stiffness = {K};
    tree.damping = {0.02};
    tree.size = {Vec3(length, 0.02, 0.02)};
    tree.branch = {0};
    tree.level = {0};
    tree.s = {0};
    return tree;
}

// A uniform cantilever of f1 = 0.1399 D / L^2 sqrt(E / rho) = 1 Hz, cut into n pieces.
Tree cantilever(int n) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(0, 2, 0)};
    s.radius = {0.02, 0.02};
    Material wood = wood_presets().front();
    wood.youngs_modulus = wood.density * std::pow(4 / (0.1399 * 0.04), 2);
    SegmentOptions options;
    options.segment_length = 2.0 / n * 1.0000001;
    return segment(s, wood, options);
}

} // namespace

TEST_CASE("a rod on a spring swings as sqrt((K - m g h) / J)") {
    const Tree tree = rod(Vec3(40, 55, 9));
    const double J = 2 * 1.5 * 1.5 / 3, sinking = 2 * 9.81 * 0.75;
    const std::vector<NaturalMode> modes = modes_of(tree, still(), {20, false});
    REQUIRE(modes.size() == 3);                                                          // all that it has
    CHECK(modes[2].frequency == Approx(std::sqrt(9 / 0.003) / (2 * pi)).epsilon(1e-12)); // about its own axis
    CHECK(modes[0].frequency == Approx(std::sqrt((40 - sinking) / J) / (2 * pi)).epsilon(1e-12));
    CHECK(modes[1].frequency == Approx(std::sqrt((55 - sinking) / J) / (2 * pi)).epsilon(1e-12));
    // Its wood's damping is of the spring alone: beta K / (2 omega J).
    const double omega = 2 * pi * modes[0].frequency;
    CHECK(modes[0].damping == Approx(0.02 * 40 / (2 * omega * J)).epsilon(1e-10));
    // About one axis: p = m h per radian, (m h)^2 / J of the mass.
    CHECK(modes[0].effective_mass.sum() == Approx(2.25 / J).epsilon(1e-10));
    CHECK(modes[0].turn[0].norm() * 1.5 == Approx(1).epsilon(1e-12));
    const SmallMotion small(tree, Vec3(0, -9.81, 0), Pose::drawn);
    CHECK(sway_along(small, Vec3::UnitX()).frequency + sway_along(small, Vec3::UnitZ()).frequency ==
          Approx(modes[0].frequency + modes[1].frequency).epsilon(1e-9));
}

TEST_CASE("a cantilever has Euler and Bernoulli's first frequencies, each twice") {
    const std::vector<NaturalMode> modes = modes_of(cantilever(200), still(Pose::drawn, Vec3::Zero()), {6, false});
    REQUIRE(modes.size() == 6);
    const double first = modes[0].frequency;
    CHECK(first == Approx(1).epsilon(1e-3));
    CHECK(modes[1].frequency == Approx(first).epsilon(1e-9));
    // (4.69409 / 1.87510)^2, (7.85476 / 1.87510)^2
    for (const int k : {2, 3}) CHECK(modes[std::size_t(k)].frequency / first == Approx(6.26689).epsilon(2e-3));
    for (const int k : {4, 5}) CHECK(modes[std::size_t(k)].frequency / first == Approx(17.5475).epsilon(5e-3));
    // 61.3 % of a cantilever's mass goes with its first mode, 18.8 % with its second.
    double mass = 0;
    for (const double m : cantilever(200).mass) mass += m;
    CHECK((modes[0].effective_mass + modes[1].effective_mass).x() / mass == Approx(0.6131).epsilon(5e-3));
    CHECK((modes[2].effective_mass + modes[3].effective_mass).x() / mass == Approx(0.1883).epsilon(2e-2));
    for (const NaturalMode& mode : modes)
        CHECK(mode.damping == Approx(cantilever(200).damping[0] * pi * mode.frequency).epsilon(1e-9));
}

TEST_CASE("a cone's first frequency is 0.3469 of the wood's, and weight slows a rod as it nears buckling") {
    const Material& wood = wood_presets().front();
    const auto rod_of = [&](double base, double tip, int n) {
        Splines s;
        s.parent = {-1};
        s.parent_at = {0};
        s.level = {0};
        s.first_point = {0, 2};
        s.point = {Vec3(0, 0, 0), Vec3(0, 4, 0)};
        s.radius = {base, tip};
        SegmentOptions options;
        options.segment_length = 4.0 / n * 1.0000001;
        return segment(s, wood, options);
    };
    const auto first = [](const Tree& tree, double g) {
        return modes_of(tree, still(Pose::drawn, Vec3(0, -g, 0)), {1, false})[0].frequency;
    };
    const double beam = 2 * 0.03 / 16 * std::sqrt(wood.youngs_modulus / wood.density);
    CHECK(first(rod_of(0.03, 3e-6, 640), 0) == Approx(0.3469 * beam).epsilon(1e-3));
    // Ritz with the shape of a uniform load: omega^2 falls by the weight over the buckling weight 7.837 E I / L^2, to 2 %.
    const double radius = 0.006, weight = wood.density * pi * radius * radius * 4 * 9.81;
    const double buckling = 7.837 * wood.youngs_modulus * pi / 4 * std::pow(radius, 4) / 16;
    REQUIRE(weight < 0.9 * buckling);
    REQUIRE(weight > 0.3 * buckling);
    const Tree thin = rod_of(radius, radius, 80);
    CHECK(std::pow(first(thin, 9.81) / first(thin, 0), 2) == Approx(1 - weight / buckling).margin(0.02));
    CHECK(std::pow(first(thin, -9.81) / first(thin, 0), 2) == Approx(1 + weight / buckling).margin(0.02)); // hanging
    CHECK_FALSE(SmallMotion(rod_of(0.002, 0.002, 80), Vec3(0, -9.81, 0), Pose::drawn)
                    .buckled()
                    .empty()); // longer than it can stand
}

TEST_CASE("all modes are those of the dense eigenproblem") {
    for (const Pose pose : {Pose::drawn, Pose::settled}) {
        Tree tree = lanes::grown(pose == Pose::drawn ? 300 : 60);
        if (pose == Pose::settled)
            for (Vec3& K : tree.stiffness) K *= 4; // that it stands
        const Eigen::VectorXd truth = dense_modes(tree, Vec3(0, -9.81, 0), pose).hertz();
        const std::vector<NaturalMode> modes = modes_of(tree, still(pose), {20, false});
        REQUIRE(modes.size() == 20);
        for (std::size_t k = 0; k < modes.size(); ++k) {
            CAPTURE(k, int(pose));
            CHECK(modes[k].frequency == Approx(truth[Eigen::Index(k)]).epsilon(1e-9));
        }
    }
}

TEST_CASE("a shape's branches are displaced as the swung tree is, and have all of its energy") {
    const Tree tree = lanes::grown(300);
    const SmallMotion small(tree, Vec3(0, -9.81, 0), Pose::drawn);
    const NaturalMode mode = natural_modes(small, tree, still(), {3, false})[2];
    const std::vector<BranchMotion> all = moving_branches(small, tree, mode, tree.size_bodies());
    const double little = 1e-6;
    const ShapePose rest = swung(small, tree, mode, 0), out = swung(small, tree, mode, little);
    double sum = 0, most = 0;
    for (const BranchMotion& b : all) {
        double way = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            if (tree.branch[i] != b.branch) continue;
            const auto end = [&](const ShapePose& pose) {
                return Vec3(pose.position[i] + pose.rotation[i] * Vec3(0, 0, tree.size[i][0]));
            };
            way = std::max(way, (end(out) - end(rest)).norm() / little);
        }
        CHECK(b.way.norm() == Approx(way).margin(1e-4));
        sum += b.share;
        most = std::max(most, b.way.norm());
    }
    CHECK(sum == Approx(1).epsilon(1e-12));
    CHECK(most == Approx(1).epsilon(1e-12));
    const std::vector<BranchMotion> few = moving_branches(small, tree, mode, 4);
    REQUIRE(few.size() == 4);
    for (std::size_t k = 1; k < 4; ++k) CHECK(few[k - 1].share >= few[k].share);
    CHECK(few[3].branch == all[3].branch);
}

TEST_CASE("what buckles goes over to where it stands") {
    const double K = 14, weight = 2 * 9.81 * 0.75; // m g h is 14.7
    const SmallMotion small(rod(Vec3(K, 55, 9)), Vec3(0, -9.81, 0), Pose::drawn);
    CHECK(small.buckled() == std::vector<std::size_t>{0});
    // K theta = m g h sin theta
    double theta = 0.5;
    for (int k = 0; k < 100; ++k) theta -= (K * theta - weight * std::sin(theta)) / (K - weight * std::cos(theta));
    CHECK(std::acos(small.rotations()[0](1, 2)) == Approx(theta).epsilon(1e-8));
    const double J = 2 * 1.5 * 1.5 / 3;
    const std::vector<NaturalMode> modes = natural_modes(small, rod(Vec3(K, 55, 9)), still(), {1, false});
    CHECK(modes[0].frequency == Approx(std::sqrt((K - weight * std::cos(theta)) / J) / (2 * pi)).epsilon(1e-8));
    CHECK_THROWS_WITH(SmallMotion(rod(Vec3(0, 55, 9)), Vec3(0, -9.81, 0), Pose::drawn),
                      Catch::Contains("body 0 of branch 0"));
}

TEST_CASE("wind damps a mode by its drag's derivative") {
    Tree tree = rod(Vec3(40, 55, 9));
    Scene scene = still();
    scene.wind = Wind();
    scene.wind->velocity = Vec3(6, 0, 0);
    scene.wind->profile = 0;
    const std::vector<NaturalMode> modes = modes_of(tree, scene, {2, true});
    // At its centre of mass; along the wind the slope of u^2 is 2 u, across it u.
    const double J = 2 * 1.5 * 1.5 / 3, area = 1.2 / 2 * scene.air_density * 0.04 * 1.5;
    for (const NaturalMode& mode : modes) {
        const bool along = mode.effective_mass.x() > mode.effective_mass.z();
        const double drag = area * (along ? 2 : 1) * 6 * 0.75 * 0.75;
        CHECK(mode.damping - mode.wood == Approx(drag / (2 * 2 * pi * mode.frequency * J)).epsilon(1e-9));
    }
}

TEST_CASE("wind damps a mode of a single leaf as one that turns with the wind, where it is not narrow") {
    // The upright rod as a blade that faces z, in 6 m/s along x. Of its drag a quarter is from all sides; h is that of air.h.
    for (const double width : {0.9, 0.15}) {
        Tree tree = rod(Vec3(40, 55, 9));
        tree.kind[0] = Kind::leaf;
        tree.size[0] = {1.5, width, 2e-4};
        Scene scene = still();
        scene.wind = Wind();
        scene.wind->velocity = Vec3(6, 0, 0);
        scene.wind->profile = 0;
        const auto unfolded = [](double u) { return 1 / (1 + u / 7.5); };
        const auto past = [&](double u) { // G |u|
            const double h = width > 0.5 ? 0.66 + 0.34 / (1 + std::pow(u / 7.2, 4)) : 1;
            return unfolded(u) * h * u;
        };
        const double slope = (past(6 + 1e-4) - past(6 - 1e-4)) / 2e-4;
        const double J = 2 * 1.5 * 1.5 / 3, area = 1.2 / 2 * scene.air_density * 1.5 * width / 2;
        const double spin = 6 * area / 2 * unfolded(6) * 6 * (J - 2 * 0.75 * 0.75);
        int leaves = 0;
        for (const NaturalMode& mode : modes_of(tree, scene, {2, true})) {
            const bool along = mode.effective_mass.x() > mode.effective_mass.z();
            const double drag = area * (along ? 0.25 * (past(6) + 6 * slope) : past(6)) * 0.75 * 0.75;
            CAPTURE(width, along);
            CHECK(mode.damping - mode.wood == Approx((drag + spin) / (2 * 2 * pi * mode.frequency * J)).epsilon(1e-6));
            ++leaves;
        }
        CHECK(leaves == 2);
    }
}
