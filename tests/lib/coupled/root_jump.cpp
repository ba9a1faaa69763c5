// A ground that jumps within a step: its places and velocities over the step are met, and what stands on it answers as to a
// jump, by closed forms and against the articulated reference.
#include "lib/laws/ground_course.h"
#include "tests/support/coupled_support.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

constexpr double frame = 1.0 / 30;

// From t by `way` and `turned`, in so short a time.
RootMotion jump(double t, double span, const Vec3& way, const Vec3& turned = Vec3::Zero()) {
    RootMotion motion;
    motion.time = {t, t + span};
    motion.position = {Vec3::Zero(), way};
    if (!turned.isZero(0))
        motion.rotation = {Quat::Identity(), Quat(Eigen::AngleAxisd(turned.norm(), turned.normalized()))};
    return motion;
}

// One upright rod whose joint rings at 1 Hz, undamped, somewhere.
Tree rod() {
    Tree tree = make_tree::chain(1, 1, 0.02, 0.015, 0, make_tree::Wood());
    tree.joint_position[0] = Vec3(40, 0.3, -70);
    const double c = tree.com[0].z(), I = tree.inertia[0](0, 0) + tree.mass[0] * c * c;
    const double omega = 2 * std::numbers::pi;
    tree.stiffness[0] = Vec3(I * omega * omega, I * omega * omega, 1e3);
    tree.damping[0] = 0;
    return tree;
}

} // namespace

TEST_CASE("over a step the ground's two integrals are those of its true acceleration, through turning axes too") {
    RootMotion m;
    m.time = {0.2, 0.7, 1, 1.8, 2.5};
    m.position = {{0, 0, 0}, {0.4, -0.1, 0.2}, {1, 0, 0.3}, {0.2, 0.5, -0.6}, {0.1, 0, 0}};
    m.rotation = {make_tree::turn(0.4, Vec3(1, 2, 0)), make_tree::turn(1.1, Vec3(0, 1, 0.2)),
                  make_tree::turn(2.2, Vec3(0.3, 1, 0)), make_tree::turn(-2.5, Vec3(0.2, 1, 0.1)),
                  make_tree::turn(-1, Vec3(1, 0, 1))};
    const Vec3 pivot(3, 0.5, -2);
    const RootSpline s = make_root_spline(m, pivot);
    const auto off = [&](double h) {
        double most = 0;
        for (const double t : {0.31, 0.8, 1.4, 2.1}) {
            const GroundCourse c = ground_course(s, t, h);
            Vec3 moved = Vec3::Zero(), turned = Vec3::Zero(); // less than what goes on at the start's velocity
            const int n = 2000;
            for (int k = 0; k < n; ++k) {
                const Ground g = ground_at(s, t + (k + 0.5) * h / n);
                moved += (g.v + g.omega.cross(g.R * pivot) - c.v_0) * h / n;
                turned += (g.omega - c.start.omega) * h / n;
            }
            CHECK((h * c.a - (c.v_1 - c.v_0)).norm() < 1e-12);
            CHECK((h * c.alpha - (c.end.omega - c.start.omega)).norm() < 1e-12);
            CHECK((h * h * (c.a / 2 - c.slope / 12) - moved).norm() < 1e-6 * moved.norm());
            most = std::max(most, (h * h * (c.alpha / 2 - c.slope_turn / 12) - turned).norm());
        }
        return most;
    };
    const double coarse = off(0.1), fine = off(0.05);
    CHECK(coarse < 1e-3);
    CHECK(coarse / fine > 24); // to fourth order
}

TEST_CASE("a ground that rests, or goes on steadily, has no slope") {
    const RootSpline still = make_root_spline(jump(5, 1, Vec3(1, 0, 0), Vec3(0, 1, 0)), Vec3(1e3, 2, 3));
    const GroundCourse c = ground_course(still, 1, frame);
    for (const Vec3& v : {c.turned, c.a, c.slope, c.alpha, c.slope_turn}) CHECK(v == Vec3::Zero());
    RootSpline steady = steady_ground(Vec3(3, 0, 1), Vec3(-1, 2, 0), Vec3(30, 70, -20)); // more than half a turn a step
    steady.pivot = Vec3(4, 0, -9);
    const GroundCourse d = ground_course(steady, 0.4, frame);
    CHECK((d.turned - frame * Vec3(30, 70, -20)).norm() < 1e-12);
    CHECK((d.a - Vec3(-1, 2, 0)).norm() < 1e-12);
    CHECK(d.slope.norm() < 1e-10);
    CHECK(d.alpha.norm() < 1e-12);
    CHECK(d.slope_turn.norm() < 1e-10);
}

// After a displacement by d in no time the rod's centre of mass and turn are those of a free rod whose end was moved: theta
// is -m c d / I and at rest, and rings from there. Turned about its end by phi it stays where it was: theta is -phi.
TEMPLATE_TEST_CASE("a ringing rod on a ground that jumps within a step: its closed form, wherever in the step", "",
                   float, double) {
    using T = TestType;
    const Tree tree = rod();
    const double c = tree.com[0].z(), I = tree.inertia[0](0, 0) + tree.mass[0] * c * c, omega = 2 * std::numbers::pi;
    const double d = 0.01, phi = 0.1;
    for (const bool turned : {false, true})
        for (const double at : {0.02, 0.2, 0.5, 0.8, 0.97})
            for (const double span : {1e-6, 0.02})
                for (const Scheme scheme : {Scheme::p12, Scheme::p25, Scheme::p50, Scheme::p34}) {
                    lanes::Case c_case{"rod", tree, empty_scene()};
                    const double begin = (5 + at) * frame - span * at;
                    c_case.scene.root_motion = {turned ? jump(begin, span, Vec3::Zero(), Vec3(0, 0, phi))
                                                       : jump(begin, span, Vec3(d, 0, 0))};
                    c_case.scene.trees = {{"rod", tree.joint_position[0], 0}};
                    std::vector<lanes::Simd> paths{std::nullopt};
                    for (const fast::Target target : lanes::targets()) paths.push_back(target);
                    for (const lanes::Simd path : paths) {
                        lanes::LanesRun<T> run(c_case, path, scheme);
                        for (int k = 0; k < 6; ++k) run.frame();
                        const double amplitude = turned ? phi : tree.mass[0] * c * d / I;
                        const Vec3 theta = run.state.theta[0].template cast<double>();
                        const Vec3 rate = run.state.theta_dot[0].template cast<double>() / omega;
                        CAPTURE(turned, at, span, scheme_of(scheme).name, path.has_value());
                        CHECK(std::sqrt(theta.squaredNorm() + rate.squaredNorm()) == Approx(amplitude).epsilon(0.01));
                        const double phase = std::atan2(rate.norm(), theta.norm()); // since a moment within the step
                        CHECK(phase > 0.3 * omega * frame);
                        CHECK(phase < 0.7 * omega * frame);
                        double most = 0; // and it rings on
                        for (int k = 0; k < 60; ++k) {
                            run.frame();
                            most = std::max(most, double(run.state.theta[0].norm()));
                        }
                        CHECK(most == Approx(amplitude).epsilon(0.02));
                    }
                }
}

TEST_CASE("the reference does not step over a jump, however short") {
    const Tree tree = rod();
    const double c = tree.com[0].z(), I = tree.inertia[0](0, 0) + tree.mass[0] * c * c, d = 0.01;
    for (const double at : {0.02, 0.51, 0.9}) { // between the rows' steps in a whole frame
        coupled::Motion motion{tree, empty_scene(), 20};
        motion.ground = make_root_spline(jump((5 + at) * frame, 0.02 * frame, Vec3(d, 0, 0)), tree.joint_position[0]);
        double most = 0;
        const Track track = truth_of(motion, 1e-8);
        for (const auto& tips : track) most = std::max(most, (tips[0] - track[0][0]).norm());
        CAPTURE(at);
        CHECK(most == Approx(tree.size[0][0] * tree.mass[0] * c * d / I).epsilon(0.01));
    }
}

TEST_CASE("a tree on a ground that jumps within a step of 1/30 s: the reference's motion, with little steps too") {
    struct Case {
        double way, at, span, most; // [m], [steps], [steps]; error
    };
    for (const Case& c : {Case{0.02, 0, 1, 0.13}, Case{0.02, 0.02, 0.4, 0.14}, Case{0.02, 0.5, 0.05, 0.13},
                          Case{0.002, 0.3, 0.4, 0.13}, Case{0.002, 0.52, 0.01, 0.13}}) {
        coupled::Motion motion{paper_trees::branched(2e8, 0.01), empty_scene(), 30};
        motion.ground = make_root_spline(jump((5 + c.at) * frame, c.span * frame, Vec3(c.way, 0, 0)), Vec3::Zero());
        Plan<double> plan = plan_of(motion, Solver::articulated_reference, Scheme::p12, 64);
        parts::set_tolerance(plan, 1e-9);
        const Track truth = track_of(motion, plan, 64);
        CAPTURE(c.way, c.at, c.span);
        CHECK(track_error(truth_of(motion), truth) < 1e-5);
        CHECK(error_of(motion, truth, Scheme::p12, 1) < c.most);
        // Where neither the tree nor the motion of the ground is resolved any worse.
        CHECK(error_of(motion, truth, Scheme::p12, 64) < c.most);
    }
}

TEST_CASE("a jump in lanes is the plain step's: a tree, beside one whose ground rests and one that is carried") {
    const Tree one = coupled::leafy(2e9, 0.01);
    lanes::Case c{"three trees", make_tree::forest({one, one, one}), empty_scene()};
    const std::size_t n = one.size_bodies();
    c.ranges = {{0, n, 0}, {n, n, 0}, {2 * n, n, 0}};
    c.scene.trees = {{"a", Vec3::Zero(), 0}, {"b", Vec3::Zero(), 0}, {"c", Vec3::Zero(), 0}};
    RootMotion jumps = jump(4.3 * frame, 0.4 * frame, Vec3(0.03, 0, 0.01), Vec3(0.02, 0.1, 0)),
               carried = lanes::shifted();
    jumps.tree = 1;
    carried.tree = 2;
    c.scene.root_motion = {jumps, carried};
    lanes::LanesRun<> plain(c, std::nullopt);
    plain.steps(12);
    double largest = 0;
    for (std::size_t i = 0; i < 3 * n; ++i) largest = std::max(largest, plain.state.theta[i].norm());
    CHECK(largest > 0.05);
    for (const fast::Target target : lanes::targets()) {
        lanes::LanesRun<> run(c, target);
        run.steps(12);
        present(run.plan, run.state);
        for (std::size_t i = 0; i < 3 * n; ++i) {
            CAPTURE(i);
            CHECK((run.state.theta[i] - plain.state.theta[i]).norm() < 1e-10);
            CHECK((parts::theta_change(run.state)[i] - parts::theta_change(plain.state)[i]).norm() < 1e-10);
        }
    }
}
