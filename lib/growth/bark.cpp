#include "bark.h"

namespace bough {

namespace {

// Where fraction `at` of a branch's arc length lies: between point `index` and the next, `share` of the way.
struct Place {
    std::size_t index;
    double share;
};

Place find_place(const Splines& splines, std::int32_t branch, double at) {
    const auto first = static_cast<std::size_t>(splines.first_point[std::size_t(branch)]);
    const auto end = static_cast<std::size_t>(splines.first_point[std::size_t(branch) + 1]);
    double total = 0;
    for (std::size_t i = first; i + 1 < end; ++i) total += (splines.point[i + 1] - splines.point[i]).norm();
    double left = at * total;
    for (std::size_t i = first; i + 1 < end; ++i) {
        const double step = (splines.point[i + 1] - splines.point[i]).norm();
        if (left < step) return {i, left / step};
        left -= step;
    }
    return {end - 2, 1};
}

template <class T> T between(const std::vector<T>& values, const Place& place) {
    return values[place.index] + place.share * (values[place.index + 1] - values[place.index]);
}

// How far an item at `position` moves so that it stands off the branch's axis as before, but from the grown radius.
Vec3 outward(const Splines& s, const std::vector<double>& drawn, std::int32_t branch, double at, const Vec3& position) {
    const Place place = find_place(s, branch, at);
    const double growth = between(s.radius, place) - between(drawn, place);
    const Vec3 off = position - between(s.point, place);
    const double distance = off.norm();
    return growth > 0 && distance > 0 ? Vec3(growth / distance * off) : Vec3(Vec3::Zero());
}

} // namespace

double radius_at(const Splines& splines, std::int32_t branch, double at) {
    return between(splines.radius, find_place(splines, branch, at));
}

void seat_on_bark(Splines& s, const std::vector<double>& drawn) {
    for (std::size_t i = 0; i < s.leaves(); ++i)
        s.leaf_position[i] += outward(s, drawn, s.leaf_branch[i], s.leaf_at[i], s.leaf_position[i]);
    for (std::size_t i = 0; i < s.fruits(); ++i) {
        const Vec3 moved = outward(s, drawn, s.fruit_branch[i], s.fruit_at[i], s.fruit_position[i]);
        s.fruit_position[i] += moved;
        s.fruit_center[i] += moved;
    }
}

} // namespace bough
