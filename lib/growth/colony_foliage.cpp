#include "../model/polyline.h"
#include "colony.h"
#include "leaf_count.h"
#include "turn.h"
#include "weber_penn.h"
#include <algorithm>
#include <numbers>

namespace bough {
namespace {

enum class FoliageDraw : std::uint8_t { foliage, leaves, fruits, start, lean, turn, place };

constexpr double kGolden = 137.5 * degree; // from one leaf to the next
constexpr double kTurnV = 20 * degree, kLeanV = 10 * degree;

struct OnTwig {
    Vec3 point, along;
    double radius, at;
};

// The last stretch of a branch.
class Twig {
public:
    Twig(const Splines& s, std::size_t b, double leafy)
        : s_(s), first_(static_cast<std::size_t>(s.first_point[b])), arc_(arc_lengths(points_of(s, b))) {
        from_ = std::max(0.0, arc_.back() - leafy);
    }
    OnTwig at(double share) const {
        const double arc = from_ + share * (arc_.back() - from_);
        const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc);
        const auto k = static_cast<std::size_t>(above - arc_.begin()) - 1;
        const double step = arc_[k + 1] - arc_[k], t = step > 0 ? (arc - arc_[k]) / step : 0;
        const Vec3 &a = s_.point[first_ + k], &b = s_.point[first_ + k + 1];
        return {a + t * (b - a), step > 0 ? Vec3((b - a) / step) : Vec3(Vec3::UnitY()),
                s_.radius[first_ + k] + t * (s_.radius[first_ + k + 1] - s_.radius[first_ + k]),
                std::clamp(arc / arc_.back(), 0.0, 1.0)};
    }

private:
    const Splines& s_;
    std::size_t first_;
    std::vector<double> arc_;
    double from_;
};

Vec3 across(const Vec3& along) {
    return (std::abs(along.y()) < 0.9 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX())).cross(along).normalized();
}

void add_leaf(const ColonizeParameters& p, std::size_t branch, const OnTwig& on, double turn, double lean, Splines& s) {
    const Vec3 side = Eigen::AngleAxisd(turn, on.along) * across(on.along);
    const Vec3 z = std::cos(lean) * on.along + std::sin(lean) * side;
    // The normal faces up as far as the leaf's length lets it.
    const Vec3 up = std::abs(z.y()) < 0.999 ? Vec3(Vec3::UnitY()) : on.along;
    Mat3 axes;
    axes.col(2) = z;
    axes.col(0) = up.cross(z).norm() > 1e-9 ? Vec3(up.cross(z).normalized()) : across(z);
    axes.col(1) = z.cross(axes.col(0));
    s.leaf_branch.push_back(static_cast<std::int32_t>(branch));
    s.leaf_at.push_back(on.at);
    s.leaf_position.push_back(on.point + on.radius * side);
    s.leaf_rotation.push_back(Quat(axes).normalized());
    s.leaf_length.push_back(p.leaf_length);
    s.leaf_width.push_back(p.leaf_width);
}

void add_fruit(const ColonizeParameters& p, std::size_t branch, const OnTwig& on, Splines& s) {
    const Vec3 down = on.along * on.along.y() - Vec3::UnitY();
    const Vec3 side = down.norm() > 1e-9 ? Vec3(down.normalized()) : across(on.along);
    const Vec3 joint = on.point + on.radius * side;
    s.fruit_branch.push_back(static_cast<std::int32_t>(branch));
    s.fruit_at.push_back(on.at);
    s.fruit_position.push_back(joint);
    s.fruit_center.push_back(joint - Vec3(0, 2 * p.fruit_radius, 0));
    s.fruit_radius.push_back(p.fruit_radius);
}

} // namespace

void add_colony_foliage(const ColonizeParameters& p, std::uint64_t seed, bool with_leaves, bool with_fruit,
                        Splines& s) {
    if (!with_leaves && !with_fruit) return;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        const RandomKey key = random_key(random_key(RandomKey{0}, FoliageDraw::foliage, seed), FoliageDraw::foliage, b);
        const Twig twig(s, b, p.leafy);
        const auto leaves = with_leaves ? whole_number(p.leaves, random_unit(key, FoliageDraw::leaves)) : 0;
        const double start = 2 * std::numbers::pi * random_unit(key, FoliageDraw::start);
        for (std::int64_t i = 0; i < leaves; ++i) {
            const auto k = static_cast<std::uint64_t>(i);
            const double turn =
                start + kGolden * static_cast<double>(i) + kTurnV * random_sign(key, FoliageDraw::turn, k);
            const double lean = p.leaf_angle * degree + kLeanV * random_sign(key, FoliageDraw::lean, k);
            add_leaf(p, b, twig.at((static_cast<double>(i) + 0.5) / static_cast<double>(leaves)), turn, lean, s);
        }
        const auto fruits = with_fruit ? whole_number(p.fruits, random_unit(key, FoliageDraw::fruits)) : 0;
        for (std::int64_t i = 0; i < fruits; ++i)
            add_fruit(p, b, twig.at(random_unit(key, FoliageDraw::place, static_cast<std::uint64_t>(i))), s);
    }
    say_leaf_count(s);
}

} // namespace bough
