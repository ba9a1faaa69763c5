// Growth by the readings at the head of grow.h.
#include "stem.h"
#include <algorithm>

namespace bough {

namespace {

constexpr double above_ground = 0.02; // of the trunk's length
constexpr double hangs = -3;          // attraction_up at which a level stem hangs after a third of its length

// The turn about what bears a child, mirrored where the child would leave on the upper side: as far to the side, and as far down as it was up. Where
// the bearer stands nearly plumb, no side is the lower.
double on_the_lower_side(const Quat& bearer, double turn, double leans) {
    constexpr double plumb = 0.25; // sine of the bearer's lean
    const Vec3 up = bearer.conjugate() * Vec3::UnitY();
    const double tilt = std::hypot(up.x(), up.y());
    if (tilt < plumb) return turn;
    const double x = std::sin(turn), y = -std::cos(turn), rises = (x * up.x() + y * up.y()) / tilt; // where it leans to
    if (rises * leans <= 0) return turn;
    return std::atan2(x - 2 * rises * up.x() / tilt, 2 * rises * up.y() / tilt - y);
}

// Grows stems from a stack, so that a stem's whole subtree follows it before its next sibling.
class Grower {
public:
    Grower(const GrowthParameters& parameters, Splines& out) : p_(parameters), out_(out) {}
    void run(std::uint64_t seed, const Items&);

private:
    void plant(std::uint64_t seed);
    void draw(const Stem&, std::int32_t branch);
    void draw_as_it_fits(Stem&, std::int32_t branch);
    template <class Fits> void shorten(Stem&, std::int32_t branch, double share, const Fits&);
    bool is_above(std::int32_t branch, double lowest) const;
    bool inside_envelope(std::int32_t branch) const;
    void undraw(std::int32_t branch);
    void draw_points(const Stem&, const std::vector<double>& marks, int segment);
    Quat turned(const Stem&, const Quat& frame, int segment) const;
    int splits_after(const Stem&, int segment) const;
    Quat split(const Stem&, std::int32_t branch, const Segment& end, int next, int clones, double& unbend);
    void bear(const GrownStem&);
    Stem child_of(const GrownStem&, int index, double offset, double turn) const;
    Stem leading_shoot(const GrownStem& trunk) const;
    double whorled(double offset, double base, const GrownStem&, double dist) const;

    const GrowthParameters& p_;
    Splines& out_;
    std::vector<Stem> stack_, born_;
    std::vector<Segment> segment_;
    double height_ = 0; // [m] of the trunk, which scales the envelope
};

void Grower::plant(std::uint64_t seed) {
    const LevelParameters& l = p_.level[0];
    Stem trunk;
    trunk.key = random_key(RandomKey{0}, Draw::trunk, seed);
    const double scale = varied(p_.scale, p_.scale_v, trunk.key, Draw::scale);
    trunk.length = scale * varied(l.length, l.length_v, trunk.key, Draw::length);
    trunk.radius = trunk.length * p_.ratio * l.radius_mod *
                   varied(p_.radius_scale, p_.radius_scale_v, trunk.key, Draw::radius_scale);
    const double roll = varied(l.rotate, l.rotate_v, trunk.key, Draw::rotate);
    const double lean = varied(l.down_angle, l.down_angle_v, trunk.key, Draw::down_angle);
    trunk.frame = about_x(-std::numbers::pi / 2) * about_z(roll * degree) * about_x(lean * degree);
    stack_.push_back(trunk);
    height_ = trunk.length;
}

void Grower::run(std::uint64_t seed, const Items& items) {
    plant(seed);
    out_.first_point.push_back(0);
    while (!stack_.empty()) {
        Stem stem = stack_.back();
        stack_.pop_back();
        const auto branch = static_cast<std::int32_t>(out_.branches());
        draw_as_it_fits(stem, branch);
        const GrownStem grown{stem, branch, segment_, p_.level[stem.level].curve_res};
        if (stem.level + 1 < p_.levels)
            bear(grown);
        else {
            if (items.leaves) grow_leaves(p_, grown, out_);
            if (items.petals) grow_blossoms(p_, grown, out_);
            if (items.fruit) grow_fruits(p_, grown, out_);
        }
        stack_.insert(stack_.end(), born_.rbegin(), born_.rend());
        check_size(out_, stack_.size());
    }
}

// Draws a stem as long as the envelope and the ground let it be (grow.h).
void Grower::draw_as_it_fits(Stem& stem, std::int32_t branch) {
    draw(stem, branch);
    if (stem.level == 0) return;
    if (p_.prune_ratio > 0) shorten(stem, branch, p_.prune_ratio, [&] { return inside_envelope(branch); });
    const double lowest = std::min(above_ground * height_, stem.position.y());
    shorten(stem, branch, 1, [&] { return is_above(branch, lowest); });
}

// By `share` of what it is too long by, where it does not fit.
template <class Fits> void Grower::shorten(Stem& stem, std::int32_t branch, double share, const Fits& fits) {
    constexpr double shorter = 0.9;
    constexpr int most_tries = 24;
    if (fits()) return;
    const double length = stem.length, radius = stem.radius;
    double fitting = length;
    for (int i = 0; i < most_tries && !fits(); ++i) {
        undraw(branch);
        fitting *= shorter;
        stem.length = fitting;
        draw(stem, branch);
    }
    undraw(branch);
    stem.length = length + share * (fitting - length);
    stem.radius = std::max(radius * std::pow(stem.length / length, p_.ratio_power), std::min(radius, p_.least_radius));
    draw(stem, branch);
}

bool Grower::is_above(std::int32_t branch, double lowest) const {
    const auto first = out_.point.begin() + out_.first_point[std::size_t(branch)];
    return std::all_of(first, out_.point.end(), [&](const Vec3& at) { return at.y() >= lowest; });
}

bool Grower::inside_envelope(std::int32_t branch) const {
    const double bare = p_.prune_base >= 0 ? p_.prune_base : p_.level[0].base_size;
    for (auto i = std::size_t(out_.first_point[std::size_t(branch)]); i < out_.points(); ++i) {
        const Vec3& at = out_.point[i];
        const double ratio = (height_ - at.y()) / (height_ * (1 - bare));
        if (std::hypot(at.x(), at.z()) > height_ * p_.prune_width * envelope_ratio(p_, ratio)) return false;
    }
    return true;
}

void Grower::undraw(std::int32_t branch) {
    const auto b = std::size_t(branch);
    const auto first = std::size_t(out_.first_point[b]);
    out_.parent.resize(b);
    out_.parent_at.resize(b);
    out_.level.resize(b);
    out_.first_point.resize(b + 1);
    out_.point.resize(first);
    out_.radius.resize(first);
}

// Appends a branch: its points, and to born_ the clones that leave it.
void Grower::draw(const Stem& stem, std::int32_t branch) {
    const LevelParameters& l = p_.level[stem.level];
    born_.clear();
    out_.parent.push_back(stem.parent);
    out_.parent_at.push_back(stem.parent_at);
    out_.level.push_back(stem.level);
    const std::vector<double> marks = taper_marks(l.taper, stem.level == 0 ? p_.flare : 0, stem.radius, stem.length);
    const double step = stem.length / l.curve_res;
    segment_.clear();
    segment_.push_back({stem.position, stem.frame, stem.share});
    Stem state = stem;
    for (int i = stem.first_segment; i < l.curve_res; ++i) {
        draw_points(stem, marks, i);
        if (i + 1 == l.curve_res) break;
        const Segment& now = segment_.back();
        Segment next{now.position + now.frame * Vec3(0, 0, step), now.frame, now.share};
        if (const int clones = splits_after(stem, i); clones > 0) {
            if (p_.split_exponent > 0) next.share *= std::pow(clones + 1, -1 / p_.split_exponent);
            next.frame = split(stem, branch, next, i + 1, clones, state.unbend);
        }
        next.frame = turned(state, next.frame, i + 1);
        segment_.push_back(next);
    }
    out_.first_point.push_back(static_cast<std::int32_t>(out_.points()));
}

// Points of a segment's end and of the marks within; of a branch's first segment also of its start.
void Grower::draw_points(const Stem& stem, const std::vector<double>& marks, int segment) {
    const LevelParameters& l = p_.level[stem.level];
    const double from = static_cast<double>(segment) / l.curve_res, to = static_cast<double>(segment + 1) / l.curve_res;
    const Segment& s = segment_.back();
    const auto shaped = [&](double z) {
        const double r = taper_radius(l.taper, stem.radius, stem.length, z);
        return l.taper_power == 1 ? r : stem.radius * std::pow(r / stem.radius, l.taper_power);
    };
    const auto add = [&](double z) {
        const double flare = stem.level == 0 ? flare_factor(p_.flare, z) : 1;
        out_.point.push_back(s.position + s.frame * Vec3(0, 0, (z - from) * stem.length));
        out_.radius.push_back(std::max(flare * s.share * shaped(z), p_.least_radius));
    };
    if (segment == stem.first_segment) add(from);
    const double apart = 1e-3 * (to - from);
    for (auto z = std::upper_bound(marks.begin(), marks.end(), from + apart); z != marks.end() && *z < to - apart; ++z)
        add(*z);
    add(to);
}

// The frame of segment `segment` from that of the one before.
Quat Grower::turned(const Stem& stem, const Quat& frame, int segment) const {
    const LevelParameters& l = p_.level[stem.level];
    const bool first_half = 2 * segment < l.curve_res + 1;
    double bend = l.curve / l.curve_res;
    if (l.curve_back != 0) bend = 2 * (first_half ? l.curve : l.curve_back) / l.curve_res;
    const auto at = static_cast<std::uint64_t>(segment);
    Quat result = frame * about_x(bend * degree + stem.unbend);
    if (l.curve_v > 0) {
        const double axis = 2 * std::numbers::pi * random_unit(stem.key, Draw::curve_axis, at);
        const double angle = l.curve_v / l.curve_res * random_sign(stem.key, Draw::curve, at);
        result = result * about(Vec3(std::cos(axis), std::sin(axis), 0), angle * degree);
    } else if (l.curve_v < 0) {
        const double off = -l.curve_v * degree;
        result = result * about_x(-off) * about_z(2 * std::numbers::pi / l.curve_res) * about_x(off);
    }
    if (l.attraction_up != 0) {
        // The paper's declination * cos(orientation) about x, written for any frame: about the level axis across the stem.
        const Vec3 across = (result * Vec3::UnitZ()).cross(Vec3::UnitY());
        result = about(across, l.attraction_up * declination(result) / l.curve_res) * result;
    }
    return result.normalized();
}

// Clones that leave at the end of segment `segment`: evenly along the stem, from a start of its own.
int Grower::splits_after(const Stem& stem, int segment) const {
    const LevelParameters& l = p_.level[stem.level];
    if (segment == 0 && l.base_splits > 0)
        return static_cast<int>(whole_number(l.base_splits, random_unit(stem.key, Draw::base_splits)));
    const double start = random_unit(stem.key, Draw::splits);
    return static_cast<int>(whole_number(l.seg_splits * (segment + 1), start) -
                            whole_number(l.seg_splits * segment, start));
}

// Puts the clones into born_; returns the stem's own frame after the split.
Quat Grower::split(const Stem& stem, std::int32_t branch, const Segment& end, int next, int clones, double& unbend) {
    const LevelParameters& l = p_.level[stem.level];
    const double down = declination(end.frame);
    const double before = unbend;
    const auto turn = [&](RandomKey key) {
        return std::max(
            0.0, varied(l.split_angle, l.split_angle_v, key, Draw::split_angle, std::uint64_t(next)) * degree - down);
    };
    const double left = l.curve_res - next;
    for (int i = 0; i < clones; ++i) {
        Stem clone = stem;
        clone.key =
            random_key(stem.key, Draw::clone, static_cast<std::uint64_t>(next) << 32 | static_cast<std::uint64_t>(i));
        double spread = 2 * std::numbers::pi * (i + 1) / (clones + 1);
        if (next > 1 || l.base_splits <= 0) {
            const double u = random_unit(clone.key, Draw::split_spread);
            const double side = random_unit(clone.key, Draw::split_sign) < 0.5 ? -1 : 1;
            spread = side * degree * (20 + 0.75 * (30 + std::abs(down / degree - 90)) * u * u);
        }
        const double angle = turn(clone.key);
        clone.unbend = before - angle / left;
        clone.frame = about(Vec3::UnitY(), spread) * end.frame * about_x(angle);
        clone.frame = turned(clone, clone.frame, next);
        clone.position = end.position;
        clone.parent = branch;
        clone.parent_at = static_cast<double>(next - stem.first_segment) / (l.curve_res - stem.first_segment);
        clone.first_segment = next;
        clone.share = end.share;
        born_.push_back(clone);
    }
    const double angle = turn(stem.key);
    unbend = before - angle / left;
    return end.frame * about_x(angle);
}

// Puts the stem's children into born_.
void Grower::bear(const GrownStem& grown) {
    const Stem& stem = grown.stem;
    const LevelParameters& l = p_.level[stem.level + 1];
    double number = l.branches;
    if (stem.level == 1) number *= 0.2 + 0.8 * stem.crown;
    if (stem.level > 1) number *= 1 - 0.5 * stem.place;
    const auto count = static_cast<int>(whole_number(number, random_unit(stem.key, Draw::children)));
    const double base = p_.level[stem.level].base_size * stem.length;
    double turn = 0;
    for (int i = 0; i < count; ++i) {
        const double varies = l.rotate_v * random_sign(stem.key, Draw::rotate, static_cast<std::uint64_t>(i));
        turn = l.rotate >= 0 ? turn + l.rotate + varies : (i % 2 ? -1 : 1) * (180 + l.rotate + varies);
        const double even = base + (i + 0.5) / count * (stem.length - base);
        const double offset = whorled(even, base, grown, l.branch_dist);
        if (offset < grown.start()) continue;
        const Stem child = child_of(grown, i, offset, turn);
        if (child.length > 0) born_.push_back(child);
    }
    if (stem.level == 0 && p_.leading_shoot > 0) born_.push_back(leading_shoot(grown));
}

Stem Grower::leading_shoot(const GrownStem& trunk) const {
    const Stem& stem = trunk.stem;
    Stem shoot;
    shoot.key = random_key(stem.key, Draw::leader, 0);
    shoot.parent = trunk.branch;
    shoot.parent_at = 1;
    shoot.level = p_.levels - 1;
    shoot.position = trunk.point_at(stem.length);
    shoot.place = 1;
    shoot.length = p_.leading_shoot * stem.length;
    shoot.radius = radius_at(out_, trunk.branch, 1);
    shoot.frame = trunk.segment.back().frame;
    return shoot;
}

// Moves an offset by `dist` of the way to the nearest place above the base where two segments meet.
double Grower::whorled(double offset, double base, const GrownStem& grown, double dist) const {
    const double step = grown.stem.length / grown.curve_res;
    const double least = std::max(1.0, std::ceil(base / step));
    if (dist <= 0 || least > grown.curve_res - 1) return offset;
    const bool led = grown.stem.level == 0 && p_.leading_shoot > 0;
    const double node = std::clamp(std::round(offset / step), least, double(grown.curve_res - (led ? 0 : 1)));
    return offset + dist * (node * step - offset);
}

Stem Grower::child_of(const GrownStem& grown, int index, double offset, double turn) const {
    const Stem& stem = grown.stem;
    const LevelParameters& l = p_.level[stem.level + 1];
    const double base = p_.level[stem.level].base_size * stem.length;
    Stem child;
    child.key = random_key(stem.key, Draw::child, static_cast<std::uint64_t>(index));
    child.parent = grown.branch;
    child.parent_at = grown.fraction(offset);
    child.level = stem.level + 1;
    child.position = grown.point_at(offset);
    child.place = offset / stem.length;
    const double longest = varied(l.length, l.length_v, child.key, Draw::length);
    if (stem.level == 0) {
        child.crown = crown_ratio(p_, stem.length, base, offset);
        child.length = stem.length * longest * child.crown;
    } else
        child.length = longest * (stem.length - 0.6 * offset);
    const double radius = l.radius_mod * grown.segment_at(offset).share * stem.radius *
                          std::pow(child.length / stem.length, p_.ratio_power);
    child.radius = std::min(std::max(radius, p_.least_radius), radius_at(out_, grown.branch, child.parent_at));
    if (p_.most_slender > 0) child.length = std::min(child.length, p_.most_slender * child.radius);
    const double up = shape_ratio(0, (stem.length - offset) / (stem.length - base));
    const double down = l.down_angle_v < 0 ? l.down_angle + l.down_angle_v * (1 - 2 * up)
                                           : varied(l.down_angle, l.down_angle_v, child.key, Draw::down_angle);
    const Quat& bearer = grown.segment_at(offset).frame;
    double round = turn * degree;
    if (l.attraction_up <= hangs) round = on_the_lower_side(bearer, round, std::sin(down * degree));
    child.frame = bearer * about_z(round) * about_x(down * degree);
    return child;
}

} // namespace

void grow_stems(const GrowthParameters& p, std::uint64_t seed, const Items& items, Splines& out) {
    Grower(p, out).run(seed, items);
}

} // namespace bough
