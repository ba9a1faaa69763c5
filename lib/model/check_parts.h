// check_parts.h: the parts of a scene's checks (check_scene.cpp, check_walkers.cpp ...). `field` is the value's JSON pointer without its first slash.
#pragma once
#include "../base/shortest_text.h"
#include "scene.h"
#include <initializer_list>

namespace bough {

std::optional<Defect> finite(std::string_view field, const Vec3&);
// [m], [m/s], [m/s^2] Of places, sizes, velocities and gravity: meshes are written in floats, which a chain of bodies of this length still fits into.
constexpr double largest_length = 1e15;
std::optional<Defect> not_too_far(std::string_view field, const Vec3&);
std::optional<Defect> not_too_far(std::string_view field, double value);
std::optional<Defect> finite(std::string_view field, double);
std::optional<Defect> at_least(std::string_view field, double value, double low);
std::optional<Defect> above_zero(std::string_view field, double value);
// Of an enum that has `names`, counted from 0: a cast may have made it of any number.
std::optional<Defect> one_of(std::string_view field, std::size_t value, std::initializer_list<const char*> names);
// `trees`: how many trees the scene has; 0: the caller holds the one tree that the scene is for.
std::optional<Defect> check(const Selector&, const std::string& at, std::size_t trees);
std::optional<Defect> check(const Wind&);
std::optional<Defect> check(const Fracture&, std::size_t trees);
std::optional<Defect> check(const Ball&, const std::string& at);
std::optional<Defect> check(const Contact&);
std::optional<Defect> check(const Walker&, const std::string& at, std::size_t trees);
std::optional<Defect> check(const Wood&, std::size_t trees);
std::optional<Defect> check(const StaticLoad&);
std::optional<Defect> check(const Fictitious&);
std::optional<Defect> check_simulate(const Scene&); // with what it cannot stand beside

} // namespace bough
