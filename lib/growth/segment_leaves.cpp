#include "segment_places.h"
#include "turn.h"
#include <numbers>

namespace bough {

namespace {

LevelParameters leaf_level(const GrowthParameters& p) {
    LevelParameters l = p.level[std::size_t(std::min(p.levels, 3))];
    if (!p.leaf_angles.empty())
        l.down_angle = p.leaf_angles[0], l.down_angle_v = p.leaf_angles[1], l.rotate = p.leaf_angles[2],
        l.rotate_v = p.leaf_angles[3];
    return l;
}

// A leaf, or with tree-gen a flower in its place.
void one_leaf(const GrowthParameters& p, const SegmentStem& stem, const GrownStem& grown, double offset,
              const Quat& turned, RandomKey key, const Items& items, Splines& out) {
    const double grown_up = by_arbaro(p) ? 1 : stem.scale / p.scale;
    if (p.blossom_rate > 0 && random_unit(key, Draw::blossom) < p.blossom_rate) {
        if (!items.petals) return;
        add_flower(p, grown.branch, grown.fraction(offset), grown.point_at(offset), turned * Vec3::UnitZ(), grown_up,
                   out);
        return;
    }
    if (!items.leaves) return;
    const double length = varied(p.leaf_scale, p.leaf_scale_v, key, Draw::leaf_scale) * grown_up;
    add_leaf(p, grown, offset, turned, length, out);
}

// Leaves at the stem's tip, rotate [deg] between the outermost.
void fan(const GrowthParameters& p, const SegmentStem& stem, const GrownStem& grown, const LevelParameters& l,
         Splines& out) {
    const auto count = static_cast<int>(segment_leaves(p, stem) + 0.5);
    const Quat tip = grown.segment_at(stem.length).frame;
    for (int i = 0; i < count; ++i) {
        const RandomKey key = random_key(stem.key, Draw::leaf, std::uint64_t(i));
        const double part = by_arbaro(p) ? (i + 0.5) / count : count > 1 ? double(i) / (count - 1) : 0.5;
        const double v = l.rotate_v / (by_arbaro(p) ? count : 1);
        const double spread = l.rotate * (part - 0.5) + v * random_sign(key, Draw::rotate);
        const double down = varied(l.down_angle, std::abs(l.down_angle_v), key, Draw::down_angle);
        one_leaf(p, stem, grown, stem.length,
                 tip * about(Vec3::UnitY(), spread * degree) * about(Vec3::UnitX(), down * degree), key,
                 {true, false, false}, out);
    }
}

} // namespace

void grow_segment_leaves(const GrowthParameters& p, const SegmentStem& stem, const GrownStem& grown,
                         const SegmentLine& line, const Items& items, Splines& out) {
    const LevelParameters l = leaf_level(p);
    if (p.leaves < 0) {
        if (items.leaves) fan(p, stem, grown, l, out);
        return;
    }
    const std::vector<Insertion> all = segment_places(p, stem, line, l);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const RandomKey key = random_key(stem.key, Draw::leaf, i);
        const Quat turned = grown.segment_at(all[i].offset).frame * about(Vec3::UnitZ(), all[i].turn * degree) *
                            about(Vec3::UnitX(), segment_down_angle(p, stem, l, all[i].offset, key) * degree);
        one_leaf(p, stem, grown, all[i].offset, turned, key, items, out);
    }
}

} // namespace bough
