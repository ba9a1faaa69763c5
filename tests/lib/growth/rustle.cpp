// The rustle of a clump's leaves against its law: what the vertices' normals do, in steady winds, gusts and calm.
#include "lib/growth/rustle.h"
#include "lib/laws/wind.h"
#include "lib/laws/wind_speeds.h"
#include "tests/support/skin_checks.h"
#include "tests/support/wind_at.h"

using namespace bough;
using namespace skin_checks;
using make_tree::degree;

namespace {

constexpr double fps = 30;

// A pole that bears clumps of 40 leaves.
Tree bush(int clumps) {
    Tree t = make_tree::chain(1, 2, 0.03, 0.02);
    for (int k = 0; k < clumps; ++k) {
        const std::size_t i = t.size_bodies();
        t.resize(i + 1);
        t.parent[i] = 0;
        t.kind[i] = Kind::leaf;
        t.mass[i] = 0.01;
        t.size[i] = Vec3(0.5, 0.4, 2e-4);
        t.com[i] = Vec3(0, 0, 0.2);
        t.inertia[i] = 1e-4 * Mat3::Identity();
        t.joint_position[i] = Vec3(0.02, 0, 0.3 + 0.1 * k);
        t.joint_rotation[i] = Quat(Eigen::AngleAxisd(1 + k, Vec3(1, 0.2 * k, 0.3).normalized()));
        t.stiffness[i] = Vec3::Ones();
        t.damping[i] = 0.01;
        t.branch[i] = t.level[i] = 0;
        t.s[i] = 0.5;
    }
    t.leaf_count.assign(t.size_bodies(), 40);
    t.leaf_count[0] = 1;
    return t;
}

ClumpWind steady_wind(double speed) {
    return [speed](double, std::vector<double>& all) { std::fill(all.begin(), all.end(), speed); };
}

struct Leaves {
    std::vector<Vec3> position, normal;
};
Leaves rustled(const Skin& skin, Rustle& rustle, std::int64_t frame) {
    Leaves leaves{skin.position, skin.normal};
    rustle.go_to(frame);
    rustle.turn(leaves.position, leaves.normal);
    return leaves;
}

double turned_by(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

double largest_turn(const Skin& skin, const ClumpWind& wind, std::int64_t first, std::int64_t frames) {
    Rustle rustle(skin, wind, {fps, {}, false});
    Leaves before = rustled(skin, rustle, first);
    double largest = 0;
    for (std::int64_t f = first + 1; f < first + frames; ++f) {
        Leaves now = rustled(skin, rustle, f);
        for (const std::int32_t v : skin.clump_leaf)
            largest = std::max(largest, turned_by(before.normal[std::size_t(v)], now.normal[std::size_t(v)]));
        before = std::move(now);
    }
    return largest;
}

} // namespace

TEST_CASE("the law: nothing in a calm, some 15 degrees at 6 to 8 m/s, 20 at most, 2 Hz and more") {
    CHECK(rustle_amplitude(0) == 0);
    CHECK(rustle_amplitude(1) < 1 * degree);
    CHECK(rustle_amplitude(7) == Approx(15 * degree).epsilon(0.02));
    CHECK(rustle_amplitude(60) == Approx(20 * degree).epsilon(1e-6));
    CHECK(rustle_frequency(0) == 0);
    CHECK(rustle_frequency(2) == Approx(2).epsilon(0.05));
    CHECK(rustle_frequency(8) == Approx(2 * rustle_frequency(2)));
    CHECK(rustle_frequency(40) == rustle_frequency(20));
}

TEST_CASE("normals turn by the law's amplitude about a foot that stays, and blades keep their shape") {
    const Skin skin = build_skin(bush(5), {});
    REQUIRE(skin.clump_leaf.size() == 200);
    for (const double wind : {2.0, 4.0, 8.0, 20.0}) {
        Rustle rustle(skin, steady_wind(wind), {fps, {}, false});
        double squares = 0, stray = 0;
        constexpr int frames = 300;
        for (int f = 0; f < frames; ++f) {
            const Leaves now = rustled(skin, rustle, f);
            for (const std::int32_t v : skin.clump_leaf) {
                const auto k = std::size_t(v);
                const double a = turned_by(skin.normal[k], now.normal[k]);
                squares += a * a;
                const Vec3 foot = (now.position[k] + now.position[k + 4]) / 2;
                stray = std::max(stray, (foot - (skin.position[k] + skin.position[k + 4]) / 2).norm());
                for (std::size_t c = 1; c < leaf_vertices; ++c)
                    stray = std::max(stray, std::abs((now.position[k + c] - now.position[k]).norm() -
                                                     (skin.position[k + c] - skin.position[k]).norm()));
            }
        }
        CHECK(std::sqrt(squares / (200.0 * frames)) == Approx(rustle_amplitude(wind)).epsilon(0.02));
        CHECK(stray < 1e-12);
    }
}

TEST_CASE("its rate is the law's: zeros of the angle's change") {
    const Skin skin = build_skin(bush(1), {});
    const double wind = 3, fine = 600;
    Rustle rustle(skin, steady_wind(wind), {fine, {}, true}); // c = 1
    double last = 0;
    int turns = 0;
    constexpr int frames = 12'000;
    for (int f = 0; f <= frames; ++f) {
        rustle.go_to(f);
        const double now = rustle.weights()[0];
        turns += f > 0 && last < 0 && now >= 0;
        last = now;
    }
    CHECK(turns / (frames / fine) == Approx(rustle_frequency(wind)).margin(0.06));
}

TEST_CASE("no leaf turns by 30 degrees between two frames, nor jumps where the wind changes") {
    const Skin skin = build_skin(bush(5), {});
    const auto gusts = [](double t, std::vector<double>& all) {
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = 15 * (1 + std::sin(2 * t + double(k)));
    };
    CHECK(largest_turn(skin, gusts, 0, 300) < 30 * degree);
    CHECK(largest_turn(skin, steady_wind(50), 0, 300) < 30 * degree);
    // From frame to frame another wind: a phase that were frequency times time would jump by 200 rad after 100 s.
    const auto flicker = [](double t, std::vector<double>& all) {
        std::fill(all.begin(), all.end(), std::llround(t * fps) % 2 == 0 ? 4.0 : 5.0);
    };
    const double change = 2 * (rustle_amplitude(5) - rustle_amplitude(4));
    const double most =
        2 * rustle_amplitude(5) * (std::sin(std::numbers::pi * 0.12) + std::sin(std::numbers::pi * 0.08));
    CHECK(largest_turn(skin, flicker, 3000, 300) < most + change);
}

TEST_CASE("in a calm nothing rustles, bit by bit") {
    const Skin skin = build_skin(bush(3), {});
    Rustle rustle(skin, steady_wind(0), {fps, {}, false});
    const Leaves still = rustled(skin, rustle, 77);
    CHECK(still.position == skin.position);
    CHECK(still.normal == skin.normal);
}

TEST_CASE("a frame's leaves do not depend on how it was come to") {
    const Skin skin = build_skin(bush(3), {});
    const auto wind = [](double t, std::vector<double>& all) {
        std::fill(all.begin(), all.end(), 5 + 3 * std::sin(t));
    };
    Rustle once(skin, wind, {fps, {}, false}), stepped(skin, wind, {fps, {}, false});
    for (int f = 0; f < 120; ++f) rustled(skin, stepped, f);
    CHECK(rustled(skin, once, 120).position == rustled(skin, stepped, 120).position);
}

TEST_CASE("where the wind repeats the leaves do too") {
    const Skin skin = build_skin(bush(3), {});
    const auto wind = [](double t, std::vector<double>& all) {
        std::fill(all.begin(), all.end(), 5 + 3 * std::sin(std::numbers::pi * t));
    };
    for (const bool together : {false, true}) {
        Rustle rustle(skin, wind, {fps, 4.0, together});
        const Leaves first = rustled(skin, rustle, 0), second = rustled(skin, rustle, 1),
                     last = rustled(skin, rustle, 120), after = rustled(skin, rustle, 121);
        double seam = 0, moved = 0;
        for (std::size_t v = 0; v < skin.position.size(); ++v) {
            seam = std::max(
                {seam, (first.position[v] - last.position[v]).norm(), (second.position[v] - after.position[v]).norm()});
            moved = std::max(moved, (second.position[v] - first.position[v]).norm());
        }
        CHECK(seam < 1e-9);
        CHECK(moved > 1e-3);
    }
}

TEST_CASE("morph targets are what leaves do together, to first order") {
    const Skin skin = build_skin(bush(3), {});
    for (const double wind : {0.5, 1.0}) {
        Rustle rustle(skin, steady_wind(wind), {fps, {}, true});
        const Leaves now = rustled(skin, rustle, 40);
        const auto weights = rustle.weights();
        double off = 0, moved = 0;
        for (std::size_t k = 0; k < skin.clump_leaf.size(); ++k) {
            Vec3 axis = Vec3::Zero();
            for (std::size_t m = 0; m < Rustle::targets; ++m) axis += weights[m] * rustle.target(k, m);
            const auto v = std::size_t(skin.clump_leaf[k]) + 3; // its tip
            const Vec3 change = axis.cross(skin.position[v] - rustle.foot(k));
            off = std::max(off, (skin.position[v] + change - now.position[v]).norm());
            moved = std::max(moved, change.norm());
        }
        const double largest = 2 * rustle_amplitude(wind);
        CHECK(moved > 0);
        CHECK(off < largest * largest / 2 * 0.1); // a blade is 8 cm long
    }
}

TEST_CASE("speeds at places are the wind's own") {
    Scene scene;
    scene.wind = wind_preset("gusty");
    scene.trees.resize(2);
    scene.trees[1].start = 2.5;
    const std::vector<Vec3> places = {{0, 3, 0}, {1, 8, 2}, {4, 0, 1}};
    const auto speeds = wind_speeds(scene, places, {0, 1, 1});
    std::vector<double> speed;
    for (const double t : {0.0, 1.7, 9.0}) {
        speeds(t, speed);
        REQUIRE(speed.size() == 3);
        CHECK(speed[0] == Approx(wind_at(*scene.wind, places[0], t).norm()).epsilon(0.01));
        CHECK(speed[1] == Approx(wind_at(*scene.wind, places[1], t + 2.5).norm()).epsilon(0.01));
        CHECK(speed[2] == 0);
    }
    scene.wind.reset();
    wind_speeds(scene, places, {0, 1, 1})(1, speed);
    CHECK(speed == std::vector<double>{0, 0, 0});
}
