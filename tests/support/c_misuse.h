// c_misuse.h: what tests that call bough_c.h wrongly share.
#pragma once
#include "formats/c/bough_c.h"
#include <catch2/catch.hpp>
#include <string>

namespace bough::test {

inline void refused(bough_result result, bough_result wanted, const std::string& text) {
    INFO(bough_error());
    CHECK(result == wanted);
    CHECK(std::string(bough_error()).find(text) != std::string::npos);
    CHECK(std::string(bough_error()).find('\n') == std::string::npos);
}

// One of each kind, and all that a handle must not be.
struct Handles {
    bough_splines *splines = nullptr, *freed_splines = nullptr;
    bough_tree *tree = nullptr, *freed_tree = nullptr;
    bough_scene *scene = nullptr, *freed_scene = nullptr;
    bough_simulation *simulation = nullptr, *freed_simulation = nullptr;

    Handles() {
        const auto one = [](auto& s, auto& t, auto& c, auto& m) {
            bough_growth growth = bough_default_growth();
            growth.species = "palm";
            growth.bodies = 60;
            REQUIRE(bough_grow(&growth, &s) == BOUGH_OK);
            REQUIRE(bough_convert(s, nullptr, &t) == BOUGH_OK);
            REQUIRE(bough_read_scene(nullptr, 0, nullptr, &c) == BOUGH_OK);
            REQUIRE(bough_scene_add(c, t, nullptr, 0) == BOUGH_OK);
            bough_settings settings = bough_default_settings();
            settings.pulls = settings.grounds = 1;
            REQUIRE(bough_simulate(c, &settings, nullptr, &m) == BOUGH_OK);
        };
        one(splines, tree, scene, simulation);
        one(freed_splines, freed_tree, freed_scene, freed_simulation);
        for (void* handle : {(void*)freed_splines, (void*)freed_tree, (void*)freed_scene, (void*)freed_simulation})
            REQUIRE(bough_free(handle) == BOUGH_OK);
    }
    ~Handles() {
        for (void* handle : {(void*)splines, (void*)tree, (void*)scene, (void*)simulation}) bough_free(handle);
    }
};

} // namespace bough::test
