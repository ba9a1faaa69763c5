// One coupled step against the same step by dense algebra.
#include "lib/coupled/attachment.h"
#include "lib/coupled/body_load.h"
#include "lib/coupled/midpoint.h"
#include "lib/coupled/resolvent.h"
#include "lib/laws/wind.h"
#include "tests/support/coupled_cases.h"
#include "tests/support/coupled_support.h"
#include "tests/support/dense_step.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace coupled;
using solver::empty_scene;
using solver::random_vector;

namespace {

constexpr double h = 1.0 / 30;

struct Named {
    std::string name;
    Scene scene;
    dense::GroundMotion ground{};
};

std::vector<Named> scenes() {
    Scene bare = empty_scene(), heavy = bare, blown = bare, pulled = bare;
    heavy.gravity = Vec3(1, -9.81, 2);
    blown.wind = wind_preset("breeze");
    blown.wind->profile = 0; // the dense solve has one wind everywhere
    pulled.pulls = {pull_on(3, Vec3(1, 0, -4), Vec3(-8, 1, 2)), pull_on(9, Vec3(0, 0.1, 0), Vec3(0.2, 0.1, 0.5))};
    Scene all = blown;
    all.gravity = heavy.gravity;
    all.pulls = pulled.pulls;
    dense::GroundMotion driven, turning;
    driven.v = {3, -1, 2};
    driven.a = {4, 5, -6};
    turning.omega = {0.5, 2, -1};
    dense::GroundMotion both = driven;
    both.omega = turning.omega;
    const auto held = [](std::int64_t body, double k, double c) {
        Attachment on;
        on.on.body = body;
        on.on.point = Vec3(0.01, 0.02, 0.05);
        on.time = {0, 1, 2};
        on.position = {Vec3(0.3, 1.8, 0.1), Vec3(0.5, 1.7, -0.2), Vec3(0.1, 1.5, 0.3)};
        on.stiffness = k;
        on.damping = c;
        return on;
    };
    Scene hand = bare, held_all = all;
    hand.attachments = {held(12, 30, 0)};
    held_all.attachments = {held(12, 30, 0.5), held(9, 0, 2), held(20, 100, 0.3), held(20, 3, 0.1)};
    // Loops: twigs of the tree tied to each other, twice, and one of them held.
    const auto tied = [&](std::int64_t body, std::int64_t other, double k, double c) {
        Attachment on = held(body, k, c);
        on.with = Selector();
        on.with->body = other;
        on.with->point = Vec3(-0.02, 0.01, 0.03);
        return on;
    };
    Scene pair = bare, pairs_all = all;
    pair.attachments = {tied(12, 20, 30, 0.2)};
    pairs_all.attachments = {tied(12, 20, 30, 0.5), held(9, 0, 2), tied(20, 9, 100, 0.3), tied(5, 15, 0, 3)};
    // Forces that turn with their bodies: small, and as large as springs of the path; one twig with two, one that is tied as well.
    const auto follower = [](std::int64_t body, const Vec3& from, const Vec3& to) {
        Pull pull = pull_on(body, from, to);
        pull.in_body = true;
        pull.on.point = Vec3(0.01, -0.02, 0.06);
        return pull;
    };
    Scene jet = bare, jets_all = pairs_all;
    jet.pulls = {follower(12, Vec3(0.1, 0.02, -0.05), Vec3(0.2, 0, 0.1))};
    for (const Pull& pull :
         {follower(12, Vec3(3, 1, -2), Vec3(2, 1, -4)), follower(12, Vec3(0, 0, -40), Vec3(0, 0, 60)),
          follower(17, Vec3(0.1, 0.2, 0.1), Vec3(0.3, 0, 0))})
        jets_all.pulls.push_back(pull);
    return {{"a pull that turns", jet},
            {"pulls that turn and all", jets_all},
            {"pulls that turn and all, driven and turning", jets_all, both},
            {"an attachment", hand},
            {"two bodies attached to each other", pair},
            {"pairs and all", pairs_all},
            {"pairs and all, driven and turning", pairs_all, both},
            {"attachments and all", held_all},
            {"attachments and all, driven and turning", held_all, both},
            {"nothing", bare},
            {"gravity", heavy},
            {"wind", blown},
            {"pulls", pulled},
            {"all", all},
            {"driven ground", bare, driven},
            {"turning ground", bare, turning},
            {"all, driven and turning", all, both}};
}

// In random motion at 0.7 s, with random last changes.
struct Bench : CoupledRun<double> {
    Bench(const Tree& tree, const Named& named, Scheme scheme) : CoupledRun(tree, moved(named), scheme, h) {
        if (plan.root_motion)
            plan.splines = {steady_ground(named.ground.v.cast<double>(), named.ground.a.cast<double>(),
                                          named.ground.omega.cast<double>())};
        state.step = 21;
        make_tree::Dice dice{std::mt19937(5)};
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            state.theta[i] = random_vector(dice, 0.6);
            state.theta_dot[i] = random_vector(dice, 0.8);
            parts::theta_change(state)[i] = random_vector(dice, 0.02);
            parts::theta_dot_change(state)[i] = random_vector(dice, 0.5);
        }
        for (Attached& held : coupled_state(state).attachments.all) held.force = random_vector(dice, 3);
    }
    static Scene moved(const Named& named) {
        Scene scene = named.scene;
        if (named.ground.v.isZero() && named.ground.omega.isZero()) return scene;
        scene.root_motion = {two_keys()};
        return scene;
    }
};

dense::Step step_of(const Tree& tree, const Named& named, const Bench& bench) {
    const double t = double(bench.state.step) * h;
    dense::Step step{
        {tree, bench.plan, bench.state.theta, {}}, bench.state.theta_dot, bench.state.theta, bench.state.theta_dot};
    step.h = h;
    dense::Problem& p = step.middle;
    p.time = t + h / 2;
    p.ground = named.ground;
    for (std::size_t i = 0; i < bench.plan.bodies; ++i) {
        p.theta[i] += parts::theta_change(bench.state)[i] / 2;
        step.eta[i] += parts::theta_dot_change(bench.state)[i] / 2;
        p.rate.push_back(body_rate_jacobian(p.theta[i]) * step.eta[i]);
    }
    const Scene& scene = bench.plan.scene;
    if (scene.wind) {
        p.air = true;
        p.wind = wind_velocity(*scene.wind, t + h / 2).cast<dense::Real>();
        step.wind_change = (wind_velocity(*scene.wind, t + h) - wind_velocity(*scene.wind, t)).cast<dense::Real>();
    }
    for (const Pull& pull : scene.pulls) {
        const Vec3 rise = (pull.force[1] - pull.force[0]) / 2; // a second
        if (pull.in_body) continue;
        p.pulls.push_back((pull.force[0] + (t + h / 2) * rise).cast<dense::Real>());
        step.pull_change.push_back((h * rise).cast<dense::Real>());
    }
    const dense::Pose pose = dense::pose_at(p, 0);
    for (const PlannedPull<double>& pull : bench.plan.followers) {
        const Pull& source = scene.pulls[pull.source];
        const Vec3 rise = (source.force[1] - source.force[0]) / 2;
        const auto of_world = [&](const Vec3& f) { return dense::V3(pose.R[pull.body] * f.cast<dense::Real>()); };
        step.turning.push_back({pull.body, pull.point_b.cast<dense::Real>(),
                                of_world(source.force[0] + (t + h / 2) * rise), of_world(h * rise)});
    }
    for (const Attached& held : coupled_state(bench.state).attachments.all) {
        const PlannedAttachment& planned = bench.plan.attachments[std::size_t(held.planned)];
        const CurvePoint from = curve_at(*planned.course, t), to = curve_at(*planned.course, t + h);
        step.held.push_back({held.body, held.point_b.cast<dense::Real>(), held.stiffness, held.damping,
                             from.x.cast<dense::Real>(), to.x.cast<dense::Real>(),
                             Vec3(to.v - from.v).cast<dense::Real>(), held.force.cast<dense::Real>()});
        if (!held.far) continue;
        step.held.back().far = std::int64_t(held.far->body);
        step.held.back().far_point_b = held.far->point_b.cast<dense::Real>();
    }
    return step;
}

// The step's stages up to its changes: what the energy guard makes of them is no part of the equations.
void solve(Bench& bench) {
    const double time = double(bench.state.step) * h;
    const RationalScheme& scheme = scheme_of(parts::bodies(bench.plan).scheme);
    const CoupledPlan<double>& own = parts::bodies(bench.plan);
    CoupledWork<double>& work = parts::bodies(bench.state);
    if (bench.plan.wind) wind_over_step(bench.plan, bench.state, work, time);
    ground_over_step(bench.plan, own, work, time);
    midpoint(bench.plan, bench.state, work, scheme.extrapolates);
    body_loads(bench.plan, own, bench.state, work, time);
    read_attached(bench.state, work);
    place_attachments(bench.plan, own, work, time);
    for (Vec3& change : parts::theta_change(bench.state)) change.setZero();
    for (Vec3& change : parts::theta_dot_change(bench.state)) change.setZero();
    for (int k = 0; k < scheme.poles; ++k) resolvent(bench.plan, own, bench.state, work, scheme.pole[std::size_t(k)]);
}

// Of the changes of theta and of theta_dot, each relative to its largest: the worst.
double difference(const Bench& after, const dense::Vector& truth) {
    double worst = 0;
    const auto n = Eigen::Index(after.plan.bodies);
    for (const bool rates : {false, true}) {
        double off = 0, size = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const Vec3 expected = truth.segment<3>(3 * (rates ? n + i : i)).cast<double>();
            const Vec3& found =
                (rates ? parts::theta_dot_change(after.state) : parts::theta_change(after.state))[std::size_t(i)];
            off = std::max(off, (found - expected).norm());
            size = std::max(size, expected.norm());
        }
        worst = std::max(worst, off / size);
    }
    return worst;
}

} // namespace

TEST_CASE(
    "One step is the dense one: of every scheme, under every load, from a random state with random last changes") {
    for (const bool leaves : ::cases(1, {1, 0})) {
        // Wood that gravity and wind bend as much as its springs do.
        Tree tree = leaves ? leafy(2e7, 0.01) : paper_trees::branched(2e7, 0.01);
        tree.joint_position[0] = Vec3(0.7, 0.2, -0.4); // off the point that the ground turns about
        for (const Named& named : scenes())
            for (const Scheme scheme : extrapolating) {
                if (!leaves && scheme != Scheme::p12) continue; // in leaf there is all that is here
                Bench bench(tree, named, scheme);
                const dense::Vector truth = dense::take(step_of(tree, named, bench), scheme);
                solve(bench);
                CAPTURE(leaves, named.name, scheme_of(scheme).name);
                REQUIRE(bench.state.flags.fast_turns == 0);
                REQUIRE(bench.state.flags.half_turns == 0);
                // (P34's denominator is a polynomial of fourth degree in a matrix with entries to 1e4: 3e-7 where forces of 50 N turn with leafy twigs.)
                CHECK(difference(bench, truth) < (scheme == Scheme::p34 ? 1e-6 : 1e-10));
            }
    }
}
