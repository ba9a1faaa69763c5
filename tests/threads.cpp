// What runs on several threads: steps (simulation.h) and the frames beside them (frame_queue.h). This is the thread sanitizer's program, so it is small and
// needs the library alone; the command line's threads are tests/cli/threads.sh.
#include "lib/bough.h"
#include "tools/frame_queue.h"
#include <catch2/catch.hpp>
#include <stdexcept>
#ifdef _OPENMP
#include <omp.h>
#endif

using namespace bough;

namespace {

const Tree& tree_in_leaf() {
    static const Tree tree =
        segment(grow_bodies(default_growth(), 5, {true, false, true}, 6000), wood_presets().front(), {});
    return tree;
}

std::uint64_t hash_after(const Scene& scene, SimulationOptions o, int threads, int steps) {
    o.threads = threads;
    Simulation simulation(scene, o);
    for (int k = 0; k < steps; ++k)
        if (!simulation.step().finite()) return 0; // Catch2 is for one thread
    (void)simulation.positions();
    return simulation.hash();
}

void check_threads(const Scene& scene, const SimulationOptions& o, int steps) {
    const std::uint64_t one = hash_after(scene, o, 1, steps);
    REQUIRE(one != 0);
    for (const int threads : {2, 3, 8}) CHECK(hash_after(scene, o, threads, steps) == one);
}

// Keeps what it is given.
class Kept : public FrameSink {
public:
    std::vector<std::int64_t> frame;
    std::vector<double> first;
    std::int64_t fails_at = -1;
    bool finished = false;
    void write(const MotionFrame& f) override {
        if (f.frame == fails_at) throw std::runtime_error("full");
        frame.push_back(f.frame);
        first.push_back(f.position.front().x());
    }
    void finish() override { finished = true; }
};

void fill(MotionFrame& frame, std::int64_t number) {
    frame.frame = number;
    frame.position.assign(1000, Vec3(double(number), 0, 0));
}

} // namespace

TEST_CASE("one hash for any number of threads, in either method and precision") {
    Scene scene;
    scene.add(tree_in_leaf());
    scene.wind = wind_preset("storm"); // some of it turns fast, so that the energy guard looks at it, too
    for (const Method method : {Method::coupled, Method::analytic})
        for (const Precision precision : {Precision::single, Precision::double_}) {
            SimulationOptions o;
            o.method = method;
            o.precision = precision;
            check_threads(scene, o, 10);
        }
    SimulationOptions plain;
    plain.portable = true;
    check_threads(scene, plain, 3);
}

TEST_CASE("one hash with what breaks off, falls and hits, over two trees that shelter each other") {
    Scene scene;
    const auto tree = std::make_shared<const Tree>(tree_in_leaf());
    scene.add(tree);
    scene.add(tree, Vec3(12, 0, 0), 40);
    scene.wind = wind_preset("storm");
    scene.wind->shelter = WindShelter{2};
    scene.fracture = Fracture();
    scene.fracture->leaf = 5e-3;
    Ball ball;
    ball.position = Vec3(0, 30, 0);
    scene.balls = {ball};
    check_threads(scene, {}, 6);
}

TEST_CASE("simulations on threads of their own do not disturb each other") {
    Scene scene;
    scene.add(tree_in_leaf());
    scene.wind = wind_preset("gusty");
    const std::uint64_t one = hash_after(scene, {}, 1, 6);
    std::vector<std::uint64_t> hash(3, 0);
    std::vector<std::thread> users;
    for (std::size_t k = 0; k < hash.size(); ++k)
        users.emplace_back([&scene, &hash, k] { hash[k] = hash_after(scene, {}, int(k) + 1, 6); });
    for (std::thread& user : users) user.join();
    for (const std::uint64_t h : hash) CHECK(h == one);
}

#ifdef _OPENMP
TEST_CASE("a program's own parallel loops are its own, and may step simulations") {
    Scene scene;
    scene.add(tree_in_leaf());
    scene.wind = wind_preset("gusty");
    const int before = omp_get_max_threads();
    omp_set_num_threads(3);
    const std::uint64_t one = hash_after(scene, {}, 1, 3);
    std::vector<std::uint64_t> hash(4, 0);
#pragma omp parallel for
    for (int k = 0; k < 4; ++k) hash[std::size_t(k)] = hash_after(scene, {}, 1 + k % 3, 3);
    for (const std::uint64_t h : hash) CHECK(h == one);
    CHECK(omp_get_max_threads() == 3);
    omp_set_num_threads(before);
}
#endif

TEST_CASE("a queue hands every frame on, once, in order; what the sink throws comes back") {
    for (const std::size_t slots : {1, 2, 5}) {
        Kept sink;
        {
            FrameQueue queue(sink, slots);
            for (std::int64_t k = 0; k < 200; ++k) {
                fill(queue.next(), k);
                queue.push();
            }
            queue.finish();
        }
        REQUIRE(sink.frame.size() == 200);
        for (std::int64_t k = 0; k < 200; ++k) {
            CHECK(sink.frame[std::size_t(k)] == k);
            CHECK(sink.first[std::size_t(k)] == double(k));
        }
        CHECK(sink.finished);
        Kept full;
        full.fails_at = 7;
        FrameQueue queue(full, slots);
        const auto write_all = [&] {
            for (std::int64_t k = 0; k < 200; ++k) {
                fill(queue.next(), k);
                queue.push();
            }
            queue.finish();
        };
        CHECK_THROWS_WITH(write_all(), "full");
        CHECK(full.frame.size() == 7);
        CHECK_FALSE(full.finished);
    }
}
