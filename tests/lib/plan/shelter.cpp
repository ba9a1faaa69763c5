// Shelter: what the bodies take is what the columns lose, counted by a separate sum; who stands behind whom.
#include "lib/plan/shelter.h"
#include "lib/laws/air.h"
#include "lib/plan/body_air.h"
#include "tests/support/lanes_support.h"
#include <map>

using namespace bough;
using namespace lanes;

namespace {

Scene blowing(const Vec3& velocity, double cell) {
    Scene scene = solver::empty_scene();
    scene.wind = Wind{};
    scene.wind->velocity = velocity;
    scene.wind->profile = 0;
    scene.wind->shelter = WindShelter{cell};
    return scene;
}

// Each moved over the ground.
Tree standing(const Tree& tree, const std::vector<Vec3>& places) {
    std::vector<Tree> trees;
    for (const Vec3& place : places) {
        trees.push_back(tree);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            if (tree.parent[i] < 0) trees.back().joint_position[i] += place;
    }
    return make_tree::forest(trees);
}

double mean(const std::vector<double>& factors, std::size_t first, std::size_t end) {
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += factors[i];
    return sum / double(end - first);
}

} // namespace

TEST_CASE("the momentum taken from the columns is the sum of the drags on the standing bodies") {
    const Tree tree = standing(firm(grown(400)), {Vec3::Zero(), Vec3(3, 0, 0.4), Vec3(5, 0, -0.5)});
    for (const Vec3& velocity : {Vec3(7, 0, 0), Vec3(-3, 1, 5), Vec3(0, -4, 0)})
        for (const double cell : {1.1, 1.5}) {
            const Plan<double> plan = solver::plan_of<double>(tree, blowing(velocity, cell));
            const State<double> state = make_state(plan);
            const Vec3 e = velocity.normalized();
            // Drags: what external_forces puts on a body at rest, along the wind.
            double drags = 0;
            for (std::size_t i = 0; i < plan.bodies; ++i)
                drags += plan.drag_area[i] *
                         air_force<double>(plan.kind[i], state.R_wb[i], plan.shelter[i] * velocity, facing_of(plan, i))
                             .force.dot(e);
            // Columns: the air that leaves each, from the last body in it and what that body itself holds back.
            struct Last {
                double along = -1e9, flux = 0;
            };
            std::map<std::pair<long, long>, Last> columns;
            const Vec3 any = std::abs(e.y()) < 0.9 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX());
            const Vec3 a = e.cross(any).normalized(), b = a.cross(e);
            for (std::size_t i = 0; i < plan.bodies; ++i) {
                const Vec3 place = state.x_w[i] + state.R_wb[i] * plan.com[i];
                Last& last = columns[{long(std::floor(place.dot(a) / cell)), long(std::floor(place.dot(b) / cell))}];
                if (place.dot(e) < last.along) continue;
                const double u = plan.shelter[i] * velocity.norm();
                const double held =
                    plan.drag_area[i] *
                    air_force<double>(plan.kind[i], state.R_wb[i], u * e, facing_of(plan, i)).force.dot(e);
                // A clump's speed is one that the column has within it, and u^2 falls by exp(-s) from its one side to the other; so is
                // that of wood which stands for other wood.
                const auto many = [&](std::size_t k) {
                    return plan.kind[k] == Kind::clump || (!tree.drag.empty() && tree.drag[k] > 1);
                };
                const double own = 1.2 * u * u * cell * cell, s = held / own;
                last = {place.dot(e), many(i) ? held / std::expm1(s) : own - held};
            }
            double lost = 0;
            for (const auto& [column, last] : columns) {
                lost += 1.2 * velocity.squaredNorm() * cell * cell - last.flux;
                CHECK(last.flux > 0);
            }
            CAPTURE(velocity.transpose(), cell);
            CHECK(columns.size() > 3);
            CHECK(lost == Approx(drags).epsilon(1e-11));
            CHECK(*std::min_element(plan.shelter.begin(), plan.shelter.end()) < 0.95);
        }
}

TEST_CASE("a tree behind a tree is sheltered, one beside it or before it is not") {
    const Tree tree = firm(grown(400));
    const std::size_t n = tree.size_bodies();
    const std::vector<double> alone = solver::plan_of<double>(tree, blowing(Vec3(6, 0, 0), 1)).shelter;
    const Plan<double> plan = solver::plan_of<double>(standing(tree, {Vec3::Zero(), Vec3(40, 0, 0), Vec3(40, 0, 50)}),
                                                      blowing(Vec3(6, 0, 0), 1));
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(plan.shelter[i] == Approx(alone[i]).epsilon(1e-12));         // the first
        CHECK(plan.shelter[2 * n + i] == Approx(alone[i]).epsilon(1e-12)); // the one beside
        CHECK(plan.shelter[n + i] <= alone[i] + 1e-12);
    }
    CHECK(mean(plan.shelter, n, 2 * n) < 0.97 * mean(alone, 0, n));
    // With the wind from the other side it is the first one that is sheltered.
    const Plan<double> back =
        solver::plan_of<double>(standing(tree, {Vec3::Zero(), Vec3(40, 0, 0)}), blowing(Vec3(-6, 0, 0), 1));
    CHECK(mean(back.shelter, 0, n) < mean(back.shelter, n, 2 * n));
    // What is sheltered bends less, in every step.
    for (const Solver solver : all_solvers) {
        if (solver == Solver::articulated_explicit) continue;
        for (const Simd simd : {Simd(), Simd(fast::best_target())}) {
            if (simd && is_articulated(solver)) continue;
            Case c{"", standing(tree, {Vec3::Zero(), Vec3(40, 0, 0)}), blowing(Vec3(6, 0, 0), 1)};
            c.ranges = {{0, n, 0}, {n, n, *std::max_element(tree.branch.begin(), tree.branch.end()) + 1}};
            c.solver = solver;
            LanesRun<> run(c, simd);
            for (int k = 0; k < 15; ++k) run.frame();
            double first = 0, second = 0;
            for (std::size_t i = 0; i < n; ++i) {
                first += run.state.theta[i].squaredNorm();
                second += run.state.theta[n + i].squaredNorm();
            }
            CAPTURE(solver_name(solver), simd.has_value());
            REQUIRE(first > 0);
            CHECK(second < 0.95 * first);
        }
    }
}

TEST_CASE("a row of bodies beside one another has all of the wind") {
    std::vector<Vec3> places;
    for (int k = 0; k < 7; ++k) places.push_back(Vec3(0, 0, 2.0 * k));
    const Tree row = standing(make_tree::chain(1, 1, 0.02, 0.02), places);
    for (const double f : solver::plan_of<double>(row, blowing(Vec3(5, 0, 0), 1)).shelter) CHECK(f == 1);
    // The same row along the wind: each behind the others, by the drag's closed form sqrt((1 - share)^k).
    const Plan<double> file = solver::plan_of<double>(row, blowing(Vec3(0, 0, 5), 1));
    const double share = 0.6 * 1 * 0.04 / 1; // C_d / 2 times length and breadth over the column
    for (std::size_t k = 0; k < 7; ++k)
        CHECK(file.shelter[k] == Approx(std::pow(1 - share, 0.5 * double(k))).epsilon(1e-12));
}

TEST_CASE("columns that a body fills are refused; without air nothing shelters; without shelter there is none") {
    const Tree tree = make_tree::chain(3, 1, 0.2, 0.2);
    CHECK_THROWS_WITH(solver::plan_of<double>(tree, blowing(Vec3(5, 0, 0), 0.1)),
                      Catch::StartsWith("/wind/shelter/cell: is 0.1"));
    Scene empty = blowing(Vec3(5, 0, 0), 0.1);
    empty.air_density = 0;
    for (const double f : solver::plan_of<double>(tree, empty).shelter) CHECK(f == 1);
    Scene open = blowing(Vec3(5, 0, 0), 1);
    open.wind->shelter.reset();
    CHECK(solver::plan_of<double>(tree, open).shelter.capacity() == 0);
    CHECK_FALSE(solver::plan_of<double>(tree, open).field);
}

TEST_CASE("what takes nearly all leaves the rest a calm, not a speed that is no number") {
    // A file of plates, each of which takes more than half of what a column has, and, unfolding, all of a slower wind.
    Tree plates = make_tree::chain(1, 1, 0.01, 0.01);
    for (int k = 0; k < 12; ++k)
        make_tree::add_leaf(plates, 0, Vec3(0.3 * k, 0, 0.5), make_tree::turn(-1.57, Vec3::UnitZ()), 0.4, 0.6, 3e-4, 0,
                            1, 0.5);
    for (const double cell : {0.24, 0.28, 0.31, 1.0})
        for (const double speed : {2.0, 25.0}) {
            const Plan<double> plan = solver::plan_of<double>(plates, blowing(Vec3(speed, 0, 0), cell));
            CAPTURE(cell, speed);
            for (const double f : plan.shelter) CHECK((f >= 0 && f <= 1));
        }
}
