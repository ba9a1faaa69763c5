// simulations.h: what tests of the door share.
#pragma once
#include "formats/files.h"
#include <catch2/catch.hpp>

namespace simulations {

using namespace bough;

// A young birch in leaf: a mature one takes a sanitized build ten seconds.
inline Tree leafy() {
    return convert(grow("birch", {.bodies = 300, .seed = 2, .age = 8, .leaves = true}));
}

inline Scene one(const Tree& tree, const char* wind = nullptr) {
    Scene scene;
    scene.add(tree);
    if (wind) scene.wind = wind_preset(wind);
    return scene;
}

inline std::uint64_t run(Simulation& simulation, int steps) {
    for (int k = 0; k < steps; ++k) REQUIRE(simulation.step().finite());
    return simulation.hash();
}

// Why it cannot be run; empty: it can.
inline std::string refusal(Scene scene, const SimulationOptions& o = {}) {
    try {
        const Simulation simulation(std::move(scene), o);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

// The largest distance.
inline double apart(std::span<const Vec3> a, std::span<const Vec3> b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

} // namespace simulations
