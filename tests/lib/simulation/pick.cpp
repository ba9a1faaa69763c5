// pick.h: against marching along the ray through the solids as they are defined, and against a search along every axis.
#include "lib/simulation/pick.h"
#include "lib/model/body_shape.h"
#include "tests/support/make_tree.h"
#include "tests/support/sanitized.h"
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace bough;

namespace {

// A cloud of all kinds of bodies, each standing by itself.
struct Cloud {
    Tree tree;
    std::vector<Vec3> x;
    std::vector<Quat> R;
};

Cloud cloud(std::size_t bodies, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(engine); };
    Cloud made;
    made.tree.resize(bodies);
    made.tree.leaf_count.assign(bodies, 1);
    for (std::size_t i = 0; i < bodies; ++i) {
        const int what = int(i % 6);
        made.tree.parent[i] = -1;
        made.tree.kind[i] =
            std::array{Kind::branch, Kind::leaf, Kind::fruit, Kind::petal, Kind::leaf, Kind::branch}[std::size_t(what)];
        if (what == 4) made.tree.leaf_count[i] = 5;
        const double length = uniform(0.2, 1);
        made.tree.size[i] = {length, uniform(0.1, 0.4), what == 0 ? uniform(0.05, 0.4) : 0};
        if (what == 2) made.tree.size[i].z() = made.tree.size[i].y();
        made.x.push_back({uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)});
        made.R.push_back(Quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized());
    }
    return made;
}

// Whether a point of the body's frame lies in its solid; flat ones have the depth that a march needs to see them.
bool inside(const Tree& tree, std::size_t i, const Vec3& p, double depth) {
    const double length = tree.size[i].x(), a = tree.size[i].y(), b = tree.size[i].z(), z = p.z() / length;
    const double across = std::hypot(p.x(), p.y());
    if (is_clump(tree, i))
        return std::pow(p.x() / (a / 2), 2) + std::pow(p.y() / (clump_depth * a / 2), 2) + std::pow(2 * z - 1, 2) <= 1;
    if (tree.kind[i] == Kind::branch) return z >= 0 && z <= 1 && across <= a + (b - a) * z;
    if (tree.kind[i] == Kind::fruit) return (p - Vec3(0, 0, length)).norm() <= a;
    const double widest = tree.kind[i] == Kind::petal ? 0.7 : 0.4;
    return std::abs(p.y()) <= depth && z >= 0 && z <= 1 &&
           std::abs(p.x()) <= a / 2 * std::min(z / widest, (1 - z) / (1 - widest));
}

Ray random_ray(std::mt19937_64& engine) {
    std::normal_distribution normal;
    const auto vector = [&] { return Vec3(normal(engine), normal(engine), normal(engine)); };
    const Vec3 from = 5 * vector().normalized();
    return {from, 3 * (vector() - from), 0};
}

} // namespace

TEST_CASE("the first body on a ray is the one that a march along it comes to") {
    const Cloud bodies = cloud(42, 3);
    std::mt19937_64 engine(8);
    int met = 0, missed = 0;
    for (int k = 0; k < (sanitized ? 20 : 160); ++k) {
        const Ray ray = random_ray(engine);
        const std::optional<RayHit> hit = pick(bodies.tree, bodies.x, bodies.R, ray);
        const double step = 2e-3;
        double first = 100;
        std::size_t body = 0;
        for (std::size_t i = 0; i < bodies.tree.size_bodies(); ++i) {
            const Vec3 from = bodies.R[i].conjugate() * (ray.from - bodies.x[i]);
            const Vec3 direction = bodies.R[i].conjugate() * ray.direction.normalized();
            for (double t = std::max(0.0, from.norm() - 1.5); t < from.norm() + 1.5 && t < first; t += step)
                if (inside(bodies.tree, i, from + t * direction, step * std::abs(direction.y()))) first = t, body = i;
        }
        if (hit) {
            ++met;
            INFO("ray " << k << " body " << hit->body << " at " << hit->distance << ", marched " << body << " "
                        << first);
            // On the solid's surface, on the ray, nothing met before it; a grazed edge is narrower than the march's step.
            CHECK(hit->distance < first + 2 * step);
            CHECK((ray.from + hit->distance * ray.direction.normalized() - hit->world).norm() < 1e-9);
            CHECK((bodies.x[hit->body] + bodies.R[hit->body] * hit->point - hit->world).norm() < 1e-12);
            const Vec3 inward = hit->point + 1e-7 * (bodies.R[hit->body].conjugate() * ray.direction.normalized());
            CHECK((inside(bodies.tree, hit->body, inward, 1e-6) || inside(bodies.tree, hit->body, hit->point, 1e-6)));
        } else {
            ++missed;
            CHECK(first == 100);
        }
    }
    CHECK(met > (sanitized ? 4 : 40));
    CHECK(missed > (sanitized ? 4 : 40));
}

TEST_CASE("near a ray that meets nothing, the body is the one whose axis is least off it, within the aperture") {
    Cloud bodies = cloud(24, 5);
    for (Vec3& size : bodies.tree.size) size = {size.x(), 1e-9, 1e-9}; // no wider than a line
    bodies.tree.leaf_count.assign(24, 1);
    for (Kind& kind : bodies.tree.kind) kind = Kind::branch;
    std::mt19937_64 engine(2);
    int found = 0;
    for (int k = 0; k < (sanitized ? 8 : 60); ++k) {
        Ray ray = random_ray(engine);
        CHECK_FALSE(pick(bodies.tree, bodies.x, bodies.R, ray));
        double least = 10;
        std::size_t body = 0;
        for (std::size_t i = 0; i < bodies.x.size(); ++i)
            for (int j = 0; j <= 4000; ++j) {
                const Vec3 p = bodies.x[i] + bodies.R[i] * Vec3(0, 0, bodies.tree.size[i].x() * j / 4000) - ray.from;
                const double off = std::atan2(p.cross(ray.direction).norm(), p.dot(ray.direction));
                if (off < least) least = off, body = i;
            }
        ray.aperture = least * 1.001;
        const std::optional<RayHit> hit = pick(bodies.tree, bodies.x, bodies.R, ray);
        REQUIRE(hit);
        CHECK(hit->body == body);
        const Vec3 to = hit->world - ray.from;
        CHECK(std::atan2(to.cross(ray.direction).norm(), to.dot(ray.direction)) == Approx(least).epsilon(1e-3));
        CHECK(hit->point.head<2>().norm() == 0);
        ray.aperture = least * 0.999;
        CHECK_FALSE(pick(bodies.tree, bodies.x, bodies.R, ray));
        ++found;
    }
    CHECK(found == (sanitized ? 8 : 60));
}

TEST_CASE("a ray picks of a simulation what it can pull, and a ray that is none is refused") {
    Scene scene;
    scene.add(make_tree::chain(3, 1.5, 0.02, 0.01));
    SimulationOptions o;
    o.pulls = true;
    Simulation simulation(scene, o);
    const Vec3 there = simulation.positions()[2] + simulation.rotations()[2] * Vec3(0, 0, 0.4);
    const std::optional<RayHit> hit = pick(simulation, {there + Vec3(7, 0, 0), {-1, 0, 0}, 0});
    REQUIRE(hit);
    CHECK(hit->body == 2);
    CHECK(hit->point.z() == Approx(0.4));
    simulation.pull(hit->body, hit->point, {1, 0, 0});
    CHECK(simulation.step().finite());
    CHECK_FALSE(pick(simulation, {there + Vec3(7, 0, 0), {1, 0, 0}, std::numbers::pi / 2}));
    CHECK_THROWS_AS(pick(simulation, {there, {0, 0, 0}, 0}), SceneError);
    CHECK_THROWS_AS(pick(simulation, {there, {0, 0, NAN}, 0}), SceneError);
    CHECK_THROWS_AS(pick(simulation, {there, {1, 0, 0}, NAN}), SceneError);
    CHECK_THROWS_AS(pick(simulation, {there, {1, 0, 0}, 2}), SceneError);
}
