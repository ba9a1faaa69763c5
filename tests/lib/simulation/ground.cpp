// simulation.h, driven_ground.h: a ground that is moved from step to step.
#include "lib/model/root_motion.h"
#include "lib/simulation/simulation.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

namespace {

const Vec3 place(3, 0.5, -2);

// Of soft wood, in air.
Scene planted(const char* wind = nullptr) {
    Scene scene;
    scene.add(make_tree::branched(), place, 40);
    scene.stiffness_scale = 0.5;
    scene.wind = wind ? *wind_preset(wind) : Wind();
    return scene;
}

SimulationOptions driven(double step = 1.0 / 30) {
    SimulationOptions o;
    o.step = step;
    o.grounds = true;
    return o;
}

// Swings to and fro, and turns about an axis that changes by more than half a turn in all.
RootMotion ride() {
    RootMotion motion;
    for (int k = 0; k <= 8; ++k) {
        const double s = 0.25 * k;
        motion.time.push_back(s);
        motion.position.push_back(Vec3(0.3 * std::sin(2 * s), 0.1 * s * s, -0.2 * s));
        motion.rotation.push_back(Quat(Eigen::AngleAxisd(1.8 * s, Vec3(0.2 * s, 1, 0.3).normalized())));
    }
    return motion;
}

GroundMotion at(const RootSpline& spline, double t) {
    const Ground ground = ground_at(spline, t);
    const CurvePoint p = curve_at(*spline.position, t);
    return {p.x, Quat(ground.R), p.v, ground.omega};
}

// Positions as seen from the ground: where they would be if it had not moved.
std::vector<Vec3> seen(const Simulation& simulation, const GroundMotion& from) {
    std::vector<Vec3> x;
    for (const Vec3& p : simulation.positions())
        x.push_back(place + from.rotation.conjugate() * (p - place - from.position));
    return x;
}

// How far a led ground's tree is from the one of the scene's keys, at most, in 1.5 s of frames, in still air; and that one from a tree whose ground rests.
std::pair<double, double> differences(SimulationOptions o, int frames) {
    o.step = 1.5 / frames;
    const RootMotion motion = ride();
    const RootSpline spline = make_root_spline(motion, place);
    Scene keyed = planted();
    keyed.root_motion = {motion};
    Simulation truth(keyed, o);
    o.grounds = true;
    Simulation led(planted(), o), still(planted(), o);
    double off = 0, moved = 0;
    for (int k = 1; k <= frames; ++k) {
        const GroundMotion now = at(spline, k * o.step);
        led.set_ground(0, now);
        REQUIRE((led.step().finite() && truth.step().finite() && still.step().finite()));
        CHECK((led.positions()[0] - truth.positions()[0]).norm() < 1e-5); // the root itself, in single precision
        off = std::max(off, apart(led.positions(), truth.positions()));
        moved = std::max(moved, apart(seen(truth, now), seen(still, {})));
    }
    return {off, moved};
}

} // namespace

TEST_CASE(
    "a ground that is led moves its tree as a scene's ground of the same keys, the more so the smaller the steps") {
    for (const Method method : {Method::coupled, Method::analytic})
        for (const bool portable : {false, true}) {
            SimulationOptions o;
            o.method = method;
            o.portable = portable;
            const auto [coarse, moved] = differences(o, 45);
            const auto [fine, same] = differences(o, 180);
            CAPTURE(int(method), portable, coarse, fine, moved, same);
            CHECK(moved > 2e-3);
            CHECK(coarse < (method == Method::coupled ? 1e-2 : 1e-12) * moved); // analytic reads no pose half-way
            CHECK((fine < coarse / 100 || fine < 1e-12 * moved));
        }
    SimulationOptions single;
    single.precision = Precision::single;
    const auto [off, moved] = differences(single, 45);
    CHECK(off < 1e-2 * moved);
}

TEST_CASE("a ground that speeds up steadily is a gravity that leans back") {
    const Vec3 a(1.5, 0.5, -1);
    Scene scene = planted(), leaning = planted();
    scene.pose = leaning.pose = Pose::rest; // where the springs' rest does not hang on gravity
    scene.wind.reset();                     // air would not be carried along
    leaning.wind.reset();
    leaning.gravity -= a;
    const auto differences_at = [&](int rate) {
        const SimulationOptions o = driven(1.0 / rate);
        Simulation carried(scene, o), leant(leaning, o), left(scene, o);
        double off = 0, moved = 0;
        for (int k = 1; k <= 2 * rate; ++k) {
            const double t = k * o.step;
            GroundMotion motion;
            motion.position = a * t * t / 2;
            motion.velocity = a * t;
            carried.set_ground(0, motion);
            REQUIRE((carried.step().finite() && leant.step().finite() && left.step().finite()));
            off = std::max(off, apart(seen(carried, motion), leant.positions()));
            moved = std::max(moved, apart(leant.positions(), left.positions()));
        }
        return std::pair{off, moved};
    };
    const auto [coarse, moved] = differences_at(60);
    const auto [fine, same] = differences_at(240);
    CAPTURE(coarse, fine, moved, same);
    CHECK(moved > 1e-3);
    CHECK(coarse < 0.02 * moved);
    CHECK(fine < coarse / 3); // the jolt that begins it is spread over a step
}

TEST_CASE("a ground that nothing more is asked of goes on as it moves, one that is put stands there at once") {
    Simulation simulation(planted(), driven());
    GroundMotion motion;
    motion.position = Vec3(0.1, 0, 0);
    motion.rotation = Quat(Eigen::AngleAxisd(0.2, Vec3::UnitY()));
    motion.velocity = Vec3(0.5, 0, 0.2);
    motion.angular_velocity = Vec3(0, 1.5, 0);
    simulation.set_ground(0, motion, 3); // where it is after three steps, on the way between
    const Vec3 start = simulation.positions()[0];
    REQUIRE(simulation.step().finite());
    const double gone = (simulation.positions()[0] - start).norm();
    CHECK((gone > 0 && gone < 0.1));
    REQUIRE(simulation.step(2).finite());
    CHECK((simulation.positions()[0] - place - motion.position).norm() < 1e-12);
    REQUIRE(simulation.step(7).finite());
    const double t = 7.0 / 30;
    CHECK((simulation.positions()[0] - place - motion.position - t * motion.velocity).norm() < 1e-12);
    // From there it is put elsewhere: its tree as it is, seen from the ground, and then at rest as where it was drawn.
    GroundMotion turning = motion;
    turning.position += t * motion.velocity;
    turning.rotation = Quat(Eigen::AngleAxisd(1.5 * t, Vec3::UnitY())) * motion.rotation;
    const std::vector<Vec3> before = seen(simulation, turning);
    GroundMotion there;
    there.position = Vec3(-4, 1, 0);
    there.rotation = Quat(Eigen::AngleAxisd(2, Vec3::UnitY()));
    simulation.set_ground(0, there, 0);
    CHECK(apart(seen(simulation, there), before) < 1e-12);
    Simulation other(planted(), driven());
    const std::vector<Vec3> drawn(other.positions().begin(), other.positions().end());
    other.set_ground(0, there, 0);
    CHECK(apart(seen(other, there), drawn) < 1e-12);
    REQUIRE(other.step(60).finite());
    CHECK(apart(seen(other, there), drawn) < 1e-9);
}

TEST_CASE("a copy, a run that is cut and one that takes over go on with their grounds") {
    const RootSpline spline = make_root_spline(ride(), place);
    const auto lead = [&](Simulation& simulation, int from, int to) {
        for (int k = from + 1; k <= to; ++k) {
            simulation.set_ground(0, at(spline, k / 30.0));
            REQUIRE(simulation.step().finite());
        }
        return simulation.hash();
    };
    Scene scene = planted("gusty");
    scene.add(make_tree::branched(), Vec3(9, 0, 0)); // whose ground rests
    Simulation whole(scene, driven());
    lead(whole, 0, 20);
    Simulation copied = whole.copy(), left = whole.copy();
    const SavedState saved = whole.save();
    const std::uint64_t hash = lead(whole, 20, 30);
    CHECK(lead(copied, 20, 30) == hash);
    REQUIRE(left.step(10).finite());
    CHECK(left.hash() != hash);
    // What is restored stands on the ground as this run has it by now.
    Simulation again(scene, driven());
    again.set_ground(0, at(spline, 20 / 30.0), 0);
    again.restore(saved);
    CHECK(again.steps() == 20);
    Simulation there = whole.copy();
    there.restore(saved);
    there.set_ground(0, at(spline, 20 / 30.0), 0);
    CHECK(apart(again.positions(), there.positions()) < 1e-12);
    lead(again, 20, 30);
    CHECK(apart(again.positions(), whole.positions()) < 1e-4); // the ground's acceleration at the cut is not known
    Simulation after(scene, driven(), whole);
    CHECK(apart(after.positions(), whole.positions()) < 1e-12);
    lead(after, 30, 31), lead(whole, 30, 31);
    CHECK((after.positions()[0] - whole.positions()[0]).norm() < 1e-12);
}

TEST_CASE("a ground that cannot be led is refused") {
    Simulation plain(planted());
    CHECK_THROWS_WITH(plain.set_ground(0, {}), Catch::Contains("grounds"));
    Scene keyed = planted();
    keyed.root_motion = {ride()};
    keyed.add(make_tree::branched(), Vec3(9, 0, 0));
    Simulation simulation(keyed, driven());
    CHECK_THROWS_WITH(simulation.set_ground(0, {}), Catch::Contains("/root_motion"));
    CHECK_THROWS_WITH(simulation.set_ground(2, {}), Catch::Contains("has 2"));
    CHECK_THROWS_WITH(simulation.set_ground(1, {}, -1), Catch::Contains("steps"));
    GroundMotion bad;
    bad.rotation = Quat(0, 0, 0, 0);
    CHECK_THROWS_WITH(simulation.set_ground(1, bad), Catch::Contains("rotation"));
    bad = {};
    bad.velocity.x() = NAN;
    CHECK_THROWS_WITH(simulation.set_ground(1, bad), Catch::Contains("velocity"));
    CHECK(simulation.step().finite());
}
