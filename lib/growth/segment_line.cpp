#include "segment_line.h"
#include <numbers>

namespace bough {

namespace {

class Tracer {
public:
    Tracer(const GrowthParameters& p, const SegmentStem& stem)
        : p_(p), l_(p.level[std::size_t(stem.level)]), now_(stem), arbaro_(p.rules == GrowthRules::arbaro) {}
    SegmentLine run();

private:
    double curve_at(int segment) const;
    Quat curved(const Quat& frame, const SegmentStem&, int segment) const;
    Quat drawn_to_light(const Quat& frame) const;
    int splits_at(int next);
    Quat split_arbaro(const Segment& end, int next, int clones);
    Quat split_tree_gen(const Segment& end, int next, int clones);
    void add_clone(const SegmentStem&, const Vec3& position, int next);
    bool base_split(int next) const;
    std::uint64_t at(int next) const { return static_cast<std::uint64_t>(next); }

    const GrowthParameters& p_;
    const LevelParameters& l_;
    SegmentStem now_; // what changes along the stem
    bool arbaro_;
    SegmentLine out_;
};

SegmentLine Tracer::run() {
    const double step = now_.length / l_.curve_res;
    Segment segment{now_.position, now_.frame};
    // What splits off in Arbaro curves where it starts; in tree-gen it starts straight.
    if (arbaro_ && now_.first_segment > 0) segment.frame = curved(segment.frame, now_, now_.first_segment);
    const int first = now_.first_segment;
    for (int next = first + 1;; ++next) {
        out_.segment.push_back(segment);
        const double density = now_.density;
        segment.position += segment.frame * Vec3(0, 0, step);
        const int clones = next < l_.curve_res && l_.curve_v >= 0 ? splits_at(next) : 0;
        // tree-gen thins a segment's children for the split at its end, Arbaro those of the next.
        out_.density.push_back(arbaro_ ? density : now_.density);
        if (next >= l_.curve_res) break;
        if (clones > 0)
            segment.frame = arbaro_ ? split_arbaro(segment, next, clones) : split_tree_gen(segment, next, clones);
        if (arbaro_ || clones == 0) segment.frame = curved(segment.frame, now_, next);
        if (!arbaro_) segment.frame = drawn_to_light(segment.frame);
        segment.frame.normalize();
    }
    out_.tip = segment.position;
    return std::move(out_);
}

double Tracer::curve_at(int segment) const {
    if (l_.curve_back == 0) return l_.curve / l_.curve_res;
    const bool first_half = arbaro_ ? segment < (l_.curve_res + 1) / 2 : 2 * segment < l_.curve_res;
    return 2 * (first_half ? l_.curve : l_.curve_back) / l_.curve_res;
}

Quat Tracer::curved(const Quat& frame, const SegmentStem& stem, int segment) const {
    const double vary = l_.curve_v / l_.curve_res;
    const double curve = curve_at(segment) * degree + stem.unbend;
    if (l_.curve_v < 0) {
        const double off = -l_.curve_v * degree;
        return frame * about_x(curve - off) * about(Vec3::UnitZ(), 2 * std::numbers::pi / l_.curve_res) * about_x(off);
    }
    const double u = random_sign(stem.key, Draw::curve, at(segment));
    if (!arbaro_) {
        const double bend = l_.bend_v / l_.curve_res * random_sign(stem.key, Draw::bend, at(segment));
        return frame * about_y(bend * degree) * about_x(curve + vary * u * degree);
    }
    const double axis = 2 * std::numbers::pi * random_unit(stem.key, Draw::curve_axis, at(segment));
    const Quat result = frame * about_x(curve) * about(Vec3(std::cos(axis), std::sin(axis), 0), vary * u * degree);
    if (l_.attraction_up == 0) return result;
    // Arbaro weighs the paper's pull by the declination's sine, so that it never overshoots the vertical by much.
    const double down = declination(result);
    const Vec3 across = (result * Vec3::UnitZ()).cross(Vec3::UnitY());
    if (across.norm() < 1e-12) return result;
    return about(across.normalized(), l_.attraction_up * down * std::sin(down) / l_.curve_res) * result;
}

Quat Tracer::drawn_to_light(const Quat& frame) const {
    Vec3 pull = p_.tropism;
    if (now_.level <= 1) pull.y() = 0;
    const Vec3 turn = (frame * Vec3::UnitZ()).cross(pull);
    const double size = turn.norm();
    return size < 1e-12 ? frame : Quat(about(turn / size, 10 * size * degree) * frame);
}

bool Tracer::base_split(int next) const {
    if (l_.base_splits <= 0) return false;
    return next == (arbaro_ ? 1 : static_cast<int>(std::ceil(p_.level[0].base_size * p_.level[0].curve_res)));
}

// How many stems split off where segment `next` starts; tree-gen's thinning is applied.
int Tracer::splits_at(int next) {
    if (base_split(next)) return static_cast<int>(l_.base_splits);
    if (arbaro_) {
        const double start = random_unit(now_.key, Draw::splits);
        return static_cast<int>(whole_number(l_.seg_splits * next, start) -
                                whole_number(l_.seg_splits * (next - 1), start));
    }
    const bool bare = now_.level == 0 && next <= std::ceil(p_.level[0].base_size * l_.curve_res);
    if (l_.seg_splits <= 0 || bare || random_unit(now_.key, Draw::split_share, at(next)) > now_.split_share) return 0;
    const auto clones = static_cast<int>(whole_number(l_.seg_splits, random_unit(now_.key, Draw::splits, at(next))));
    now_.split_share /= clones + 1;
    now_.thinned = std::max(0.8, now_.thinned / (clones + 1));
    now_.density *= now_.thinned;
    return clones;
}

void Tracer::add_clone(const SegmentStem& clone, const Vec3& position, int next) {
    out_.clones.push_back(clone);
    SegmentStem& c = out_.clones.back();
    c.key = random_key(now_.key, Draw::clone, at(next) << 32 | out_.clones.size());
    c.position = position;
    c.clone = true;
    c.parent_at = static_cast<double>(next - now_.first_segment) / (l_.curve_res - now_.first_segment);
    c.first_segment = next;
}

// Returns the stem's own frame after the split, as split_tree_gen() does.
Quat Tracer::split_arbaro(const Segment& end, int next, int clones) {
    const double down = declination(end.frame) / degree;
    const SegmentStem before = now_;
    const bool last = now_.level + 1 >= p_.levels; // leaves are not shared out
    const auto turn = [&](std::uint64_t number) {
        const double angle = varied(l_.split_angle, l_.split_angle_v, before.key, Draw::split_angle, number);
        return std::max(0.0, angle - down) * degree;
    };
    for (int i = 0; i < clones; ++i) {
        const std::uint64_t number = at(next) << 32 | std::uint64_t(i + 1);
        double spread = 360.0 * (i + 1) / (clones + 1);
        const double u = random_unit(before.key, Draw::split_spread, number);
        const double side = random_sign(before.key, Draw::split_sign, number);
        if (base_split(next))
            spread += l_.split_angle_v * side;
        else
            spread = (side < 0 ? -1 : 1) * (20 + 0.75 * (30 + std::abs(down - 90)) * u * u);
        SegmentStem clone = before;
        const double angle = turn(number);
        clone.unbend -= angle / (l_.curve_res - next);
        clone.frame = about_y(spread * degree) * end.frame * about_x(angle);
        if (!last) clone.density /= clones + 1;
        add_clone(clone, end.position, next);
    }
    const double angle = turn(at(next) << 32);
    now_.unbend -= angle / (l_.curve_res - next);
    if (!last) now_.density /= clones + 1;
    return end.frame * about_x(angle);
}

Quat Tracer::split_tree_gen(const Segment& end, int next, int clones) {
    const bool base = base_split(next), direct = l_.split_angle < 0;
    const double down = declination(end.frame) / degree;
    const double drawn = varied(std::abs(l_.split_angle), l_.split_angle_v, now_.key, Draw::split_angle, at(next));
    const double angle = direct ? 0 : std::max(0.0, drawn - down) * degree;
    const double u = random_unit(now_.key, Draw::split_spread, at(next));
    const double spread = (direct ? drawn : -(20 + 0.75 * (30 + std::abs(down - 90) * u * u))) * degree;
    now_.unbend = -angle / (l_.curve_res + 1 - next);
    const Quat bent = end.frame * about_x(angle / 2);
    for (int i = 0; i < clones; ++i) {
        double turn = i == 0 ? spread / 2 : -spread / 2;
        if (base && !direct)
            turn = (360.0 * (i + 1) / (clones + 1) +
                    varied(0, l_.split_angle_v, now_.key, Draw::split_sign, std::uint64_t(i))) *
                   degree;
        SegmentStem clone = now_;
        clone.frame = direct ? Quat(bent * about_y(turn)) : Quat(about_y(turn) * bent);
        add_clone(clone, end.position, next);
    }
    if (base || clones != 1) return bent;
    return direct ? Quat(bent * about_y(-spread / 2)) : Quat(about_y(-spread / 2) * bent);
}

} // namespace

SegmentLine trace_line(const GrowthParameters& p, const SegmentStem& stem) {
    return Tracer(p, stem).run();
}

} // namespace bough
