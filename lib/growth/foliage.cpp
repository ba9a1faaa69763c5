#include "stem.h"
#include <algorithm>
#include <numbers>

namespace bough {

namespace {

// The paper's light bend: the normal turns toward the outside of the tree, then up, by `bend` of the way each.
Quat bent(Quat leaf, const Vec3& position, double bend) {
    Vec3 normal = leaf * Vec3::UnitY();
    double turn = std::atan2(position.x(), position.z()) - std::atan2(normal.x(), normal.z());
    turn = std::remainder(turn, 2 * std::numbers::pi);
    leaf = about(Vec3::UnitY(), bend * turn) * leaf;
    normal = leaf * Vec3::UnitY();
    const Vec3 level = normal.cross(Vec3::UnitY());
    const double length = level.norm();
    if (length < 1e-9) return leaf;
    return about(level / length, bend * std::atan2(length, normal.y())) * leaf;
}

// Half a turn about the leaf's length where its normal faces down.
Quat upright(const Quat& leaf) {
    return (leaf * Vec3::UnitY()).y() < 0 ? Quat(leaf * about(Vec3::UnitZ(), std::numbers::pi)) : leaf;
}

void add_flat(Splines& out, std::int32_t branch, double at, const Vec3& position, const Quat& rotation, double length,
              double width, int kind) {
    out.leaf_branch.push_back(branch);
    out.leaf_at.push_back(at);
    out.leaf_position.push_back(position);
    out.leaf_rotation.push_back(rotation.normalized());
    out.leaf_length.push_back(length);
    out.leaf_width.push_back(width);
    out.leaf_kind.push_back(kind);
}

// Number on this stem of things of which there are at most `most`, by the stem's place on its parent.
int number_on(const GrowthParameters& p, const Stem& stem, double most, Draw draw) {
    const double share = p.leaf_distrib == 8 ? envelope_ratio(p, stem.place) : shape_ratio(p.leaf_distrib, stem.place);
    const double number = stem.level == 0 ? most : most * share;
    return static_cast<int>(whole_number(number, random_unit(stem.key, draw)));
}

} // namespace

void add_leaf(const GrowthParameters& p, const GrownStem& grown, double offset, const Quat& turned, double length,
              Splines& out) {
    const double at = grown.fraction(offset);
    const Vec3 axis = grown.segment_at(offset).frame * Vec3::UnitZ();
    const Vec3 outward = turned * Vec3::UnitZ();
    const Vec3 aside = outward - axis * axis.dot(outward);
    Vec3 position = grown.point_at(offset);
    if (aside.norm() > 1e-9) position += radius_at(out, grown.branch, at) * aside.normalized();
    position += p.leaf_stem * length * outward;
    const Quat leaf = p.leaf_bend > 0 ? bent(upright(turned), position, p.leaf_bend) : turned;
    add_flat(out, grown.branch, at, position, upright(leaf), length, length * p.leaf_scale_x, 0);
}

void add_flower(const GrowthParameters& p, std::int32_t branch, double at, const Vec3& center, const Vec3& axis,
                double size, Splines& out) {
    constexpr double lean = 35 * degree; // of a petal off the flower's plane
    // The flower's axis is z of its frame; x of a petal is its width, so that it leans about x.
    const Quat flower = shortest_turn(Vec3::UnitZ(), axis);
    for (int k = 0; k < p.petals; ++k) {
        const Quat petal = flower * about(Vec3::UnitZ(), 2 * std::numbers::pi * k / p.petals) *
                           about(Vec3::UnitX(), std::numbers::pi / 2 - lean);
        add_flat(out, branch, at, center, petal, size * p.petal_scale, size * p.petal_scale * p.petal_scale_x, 1);
    }
}

const Segment& GrownStem::segment_at(double offset) const {
    const double number = std::floor(offset / stem.length * curve_res) - stem.first_segment;
    return segment[static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(segment.size() - 1)))];
}

Vec3 GrownStem::point_at(double offset) const {
    const Segment& s = segment_at(offset);
    const double from = stem.length / curve_res * (static_cast<double>(&s - segment.data()) + stem.first_segment);
    return s.position + s.frame * Vec3(0, 0, offset - from);
}

void grow_leaves(const GrowthParameters& p, const GrownStem& grown, Splines& out) {
    const Stem& stem = grown.stem;
    LevelParameters l = p.level[std::min(p.levels, 3)];
    if (!p.leaf_angles.empty())
        l.down_angle = p.leaf_angles[0], l.down_angle_v = p.leaf_angles[1], l.rotate = p.leaf_angles[2],
        l.rotate_v = p.leaf_angles[3];
    const bool fan = p.leaves < 0;
    const int count = number_on(p, stem, std::abs(p.leaves), Draw::leaves);
    double turn = 0;
    for (int i = 0; i < count; ++i) {
        const RandomKey key = random_key(stem.key, Draw::leaf, static_cast<std::uint64_t>(i));
        const double varies = l.rotate_v * random_sign(key, Draw::rotate);
        const double down = l.down_angle + std::abs(l.down_angle_v) * random_sign(key, Draw::down_angle);
        const double offset = fan ? stem.length : stem.length * (i + 0.5) / count;
        if (offset < grown.start()) continue;
        const double length = p.leaf_scale + p.leaf_scale_v * random_sign(key, Draw::leaf_scale);
        const Quat frame = grown.segment_at(offset).frame;
        if (fan) {
            // Spread about the stem's y, in its x-z plane, after which the whole fan leans by the down angle.
            const double spread = std::abs(l.rotate) * ((i + 0.5) / count - 0.5) + varies;
            add_leaf(p, grown, offset,
                     frame * about(Vec3::UnitX(), down * degree) * about(Vec3::UnitY(), spread * degree), length, out);
            continue;
        }
        turn = l.rotate >= 0 ? turn + l.rotate + varies : (i % 2 ? -1 : 1) * (180 + l.rotate + varies);
        add_leaf(p, grown, offset, frame * about(Vec3::UnitZ(), turn * degree) * about(Vec3::UnitX(), down * degree),
                 length, out);
    }
}

void grow_blossoms(const GrowthParameters& p, const GrownStem& grown, Splines& out) {
    const Stem& stem = grown.stem;
    const int count = number_on(p, stem, p.blossoms, Draw::blossoms);
    for (int i = 0; i < count; ++i) {
        const RandomKey key = random_key(stem.key, Draw::blossom, static_cast<std::uint64_t>(i));
        const double offset = stem.length * (i + random_unit(key, Draw::blossom)) / count;
        if (offset < grown.start()) continue;
        const double at = grown.fraction(offset);
        const Quat frame = grown.segment_at(offset).frame;
        const double round = 2 * std::numbers::pi * random_unit(key, Draw::rotate);
        const Vec3 away = frame * Vec3(std::cos(round), std::sin(round), 0);
        const Vec3 center = grown.point_at(offset) + (radius_at(out, grown.branch, at) + 0.5 * p.petal_scale) * away;
        const Vec3 axis = (away + Vec3::UnitY()).norm() > 1e-6 ? Vec3((away + Vec3::UnitY()).normalized()) : away;
        add_flower(p, grown.branch, at, center, axis, 1, out);
    }
}

void grow_fruits(const GrowthParameters& p, const GrownStem& grown, Splines& out) {
    const Stem& stem = grown.stem;
    const int count = number_on(p, stem, p.fruits, Draw::fruits);
    for (int i = 0; i < count; ++i) {
        const double place =
            (i + random_unit(random_key(stem.key, Draw::fruit, static_cast<std::uint64_t>(i)), Draw::fruit)) / count;
        const double offset = stem.length * place;
        if (offset < grown.start()) continue;
        const double at = grown.fraction(offset);
        const Vec3 axis = grown.segment_at(offset).frame * Vec3::UnitZ();
        Vec3 below = axis * axis.y() - Vec3::UnitY();
        // A vertical stem has no lower side.
        if (below.norm() < 1e-9) below = grown.segment_at(offset).frame * Vec3::UnitX();
        const Vec3 joint = grown.point_at(offset) + radius_at(out, grown.branch, at) * below.normalized();
        out.fruit_branch.push_back(grown.branch);
        out.fruit_at.push_back(at);
        out.fruit_position.push_back(joint);
        out.fruit_center.push_back(joint - Vec3(0, (1 + p.fruit_stalk) * p.fruit_radius, 0));
        out.fruit_radius.push_back(p.fruit_radius);
    }
}

} // namespace bough
