// c_support.h: what tests of bough_c.h begin with: a birch of 300 bodies, a run of it.
#pragma once
#include "formats/c/bough_c.h"
#include <catch2/catch.hpp>
#include <string>

namespace bough::test {

#define OK(call)                                                                                                       \
    do {                                                                                                               \
        const bough_result result_ = (call);                                                                           \
        INFO(bough_error());                                                                                           \
        REQUIRE(result_ == BOUGH_OK);                                                                                  \
    } while (false)

inline bough_tree* birch(bool leaves = true) {
    bough_growth growth = bough_default_growth();
    growth.species = "birch";
    growth.bodies = 300;
    growth.seed = 2;
    growth.age = 8;
    growth.leaves = leaves;
    bough_splines* splines = nullptr;
    bough_tree* tree = nullptr;
    OK(bough_grow(&growth, &splines));
    OK(bough_convert(splines, nullptr, &tree));
    OK(bough_free(splines));
    return tree;
}

inline bough_scene* scene_of(const std::string& document) {
    bough_scene* scene = nullptr;
    OK(bough_read_scene(document.empty() ? nullptr : document.data(), document.size(), "here.json", &scene));
    return scene;
}

inline bough_simulation* simulation_of(bough_scene* scene, const bough_settings* settings = nullptr,
                                       const bough_simulation* before = nullptr) {
    bough_simulation* simulation = nullptr;
    OK(bough_simulate(scene, settings, before, &simulation));
    return simulation;
}

inline bough_simulation* in_wind(const char* wind, const bough_settings& settings) {
    bough_tree* tree = birch();
    bough_scene* scene = scene_of("");
    OK(bough_scene_add(scene, tree, nullptr, 0));
    bough_wind blows;
    OK(bough_wind_preset(wind, &blows));
    OK(bough_scene_set_wind(scene, &blows));
    bough_simulation* simulation = simulation_of(scene, &settings);
    OK(bough_free(tree));
    OK(bough_free(scene)); // the run keeps what it needs
    return simulation;
}

inline std::uint64_t hash(bough_simulation* simulation) {
    std::uint64_t value = 0;
    OK(bough_hash(simulation, &value));
    return value;
}

inline void steps(bough_simulation* simulation, int n) {
    for (int k = 0; k < n; ++k) OK(bough_step(simulation, nullptr));
}

inline bough_array array(bough_simulation* simulation, bough_field field) {
    bough_array a{};
    OK(bough_read(simulation, field, &a));
    return a;
}

inline std::string saved(const bough_simulation* simulation) {
    std::size_t size = 0, again = 0;
    OK(bough_save(simulation, nullptr, 0, &size));
    std::string bytes(size, 0);
    OK(bough_save(simulation, bytes.data(), bytes.size(), &again));
    REQUIRE(again == size);
    return bytes;
}

} // namespace bough::test
