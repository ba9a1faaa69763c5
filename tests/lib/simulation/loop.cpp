// Loops: the wind that repeats, the motion that repeats with it, and the ends of one that does not, against the run that goes on and closed forms.
#include "lib/simulation/loop.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"
#include "tests/support/wind_at.h"
#include <map>
#include <numbers>

using namespace bough;
using namespace simulations;

namespace {

constexpr std::int64_t period = 24; // [frames]
constexpr double frame_step = 1.0 / 12;

SimulationOptions at_frames(bool portable = true) {
    SimulationOptions o;
    o.step = frame_step;
    o.portable = portable;
    return o;
}

Scene looping(Tree tree, const char* wind) {
    Scene scene = one(tree, wind);
    make_periodic(double(period) * frame_step, scene);
    return scene;
}

struct LoopPose {
    std::vector<Vec3> x;
    std::vector<Quat> q;
};

LoopPose pose_of(const Simulation& run) {
    return {{run.positions().begin(), run.positions().end()}, {run.rotations().begin(), run.rotations().end()}};
}

// Takes the run on and keeps the pose of each frame, by its number.
ToFrame recording(std::map<std::int64_t, LoopPose>& poses) {
    return [&poses](Simulation& run, std::int64_t f) {
        REQUIRE(run.step().finite());
        REQUIRE(run.steps() == f);
        poses[f] = pose_of(run);
    };
}

void take_step(Simulation& run, std::int64_t) {
    REQUIRE(run.step().finite());
}

double largest_angle(const LoopPose& a, const LoopPose& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.q.size(); ++i) most = std::max(most, a.q[i].angularDistance(b.q[i]));
    return most;
}

} // namespace

TEST_CASE("a wind that was made periodic is the same a period later, everywhere, and else as it was") {
    Scene scene = one(make_tree::branched(), "storm");
    WindGrid& grid = scene.wind->grid.emplace();
    grid.x = grid.z = -2;
    grid.cell = 2;
    grid.columns = grid.rows = 2;
    grid.octaves = {3};
    grid.phase = {0, 1, 2, 3};
    scene.wind->swirl.emplace().angle = {30};
    Wind as_it_was = *scene.wind;
    const double T = 3.7;
    make_periodic(T, scene);
    const Wind& wind = *scene.wind;
    double changes = 0, off = 0, unmade = 0;
    for (int k = 0; k < 200; ++k) {
        const double t = 0.093 * k;
        for (const Vec3& at : {Vec3(0.5, 3, 0.5), Vec3(-1, 9, 1)}) {
            off = std::max(off, (wind_at(wind, at, t + T) - wind_at(wind, at, t)).norm());
            changes = std::max(changes, (wind_at(wind, at, t + T / 3) - wind_at(wind, at, t)).norm());
            unmade = std::max(unmade, (wind_at(as_it_was, at, t + T) - wind_at(as_it_was, at, t)).norm());
        }
    }
    CHECK(off < 1e-9);
    CHECK(changes > 5);
    CHECK(unmade > 5);
    as_it_was.period = T;
    CHECK(wind == as_it_was);
    // One that repeats by now stays as it is, if the loop has it a whole number of times.
    make_periodic(2 * T, scene);
    CHECK(*scene.wind == as_it_was);
    CHECK_THROWS_WITH(make_periodic(1.5 * T, scene), Catch::Contains("5.55 s") && Catch::Contains("3.7 s"));
    CHECK_THROWS_AS(make_periodic(T / 2, scene), SceneError);
    CHECK(*scene.wind == as_it_was);
}

TEST_CASE("what passes and does not come back is not made periodic") {
    const Scene good = one(make_tree::branched(), "gusty");
    const auto refusal_of = [&](const auto& change, double seconds = 2) {
        Scene scene = good;
        change(scene);
        try {
            make_periodic(seconds, scene);
        } catch (const SceneError& error) {
            CHECK((!scene.wind || !scene.wind->period));
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal_of([](Scene&) {}) == "");
    CHECK_THAT(refusal_of([](Scene& s) { s.wind.reset(); }), Catch::Contains("no /wind"));
    CHECK_THAT(refusal_of([](Scene& s) { s.pulls.resize(1); }), Catch::Contains("/pulls"));
    CHECK_THAT(refusal_of([](Scene& s) { s.attachments.resize(1); }), Catch::Contains("/attachments"));
    CHECK_THAT(refusal_of([](Scene& s) { s.root_motion.resize(1); }), Catch::Contains("/root_motion"));
    CHECK_THAT(refusal_of([](Scene& s) { s.balls.resize(1); }), Catch::Contains("/balls"));
    CHECK_THAT(refusal_of([](Scene& s) { s.fracture.emplace(); }), Catch::Contains("/fracture"));
    CHECK_THAT(refusal_of([](Scene& s) { s.walkers.resize(1); }), Catch::Contains("/walkers"));
    for (const double seconds : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK_THAT(refusal_of([](Scene&) {}, seconds), Catch::Contains("expected more than 0"));
}

TEST_CASE("a motion that closed is the same in the periods after, and is where a long run ends") {
    Tree soft = make_tree::branched();
    for (std::size_t i = 0; i < soft.size_bodies(); ++i)
        if (soft.kind[i] == Kind::branch) soft.stiffness[i] *= 0.02;
    const Scene scene = looping(soft, "storm");
    for (const bool portable : {false, true}) {
        Simulation run(scene, at_frames(portable));
        std::map<std::int64_t, LoopPose> poses;
        LoopOptions o;
        o.frames = period;
        const LoopStart start = close_loop(run, o, recording(poses));
        REQUIRE(start.closed);
        CHECK(start.periods > 1);
        CHECK(start.periods < most_periods(o));
        CHECK(run.steps() == start.periods * period);
        CHECK_FALSE(start.before);
        const double allowed = o.tolerance * start.height;
        CHECK(start.gap.largest() <= allowed);
        CHECK(start.gap.largest() > 0);
        const std::int64_t first = run.steps();
        double off = 0, swing = 0;
        for (std::int64_t f = first + 1; f <= first + 2 * period; ++f) {
            recording(poses)(run, f);
            off = std::max(off, apart(poses[f].x, poses[f - period].x));
            swing = std::max(swing, apart(poses[f].x, poses[first].x));
            if (f != first + period) continue;
            // The seam is how far the ends are off: here of all branches, leaves and fruit, a leaf's being its length away.
            const LoopGap seam = loop_seam(run, start);
            double ends = 0;
            for (const std::size_t i : start.bodies) {
                const auto end = [&](const LoopPose& p) -> Vec3 {
                    return p.x[i] + p.q[i] * Vec3(0, 0, run.tree().size[i][0]);
                };
                ends = std::max(ends, (end(poses[f]) - end(poses[first])).norm());
            }
            CHECK(seam.largest() == Approx(ends).margin(1e-12));
            CHECK(seam.largest() <= allowed);
        }
        CAPTURE(portable, off / start.height, swing / start.height, start.periods);
        CHECK(off <= allowed);
        CHECK(swing > 20 * allowed);
        // However it began, it comes to the same: here it goes on for as many periods again.
        Simulation longer(scene, at_frames(portable));
        REQUIRE(longer.step(int(3 * first)).finite());
        CHECK(apart(pose_of(longer).x, poses[first].x) <= 2 * allowed);
    }
}

TEST_CASE("a loop's start names the ends that it compares, and the tree's height") {
    const Tree tree = make_tree::branched();
    Simulation run(looping(tree, "gusty"), at_frames());
    LoopOptions o;
    o.frames = period;
    o.periods = 2;
    o.tolerance = 1e-12;
    const LoopStart start = close_loop(run, o, take_step);
    CHECK_FALSE(start.closed);
    CHECK(start.periods == 2);
    CHECK(run.steps() == 2 * period);
    CHECK(start.tips == 5); // the trunk's, three branches' and the twig's
    CHECK(start.bodies == std::vector<std::size_t>{3, 5, 7, 8, 9, 10, 11, 12, 13});
    CHECK(start.end.size() == 9);
    CHECK(start.height > 1.9); // the trunk's, which leans by some degrees
    CHECK(start.height < 2.1);
    o.periods.reset();
    CHECK(most_periods(o) == 20);
    o.blend = true;
    CHECK(most_periods(o) == 5);
    o.periods = 9;
    CHECK(most_periods(o) == 9);
}

TEST_CASE("a blended loop passes into the period before by x^2 (3 - 2 x), joint by joint, and its ends meet") {
    const Tree tree = leafy();
    Simulation run(looping(tree, "storm"), at_frames(false));
    std::map<std::int64_t, LoopPose> poses;
    poses[0] = pose_of(run);
    LoopOptions o;
    o.frames = period;
    o.periods = 2;
    o.blend = true;
    LoopStart start = close_loop(run, o, recording(poses));
    REQUIRE(start.before);
    CHECK_FALSE(start.closed);
    const std::int64_t first = run.steps(), blended = blended_frames(period);
    REQUIRE(first == 2 * period);
    CHECK(blended == 8); // the last third
    CHECK(start.before->steps() == first - blended);
    LoopBlend blend(std::move(*start.before), period, take_step);
    double moved = 0, off = 0, whole = 0;
    for (std::int64_t f = 1; f <= period; ++f) { // with the one behind the last, for which the loop's first stands
        recording(poses)(run, first + f);
        if (f < period - blended) continue;
        const LoopPose &now = poses[first + f], &then = poses[first + f - period];
        MotionFrame frame;
        frame.position = now.x;
        frame.rotation = now.q;
        blend.blend(frame);
        const double x = double(f - (period - blended)) / double(blended), w = x * x * (3 - 2 * x);
        // The same from turns about axes, root by root and outward.
        LoopPose expected = now;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const bool rooted = tree.parent[i] < 0;
            const auto p = std::size_t(rooted ? 0 : tree.parent[i]);
            const auto own = [&](const LoopPose& pose) {
                return rooted ? pose.q[i] : Quat(pose.q[p].conjugate() * pose.q[i]);
            };
            Eigen::AngleAxisd way(own(now).conjugate() * own(then));
            if (way.angle() > std::numbers::pi) way.angle() -= 2 * std::numbers::pi;
            whole = std::max(whole, std::abs(way.angle()));
            way.angle() *= w;
            expected.q[i] = own(now) * Quat(way);
            if (rooted) continue;
            expected.q[i] = expected.q[p] * expected.q[i];
            expected.x[i] = expected.x[p] + expected.q[p] * tree.joint_position[i];
        }
        const LoopPose made{frame.position, frame.rotation};
        CAPTURE(f, w);
        CHECK(apart(made.x, expected.x) < 1e-9);
        CHECK(largest_angle(made, expected) < 1e-6);
        for (const Quat& q : frame.rotation) REQUIRE(q.norm() == Approx(1).epsilon(1e-12));
        if (f == period - blended) CHECK(apart(made.x, now.x) < 1e-12); // it begins without a jump
        moved = std::max(moved, apart(made.x, now.x));
        if (f == period) off = apart(made.x, poses[first].x);
    }
    CHECK(off < 1e-12);
    CHECK(moved > 1e-3);
    CHECK(whole > 0.1);
    CHECK(apart(poses[first + period].x, poses[first].x) > 1e-3); // which did not meet
}

TEST_CASE("a motion that repeats is blended into itself") {
    Simulation run(looping(leafy(), "gusty"), at_frames(false));
    REQUIRE(run.step(5).finite());
    LoopBlend blend(run.copy(), 6, take_step);
    const LoopPose first = pose_of(run);
    for (int k = 0; k < 2; ++k) { // a copy's motion is its own
        MotionFrame frame;
        frame.position = pose_of(run).x;
        frame.rotation = pose_of(run).q;
        blend.blend(frame);
        CHECK(apart(frame.position, pose_of(run).x) < 1e-12);
        CHECK(largest_angle({frame.position, frame.rotation}, pose_of(run)) < 1e-7);
        take_step(run, 0);
    }
    CHECK(apart(pose_of(run).x, first.x) > 1e-4);
}

TEST_CASE("options that no loop has are refused before a step is taken") {
    Simulation run(looping(make_tree::branched(), "gusty"), at_frames());
    const auto refusal_of = [&](const auto& change) {
        LoopOptions o;
        o.frames = period;
        change(o);
        try {
            close_loop(run, o, take_step);
        } catch (const SceneError& error) {
            CHECK(run.steps() == 0);
            return std::string(error.what());
        }
        return std::string();
    };
    for (const std::int64_t frames : {std::int64_t(0), std::int64_t(-5), std::int64_t(1), std::int64_t(1) << 62}) {
        const std::string text = "frames is " + std::to_string(frames) + ", expected 2 to 1000000000";
        CHECK(refusal_of([&](LoopOptions& o) { o.frames = frames; }) == "close_loop: " + text);
        CHECK_THROWS_WITH(LoopBlend(run.copy(), frames, take_step), "LoopBlend: " + text);
    }
    for (const double tolerance : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK_THAT(refusal_of([&](LoopOptions& o) { o.tolerance = tolerance; }),
                   Catch::StartsWith("close_loop: tolerance is ") &&
                       Catch::EndsWith("expected a share of the height above 0"));
    for (const std::int64_t periods : {0, -1, 1, 1000001})
        CHECK_THAT(refusal_of([&](LoopOptions& o) { o.periods = periods; }),
                   Catch::StartsWith("close_loop: periods is " + std::to_string(periods) + ", expected 2 to 1000000"));
    CHECK(refusal_of([](LoopOptions& o) { o.frames = 2, o.periods = 2; }) == "");
    CHECK(run.steps() == 4);
}
