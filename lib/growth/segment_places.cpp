#include "segment_places.h"
#include "turn.h"
#include <algorithm>

namespace bough {

namespace {

void arbaro_places(const GrowthParameters& p, const SegmentStem& stem, int segment, double density, double& dealt,
                   const LevelParameters& child, std::vector<double>& offsets) {
    const LevelParameters& l = p.level[std::size_t(stem.level)];
    const bool last = stem.level + 1 >= p.levels;
    const double step = stem.length / l.curve_res;
    double free = 0; // the part of the segment that bears nothing
    if (stem.level == 0) {
        const double bare = l.base_size * stem.length;
        free = std::clamp((bare - segment * step) / step, 0.0, 1.0);
        density *= 1 - free;
    } else if (segment == 0)
        free = std::min(1.0, stem.most_radius / step); // what lies within the parent
    dealt += density;
    const auto count = static_cast<int>(std::floor(dealt + 1e-9));
    dealt -= count;
    const double apart = (1 - free) / std::max(count, 1);
    const double spread = last ? apart : apart * (1 - child.branch_dist);
    for (int i = 0; i < count; ++i) {
        const double jitter = spread * (last ? 0.5 : 0.25) * random_sign(stem.key, Draw::place, offsets.size());
        offsets.push_back((segment + free + spread * (i + 0.5) + jitter) * step);
    }
}

void tree_gen_places(const GrowthParameters& p, const SegmentStem& stem, int segment, int count,
                     const LevelParameters& child, std::vector<Insertion>& result, double& turn) {
    const LevelParameters& l = p.level[std::size_t(stem.level)];
    const double step = stem.length / l.curve_res, bare = l.base_size * stem.length;
    const auto vary = [&] { return child.rotate_v * random_sign(stem.key, Draw::rotate, result.size()); };
    if (child.branch_dist <= 1) {
        for (int i = 0; i < count; ++i) {
            const double part = (i % 2 == 0 ? i : i - child.branch_dist) / count;
            const double offset = (segment + part) * step;
            if (offset <= bare) continue;
            const double now = child.rotate >= 0 ? turn + child.rotate + vary()
                                                 : (result.size() % 2 ? -1 : 1) * (180 + child.rotate + vary());
            turn = now;
            result.push_back({offset, now});
        }
        return;
    }
    const auto whorls = static_cast<int>(count / (child.branch_dist + 1));
    double left = 0;
    for (int w = 0; w < whorls; ++w) {
        const double offset = (segment + double(w) / whorls) * step;
        if (offset <= bare) continue;
        left += child.branch_dist + 1;
        const auto here = static_cast<int>(std::floor(left + 1e-9));
        left -= here;
        for (int i = 0; i < here; ++i) result.push_back({offset, turn + 360.0 * i / here + vary()});
        turn += child.rotate;
    }
}

} // namespace

double segment_children(const GrowthParameters& p, const SegmentStem& stem) {
    const double most = p.level[std::size_t(stem.level) + 1].branches;
    const double relative = stem.length / stem.parent_length / stem.parent_child_length;
    if (by_arbaro(p)) {
        if (stem.level == 0) return most / (1 - p.level[0].base_size);
        return std::floor(most * (stem.level == 1 ? 0.2 + 0.8 * relative : 1 - 0.5 * stem.place));
    }
    double number = most * (1 - 0.5 * stem.place);
    if (stem.level == 0) number = most * (0.9 + 0.2 * random_unit(stem.key, Draw::children, 1));
    if (stem.level == 1) number = most * (0.2 + 0.8 * relative);
    return number / (1 - p.level[std::size_t(stem.level)].base_size);
}

double segment_leaves(const GrowthParameters& p, const SegmentStem& stem) {
    if (stem.level == 0) return 0;
    if (by_arbaro(p)) return std::abs(p.leaves) * shape_ratio(p, p.leaf_distrib, stem.place);
    if (p.leaves < 0) return -p.leaves;
    return p.leaves * stem.scale / p.scale * stem.length / (stem.parent_child_length * stem.parent_length);
}

std::vector<Insertion> segment_places(const GrowthParameters& p, const SegmentStem& stem, const SegmentLine& line,
                                      const LevelParameters& child) {
    std::vector<Insertion> result;
    std::vector<double> offsets;
    const bool last = stem.level + 1 >= p.levels;
    double dealt = by_arbaro(p) ? random_unit(stem.key, Draw::children) : 0;
    double turn = by_arbaro(p) ? 0 : 360 * random_unit(stem.key, Draw::rotate, std::uint64_t(1) << 40);
    for (std::size_t i = 0; i < line.segment.size(); ++i) {
        const int segment = stem.first_segment + int(i);
        // Leaves are not shared out where stems split.
        const double density = last ? stem.density : line.density[i];
        if (by_arbaro(p)) {
            arbaro_places(p, stem, segment, density, dealt, child, offsets);
            continue;
        }
        dealt += density;
        const auto count = static_cast<int>(std::floor(dealt + 1e-9));
        dealt -= count;
        tree_gen_places(p, stem, segment, count, child, result, turn);
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const double vary = child.rotate_v * random_sign(stem.key, Draw::rotate, i);
        turn = child.rotate >= 0 ? turn + child.rotate + vary : (i % 2 ? -1 : 1) * (180 + child.rotate + vary);
        result.push_back({offsets[i], turn});
    }
    return result;
}

double segment_down_angle(const GrowthParameters& p, const SegmentStem& parent, const LevelParameters& l, double offset,
                          RandomKey key) {
    if (l.down_angle_v >= 0) return varied(l.down_angle, l.down_angle_v, key, Draw::down_angle);
    const bool bare = !by_arbaro(p) || parent.level == 0;
    const double length = parent.length * (1 - (bare ? p.level[std::size_t(parent.level)].base_size : 0));
    const double angle = l.down_angle + l.down_angle_v * (1 - 2 * shape_ratio(p, 0, (parent.length - offset) / length));
    return by_arbaro(p) ? angle : varied(angle, 0.1 * std::abs(angle), key, Draw::down_angle);
}

} // namespace bough
