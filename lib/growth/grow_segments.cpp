// Arbaro's and tree-gen's growth (rules.h). References: StemImpl.java and LeafImpl.java of Arbaro 1.9.9,
// parametric/gen.py of tree-gen: the rules are theirs, the code is not.
#include "segment_places.h"
#include "turn.h"
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace bough {

namespace {

constexpr double kThinnestParent = 1e-4; // [m] tree-gen makes no stems where their parent is thinner,
constexpr double kThinnestBase = 0.005;  // [m] nor any that are thinner than this at their base

// Trunks' places within a circle about the origin, in square cells as wide as trunks stand apart, or wider.
class TrunkPlaces {
public:
    TrunkPlaces(double radius, double apart, int count) : radius_(radius), apart_(apart) {
        // A little wider, so that rounding leaves what is nearer than `apart` in neighbouring cells.
        across_ = static_cast<int>(std::max(1.0, std::min(std::ceil(std::sqrt(count)), 2 * radius / (1.001 * apart))));
        cell_.resize(std::size_t(across_) * std::size_t(across_));
    }
    bool free(const Vec3& place) const {
        const int i = number(place.x()), k = number(place.z());
        for (int z = std::max(k - 1, 0); z <= std::min(k + 1, across_ - 1); ++z)
            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, across_ - 1); ++x)
                for (const Vec3& other : cell_[index(x, z)])
                    if ((other - place).norm() < apart_) return false;
        return true;
    }
    void add(const Vec3& place) { cell_[index(number(place.x()), number(place.z()))].push_back(place); }

private:
    int number(double at) const {
        return static_cast<int>(std::max(0.0, std::min(across_ - 1.0, (at + radius_) / (2 * radius_) * across_)));
    }
    std::size_t index(int x, int z) const { return std::size_t(z) * std::size_t(across_) + std::size_t(x); }

    double radius_, apart_;
    int across_;
    std::vector<std::vector<Vec3>> cell_;
};

class SegmentGrower {
public:
    SegmentGrower(const GrowthParameters& p, Splines& out)
        : p_(p), out_(out), arbaro_(p.rules == GrowthRules::arbaro) {}
    void run(std::uint64_t seed, const Items&);

private:
    void plant(std::uint64_t seed);
    SegmentStem trunk_of(RandomKey key, double scale) const;
    bool prune(SegmentStem&) const;
    bool fits(const SegmentStem&) const;
    bool inside(const SegmentStem&, const Vec3& at) const;
    void set_radius(SegmentStem&) const;
    void set_density(SegmentStem&, bool leaves) const;
    void draw(const SegmentStem&, const SegmentLine&);
    void bear(const SegmentStem&, const GrownStem&, const SegmentLine&);
    SegmentStem child_of(const SegmentStem&, const GrownStem&, std::size_t index, const Insertion&) const;

    const GrowthParameters& p_;
    Splines& out_;
    bool arbaro_;
    std::vector<SegmentStem> stack_, born_;
};

SegmentStem SegmentGrower::trunk_of(RandomKey key, double scale) const {
    const LevelParameters& l = p_.level[0];
    SegmentStem trunk;
    trunk.key = key;
    trunk.scale = scale;
    trunk.length = scale * varied(l.length, l.length_v, key, Draw::length);
    trunk.radius =
        trunk.length * p_.ratio * l.radius_mod * varied(p_.radius_scale, p_.radius_scale_v, key, Draw::radius_scale);
    return trunk;
}

void SegmentGrower::plant(std::uint64_t seed) {
    const LevelParameters& l = p_.level[0];
    const RandomKey first = random_key(RandomKey{0}, Draw::trunk, seed);
    const double scale = varied(p_.scale, p_.scale_v, first, Draw::scale);
    const auto count = static_cast<int>(std::max(1.0, l.branches));
    // Apart from each other by what a trunk of the tallest tree would need, where a thousand tries find room.
    const double apart = 2.5 * (p_.scale + p_.scale_v) * l.length * p_.ratio * l.radius_mod;
    TrunkPlaces placed(std::sqrt(count / 2.5 * p_.scale * p_.ratio), apart, count);
    double turned = 0;
    for (int i = 0; i < count; ++i) {
        const RandomKey key = i == 0 ? first : random_key(first, Draw::trunk, std::uint64_t(i));
        SegmentStem trunk = trunk_of(key, arbaro_ || i == 0 ? scale : varied(p_.scale, p_.scale_v, key, Draw::scale));
        double round = 2 * std::numbers::pi * random_unit(key, Draw::trunk_place);
        double roll = round - std::numbers::pi / 2, lean = 0;
        Vec3 place = Vec3::Zero();
        if (arbaro_) {
            const double vary = varied(l.rotate, l.rotate_v, key, Draw::rotate);
            turned = l.rotate >= 0 ? turned + vary : (i % 2 ? 1 : -1) * (180 + vary);
            roll = turned * degree;
            lean = varied(l.down_angle, l.down_angle_v, key, Draw::down_angle) * degree;
            const double far = p_.trunk_spread * random_sign(key, Draw::trunk_place, 1);
            place = far * Vec3(std::sin(round), 0, std::cos(round));
        } else if (count > 1) {
            for (std::uint64_t k = 0; k < 1000; ++k) {
                round = 2 * std::numbers::pi * random_unit(key, Draw::trunk_place, 2 * k);
                const double u = random_unit(key, Draw::trunk_place, 2 * k + 1);
                place = std::sqrt(u * count / 2.5 * p_.scale * p_.ratio) * Vec3(std::cos(round), 0, -std::sin(round));
                if (placed.free(place)) break;
            }
            placed.add(place);
            roll = round - std::numbers::pi / 2;
        }
        trunk.position = place;
        trunk.frame = about_x(-std::numbers::pi / 2) * about_z(roll) * about_x(lean);
        stack_.push_back(trunk);
    }
    std::reverse(stack_.begin(), stack_.end());
}

void SegmentGrower::run(std::uint64_t seed, const Items& items) {
    plant(seed);
    out_.first_point.push_back(0);
    while (!stack_.empty()) {
        SegmentStem stem = stack_.back();
        stack_.pop_back();
        const bool last = stem.level + 1 >= p_.levels;
        if (!stem.clone) {
            if (!prune(stem)) continue;
            const LevelParameters& child = p_.level[std::size_t(std::min(stem.level + 1, 3))];
            stem.child_length = varied(child.length, child.length_v, stem.key, Draw::length, 1);
        }
        // What splits off bears what its stem handed on to it in Arbaro, and in tree-gen its part of a number of its own.
        if (!stem.clone || !arbaro_) set_density(stem, last);
        const SegmentLine line = trace_line(p_, stem);
        const auto branch = static_cast<std::int32_t>(out_.branches());
        draw(stem, line);
        const GrownStem grown{stem, branch, line.segment, p_.level[std::size_t(stem.level)].curve_res};
        born_.clear();
        if (!last)
            bear(stem, grown, line);
        else if (items.leaves || items.petals)
            grow_segment_leaves(p_, stem, grown, line, items, out_);
        for (SegmentStem clone : line.clones) {
            clone.parent = branch;
            born_.push_back(clone);
        }
        stack_.insert(stack_.end(), born_.rbegin(), born_.rend());
        check_size(out_, stack_.size());
    }
}

// Shortens a stem that leaves the envelope; false: it is left out.
bool SegmentGrower::prune(SegmentStem& stem) const {
    if (p_.prune_ratio <= 0 || (arbaro_ && stem.level == 0)) return true;
    const double length = stem.length, least = arbaro_ ? 0.001 * stem.scale : 0.15 * length;
    while (!fits(stem)) {
        stem.length *= 0.9;
        if (stem.length >= least) continue;
        if (p_.prune_ratio == 1) return false;
        stem.length = 0;
        break;
    }
    stem.length = length + p_.prune_ratio * (stem.length - length);
    set_radius(stem);
    return true;
}

// tree-gen looks at the trunk's tip alone, and not at what splits off.
bool SegmentGrower::fits(const SegmentStem& stem) const {
    std::vector<SegmentStem> family{stem};
    for (std::size_t i = 0; i < family.size(); ++i) {
        const SegmentLine line = trace_line(p_, family[i]);
        if (!inside(stem, line.tip)) return false;
        for (std::size_t k = 1; k < line.segment.size() && stem.level > 0; ++k)
            if (!inside(stem, line.segment[k].position)) return false;
        if (arbaro_) family.insert(family.end(), line.clones.begin(), line.clones.end());
    }
    return true;
}

bool SegmentGrower::inside(const SegmentStem& stem, const Vec3& at) const {
    const double bare = p_.level[0].base_size;
    const double ratio = (stem.scale - at.y()) / (stem.scale * (1 - bare));
    return std::hypot(at.x(), at.z()) < stem.scale * p_.prune_width * shape_ratio(p_, 8, ratio);
}

void SegmentGrower::set_radius(SegmentStem& stem) const {
    const LevelParameters& l = p_.level[std::size_t(stem.level)];
    if (stem.level == 0) {
        stem.radius = stem.length * p_.ratio * l.radius_mod *
                      varied(p_.radius_scale, p_.radius_scale_v, stem.key, Draw::radius_scale);
        return;
    }
    const double thin = l.radius_mod * stem.parent_radius * std::pow(stem.length / stem.parent_length, p_.ratio_power);
    stem.radius = std::min(std::max(thin, arbaro_ ? p_.least_radius : kThinnestBase), stem.most_radius);
}

void SegmentGrower::set_density(SegmentStem& stem, bool last) const {
    const int res = p_.level[std::size_t(stem.level)].curve_res;
    stem.density = (last ? segment_leaves(p_, stem) : segment_children(p_, stem)) / res;
    if (arbaro_) return;
    stem.density *= 1 - double(stem.first_segment) / res;
    if (!last) stem.density *= stem.thinned;
}

void SegmentGrower::draw(const SegmentStem& stem, const SegmentLine& line) {
    const LevelParameters& l = p_.level[std::size_t(stem.level)];
    out_.parent.push_back(stem.parent);
    out_.parent_at.push_back(stem.parent_at);
    out_.level.push_back(stem.level);
    const double flare = stem.level == 0 ? p_.flare : 0;
    std::vector<double> marks = taper_marks(l.taper, flare, stem.radius, stem.length);
    const double apart = 1e-3 / l.curve_res;
    for (std::size_t i = 0; i < line.segment.size(); ++i) {
        const double from = double(stem.first_segment + int(i)) / l.curve_res, to = from + 1.0 / l.curve_res;
        const auto add = [&](double z) {
            const Segment& s = line.segment[i];
            out_.point.push_back(s.position + s.frame * Vec3(0, 0, (z - from) * stem.length));
            const double radius = flare_factor(flare, z) * taper_radius(l.taper, stem.radius, stem.length, z);
            out_.radius.push_back(std::max(radius, p_.least_radius));
        };
        if (i == 0) add(from);
        auto mark = std::upper_bound(marks.begin(), marks.end(), from + apart);
        for (; mark != marks.end() && *mark < to - apart; ++mark) add(*mark);
        add(to);
    }
    out_.first_point.push_back(static_cast<std::int32_t>(out_.points()));
}

void SegmentGrower::bear(const SegmentStem& stem, const GrownStem& grown, const SegmentLine& line) {
    const std::vector<Insertion> all = segment_places(p_, stem, line, p_.level[std::size_t(stem.level) + 1]);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SegmentStem child = child_of(stem, grown, i, all[i]);
        if (!arbaro_ && child.most_radius < kThinnestParent) continue;
        if (child.length > 1e-5 && std::isfinite(child.length) && child.radius > 0) born_.push_back(child);
    }
}

SegmentStem SegmentGrower::child_of(const SegmentStem& stem, const GrownStem& grown, std::size_t index,
                                    const Insertion& place) const {
    const LevelParameters& l = p_.level[std::size_t(stem.level)];
    const double z = std::min(1.0, place.offset / stem.length);
    SegmentStem child;
    child.key = random_key(stem.key, Draw::child, index);
    child.parent = grown.branch;
    child.parent_at = grown.fraction(place.offset);
    child.level = stem.level + 1;
    child.position = grown.point_at(place.offset);
    child.place = z;
    child.scale = stem.scale;
    child.parent_length = stem.length;
    child.parent_child_length = stem.child_length;
    // The trunk's children go by its radius without radius_scale, which Arbaro has for what is drawn of the trunk alone.
    child.parent_radius = stem.radius / (stem.level == 0 && arbaro_ ? p_.radius_scale : 1);
    const double flare = stem.level == 0 ? flare_factor(p_.flare, z) : 1;
    child.most_radius = flare * exact_taper_radius(l.taper, stem.radius, stem.length, z);
    if (stem.level == 0) {
        const double bare = l.base_size * (arbaro_ ? stem.scale : stem.length);
        child.length = stem.length * stem.child_length *
                       shape_ratio(p_, p_.shape, (stem.length - place.offset) / (stem.length - bare));
    } else
        child.length = stem.child_length * (stem.length - (arbaro_ ? 0.6 : 0.7) * place.offset);
    set_radius(child);
    const LevelParameters& own = p_.level[std::size_t(child.level)];
    child.frame = grown.segment_at(place.offset).frame * about_z(place.turn * degree) *
                  about_x(segment_down_angle(p_, stem, own, place.offset, child.key) * degree);
    return child;
}

} // namespace

void grow_segments(const GrowthParameters& p, std::uint64_t seed, const Items& items, Splines& out) {
    SegmentGrower(p, out).run(seed, items);
}

} // namespace bough
