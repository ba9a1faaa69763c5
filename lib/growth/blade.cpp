#include "blade.h"
#include "../base/angles.h"
#include <cmath>
#include <numbers>

namespace bough {
namespace {

constexpr double apart = 0.002; // [1] the faces, of the length: they do not flicker in programs that draw both

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// A simple polygon's triangles, counterclockwise, by cutting off ears; each a corner without others in it.
std::vector<std::array<std::int32_t, 3>> cut_ears(const std::vector<Vec2>& p) {
    std::vector<std::int32_t> left;
    for (std::size_t k = 0; k < p.size(); ++k) left.push_back(std::int32_t(k));
    const auto at = [&](std::int32_t k) -> const Vec2& { return p[std::size_t(k)]; };
    std::vector<std::array<std::int32_t, 3>> ears;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t best = n;
        double best_shape = -1;
        for (std::size_t k = 0; k < n; ++k) {
            const std::int32_t a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
            const double turn = cross(at(b) - at(a), at(c) - at(b));
            if (!(turn > 1e-12)) continue;
            bool empty = true;
            for (const std::int32_t other : left)
                if (other != a && other != b && other != c && cross(at(b) - at(a), at(other) - at(a)) >= 0 &&
                    cross(at(c) - at(b), at(other) - at(b)) >= 0 && cross(at(a) - at(c), at(other) - at(c)) >= 0)
                    empty = false;
            const double shape =
                turn / ((at(b) - at(a)).squaredNorm() + (at(c) - at(b)).squaredNorm() + (at(a) - at(c)).squaredNorm());
            if (empty && shape > best_shape) best = k, best_shape = shape;
        }
        if (best == n) best = 0; // what is left is a line
        const std::size_t n1 = left.size();
        ears.push_back({left[(best + n1 - 1) % n1], left[best], left[(best + 1) % n1]});
        left.erase(left.begin() + std::ptrdiff_t(best));
    }
    ears.push_back({left[0], left[1], left[2]});
    return ears;
}

// The right half with its midrib, and its triangles, counterclockwise.
struct HalfLeaf {
    std::vector<Vec2> point;
    std::vector<std::array<std::int32_t, 3>> triangle;
};

// Where the margin goes up all the way, triangles lie across between it and the midrib's places, so that a narrow blade may curl. Lobes that turn
// back are cut by ears.
HalfLeaf half_leaf(const std::vector<Vec2>& margin, const LeafForm& form) {
    constexpr double back = 0.02; // [1] what a tooth may
    const int ribs = form.needles > 1 ? 0 : 4;
    const std::size_t last = margin.size() - 1;
    HalfLeaf half{margin, {}};
    std::vector<double> highest(margin.size(), 0);
    bool rises = true;
    for (std::size_t k = 1; k <= last; ++k) {
        highest[k] = std::max(highest[k - 1], margin[k].y());
        rises &= margin[k].y() > highest[k - 1] - back;
    }
    const double from = form.petiole, to = margin[last - 1].y();
    for (int j = 1; j <= ribs; ++j) half.point.emplace_back(0, from + (to - from) * j / (ribs + 1));
    if (!rises) {
        std::vector<Vec2> around(margin);
        for (std::size_t k = half.point.size(); k-- > margin.size();) around.push_back(half.point[k]);
        half.point = around;
        half.triangle = cut_ears(around);
        return half;
    }
    auto rib = std::int32_t(0); // the midrib's place that is the next triangle's corner: the foot first
    auto next = std::int32_t(margin.size());
    for (std::size_t k = 0; k < last; ++k) {
        const auto corner = std::int32_t(k);
        while (next < std::int32_t(half.point.size()) && half.point[std::size_t(next)].y() <= highest[k]) {
            half.triangle.push_back({rib, corner, next});
            rib = next++;
        }
        if (rib != corner) half.triangle.push_back({rib, corner, corner + 1});
    }
    return half;
}

// The flat leaf's place (x across, y along) on the folded and curled one.
struct Bent {
    Vec3 position, normal;
};
Bent bent(const LeafForm& form, const Vec2& flat, double turned, double needle) {
    const double curl = form.curl * degree, fold = form.fold * degree;
    const Vec2 q(std::cos(needle) * flat.x() + std::sin(needle) * flat.y(),
                 std::cos(needle) * flat.y() - std::sin(needle) * flat.x());
    const double a = curl * q.y(), side = turned;
    const Vec3 along(0, -std::sin(a), std::cos(a)), up(0, std::cos(a), std::sin(a));
    const double z = std::abs(curl) > 1e-6 ? std::sin(a) / curl : q.y();
    const double y = std::abs(curl) > 1e-6 ? (std::cos(a) - 1) / curl : 0;
    const Vec3 place = Vec3(0, y, z) + q.x() * std::cos(fold) * Vec3::UnitX() + std::abs(q.x()) * std::sin(fold) * up;
    const Vec3 normal = std::cos(fold) * up - side * std::sin(fold) * Vec3::UnitX();
    return {place, normal.normalized()};
}

// Of a square of the picture: which, and where in it.
std::array<float, 2> in_picture(const Vec2& flat, double wide, bool lower, bool spray) {
    const double u = 0.5 + picture_share * flat.x() / wide, v = (1 + picture_share) / 2 - picture_share * flat.y();
    return {float((u + lower) / 2), float((v + spray) / 2)};
}

void add_face(Blade& blade, const LeafForm& form, const std::vector<Vec2>& flat,
              const std::vector<std::array<std::int32_t, 3>>& triangles, double wide, double side, double needle,
              bool lower) {
    const auto first = std::int32_t(blade.position.size());
    for (const Vec2& p : flat) {
        const Bent b = bent(form, p, p.x() == 0 ? 0 : side, needle);
        const double sign = lower ? -1 : 1;
        blade.position.push_back(b.position + sign * apart / 2 * b.normal);
        blade.normal.push_back(sign * b.normal);
        blade.uv.push_back(in_picture(p, wide, lower, false));
    }
    for (const auto& [a, b, c] : triangles)
        blade.triangle.push_back(lower ? std::array<std::int32_t, 3>{first + a, first + b, first + c}
                                       : std::array<std::int32_t, 3>{first + a, first + c, first + b});
}

void add_rectangle(Blade& blade, double half, double from, double to, bool lower, bool spray, const LeafForm* form) {
    const auto first = std::int32_t(blade.position.size());
    for (const double y : {from, to})
        for (const double x : {-half, half}) {
            Bent at{Vec3(x, 0, y), Vec3::UnitY()};
            if (form) {
                LeafForm flat = *form; // a rectangle is as curled as it can be
                flat.fold = 0;
                flat.curl /= 2;
                at = bent(flat, Vec2(x, y), 0, 0);
            }
            const double sign = lower ? -1 : 1;
            blade.position.push_back(at.position + sign * apart / 2 * at.normal);
            blade.normal.push_back(sign * at.normal);
            blade.uv.push_back(in_picture(Vec2(x, y), spray ? 1 : 2 * half, lower, spray));
        }
    for (const auto& [a, b, c] : {std::array{0, 2, 1}, std::array{1, 2, 3}})
        blade.triangle.push_back(lower ? std::array<std::int32_t, 3>{first + a, first + c, first + b}
                                       : std::array<std::int32_t, 3>{first + a, first + b, first + c});
}

double area_of(const LeafForm& form, double width) {
    return leaf_area_of(leaf_half(form, width, 4)) * form.needles;
}

} // namespace

Blade blade_mesh(const LeafForm& form, double width) {
    const std::vector<Vec2> half = leaf_half(form, width, form.needles > 1 ? 0 : 1);
    const HalfLeaf right = half_leaf(half, form);
    std::vector<Vec2> left(right.point);
    for (Vec2& p : left) p.x() = -p.x();
    std::vector<std::array<std::int32_t, 3>> mirrored;
    for (const auto& [a, b, c] : right.triangle) mirrored.push_back({a, c, b});
    const double wide = picture_width(form, width);
    Blade blade;
    for (const double needle : needle_angles(form))
        for (const bool lower : {false, true}) {
            add_face(blade, form, right.point, right.triangle, wide, 1, needle, lower);
            add_face(blade, form, left, mirrored, wide, -1, needle, lower);
        }
    blade.area = leaf_area_of(half) * form.needles;
    return blade;
}

double picture_width(const LeafForm& form, double width) {
    double half = 0;
    for (const Vec2& p : leaf_half(form, width, 4)) half = std::max(half, p.x());
    return 2.1 * (half + std::sin(form.needles > 1 ? form.spread / 2 * std::numbers::pi / 180 : 0));
}

Blade blade_card(const LeafForm& form, double width) {
    Blade blade;
    for (const bool lower : {false, true})
        add_rectangle(blade, picture_width(form, width) / 2, 0, 1, lower, false, &form);
    blade.area = area_of(form, width);
    return blade;
}

Blade spray_card(const LeafForm& form, double width, bool mirrored) {
    Blade blade;
    add_rectangle(blade, 0.5, 0, 1, false, true, nullptr);
    for (auto& [u, v] : blade.uv) u += mirrored ? 0.5f : 0;
    for (const SprayLeaf& leaf : spray_leaves()) blade.area += leaf.length * leaf.length * area_of(form, width);
    return blade;
}

} // namespace bough
