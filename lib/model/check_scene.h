// check_scene.h: the parts that the checks of a scene are made of (check(Scene), scene.h). field: where, as a JSON pointer without its first slash.
#pragma once
#include "scene.h"

namespace bough::scene_check {

std::string text(double value); // shortest that reads back

std::optional<Defect> finite(const std::string& field, const Vec3& value);
std::optional<Defect> at_least(const std::string& field, double value, double low);
std::optional<Defect> above_zero(const std::string& field, double value);

// `trees` of 0: the caller has the one tree that the scene is for.
std::optional<Defect> check(const Selector&, const std::string& at, std::size_t trees);

// ---- check_simulate.cpp ----
std::optional<Defect> check_simulate(const Scene&); // with what it cannot stand beside

} // namespace bough::scene_check
