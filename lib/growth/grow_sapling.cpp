// Sapling's growth (rules.h), in Sapling's axes until points are written. Reference: add_curve_sapling/utils.py of
// Blender 3.4: the rules are its, the code is not.
#include "sapling_family.h"
#include "turn.h"
#include <algorithm>
#include <map>
#include <numbers>

namespace bough {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Where a child or leaf grows.
struct ChildPoint {
    std::int32_t branch;
    double at; // fraction of the branch's arc length
    Vec3 position, direction;
    double radius_start, radius; // [m] of the parent: at its base, here
    double offset, shape_offset; // fraction of the stem; of the piece, as its length goes by
    double parent_length;
};

class SaplingGrower {
public:
    SaplingGrower(const GrowthParameters& p, Splines& out) : p_(p), s_(p.sapling), out_(out) {}
    void run(std::uint64_t seed, const Items&);

private:
    SaplingStem trunk(std::uint64_t seed) const;
    double base_size(int level) const { return level + 1 >= p_.levels ? 0 : p_.level[std::size_t(level)].base_size; }
    double end_radius(double start, int level) const;
    std::vector<SaplingPiece> pruned(SaplingStem) const;
    bool inside(const SaplingStem&, const std::vector<SaplingPiece>&) const;
    void draw(const SaplingStem&, const std::vector<SaplingPiece>&, std::int32_t branch);
    std::vector<double> fractions(const SaplingStem&, const std::vector<SaplingPiece>&) const;
    std::vector<ChildPoint> points(const SaplingStem&, const std::vector<SaplingPiece>&, std::int32_t branch) const;
    void turn_outward(const SaplingStem&, std::vector<ChildPoint>&, std::vector<double>& turns) const;
    void bear(const SaplingStem&, const std::vector<ChildPoint>&);
    double down_angle(const ChildPoint&, RandomKey key, int level) const;
    void leaves(const SaplingStem&, const std::vector<ChildPoint>&);
    void leaf(const ChildPoint&, double turn, double next_turn, double part, RandomKey key);

    const GrowthParameters& p_;
    const SaplingRules& s_;
    Splines& out_;
    std::vector<SaplingStem> stack_;
};

double SaplingGrower::end_radius(double start, int level) const {
    const double taper = p_.level[std::size_t(level)].taper;
    const double end = std::pow(start * std::max(0.0, 1 - taper), p_.ratio_power);
    return std::max({end, p_.least_radius, 0.05 * start});
}

SaplingStem SaplingGrower::trunk(std::uint64_t seed) const {
    const LevelParameters& l = p_.level[0];
    SaplingStem t;
    t.key = random_key(RandomKey{0}, Draw::trunk, seed);
    t.scale = p_.scale + p_.scale_v * random_sign(t.key, Draw::scale);
    t.segment_length = t.scale * l.length / l.curve_res;
    const double thick = p_.radius_scale + p_.radius_scale_v * random_sign(t.key, Draw::radius_scale);
    t.radius_start = std::max(t.scale * p_.ratio * thick, p_.least_radius);
    t.radius_end = end_radius(t.radius_start, 0);
    t.children = p_.levels == 1 ? p_.leaves : p_.level[1].branches;
    return t;
}

void SaplingGrower::run(std::uint64_t seed, const Items& items) {
    stack_ = {trunk(seed)};
    out_.first_point.push_back(0);
    while (!stack_.empty()) {
        const SaplingStem stem = stack_.back();
        stack_.pop_back();
        const std::vector<SaplingPiece> pieces = pruned(stem);
        const auto branch = static_cast<std::int32_t>(out_.branches());
        draw(stem, pieces, branch);
        if (stem.level + 1 < p_.levels)
            bear(stem, points(stem, pieces, branch));
        else if (items.leaves && p_.leaves != 0)
            leaves(stem, points(stem, pieces, branch));
        check_size(out_, stack_.size());
    }
}

// Shortened by halving until its tips are inside the envelope, then lengthened by what prune_ratio leaves.
std::vector<SaplingPiece> SaplingGrower::pruned(SaplingStem stem) const {
    std::vector<SaplingPiece> pieces = sapling_family(p_, stem);
    if (p_.prune_ratio <= 0 || inside(stem, pieces)) return pieces;
    const double length = stem.segment_length;
    double fits = 0, leaves = 1;
    while (leaves - fits > 0.005) {
        const double middle = (fits + leaves) / 2;
        stem.segment_length = length * middle;
        (inside(stem, sapling_family(p_, stem)) ? fits : leaves) = middle;
    }
    // A stem that starts outside keeps what Sapling leaves it, too.
    const double kept = std::max(fits, 0.005);
    stem.segment_length = length * (1 + p_.prune_ratio * (kept - 1));
    return sapling_family(p_, stem);
}

bool SaplingGrower::inside(const SaplingStem& stem, const std::vector<SaplingPiece>& pieces) const {
    const double base = p_.prune_base < 0 ? p_.level[0].base_size : p_.prune_base;
    return std::all_of(pieces.begin(), pieces.end(), [&](const SaplingPiece& piece) {
        const Vec3& tip = piece.point.back();
        if (stem.level == 0 && tip.z() < base * stem.scale) return true;
        const double ratio = (stem.scale - tip.z()) / (stem.scale * (1 - base));
        return std::hypot(tip.x(), tip.y()) < stem.scale * p_.prune_width * shape_ratio(p_, 9, ratio);
    });
}

// Sapling's z up to ours.
Vec3 y_up(const Vec3& v) {
    return {v.x(), v.z(), -v.y()};
}

double arc_between(const SaplingPiece& piece, std::size_t from, std::size_t to) {
    double arc = 0;
    for (std::size_t i = from; i < to; ++i) arc += (piece.point[i + 1] - piece.point[i]).norm();
    return arc;
}

double fraction_at(const SaplingPiece& piece, std::size_t point, double part) {
    const std::size_t last = piece.point.size() - 1;
    const double beyond = part > 0 ? part * arc_between(piece, point, point + 1) : 0;
    return std::min(1.0, (arc_between(piece, 0, point) + beyond) / arc_between(piece, 0, last));
}

void SaplingGrower::draw(const SaplingStem& stem, const std::vector<SaplingPiece>& pieces, std::int32_t branch) {
    for (const SaplingPiece& piece : pieces) {
        const bool part = piece.parent >= 0;
        out_.parent.push_back(part ? branch + piece.parent : stem.parent);
        out_.parent_at.push_back(part ? fraction_at(pieces[std::size_t(piece.parent)], piece.from, 0) : stem.parent_at);
        out_.level.push_back(stem.level);
        for (std::size_t i = 0; i < piece.point.size(); ++i) {
            out_.point.push_back(y_up(piece.point[i]));
            out_.radius.push_back(std::max({piece.radius[i], p_.least_radius, 0.05 * piece.radius_start}));
        }
        out_.first_point.push_back(static_cast<std::int32_t>(out_.points()));
    }
}

// Where children grow along the stem, 0..1.
std::vector<double> SaplingGrower::fractions(const SaplingStem& stem, const std::vector<SaplingPiece>& pieces) const {
    const bool trunk = stem.level == 0;
    double number = std::floor(stem.children);
    if (!trunk || s_.rotation == SaplingRules::Rotation::original) {
        std::size_t segments = 0;
        for (const SaplingPiece& piece : pieces) segments += piece.point.size() - 1;
        // Half goes to even, as where Sapling rounds.
        number = std::nearbyint(stem.children / double(segments) * p_.level[std::size_t(stem.level)].curve_res);
    }
    std::vector<double> result;
    for (double i = 1; i <= number; ++i) result.push_back(i / number);
    if (stem.children <= 0) result = {1};
    const double base = base_size(stem.level);
    const auto trimmed = static_cast<std::ptrdiff_t>(base * double(result.size() + 1));
    result.erase(result.begin(), result.begin() + std::min(trimmed, std::ptrdiff_t(result.size())));
    if (!trunk) return result;
    if (s_.rings > 0) {
        for (std::size_t i = 0; i + 1 < result.size(); ++i)
            result[i] =
                std::floor(result[i] * s_.rings) / s_.rings * (1 + 0.005 * random_sign(stem.key, Draw::place, i));
        std::erase_if(result, [base](double t) { return t <= base; });
    }
    for (double& t : result) {
        const double above = std::clamp((t - base) / (1 - base), 0.0, 1.0);
        const double d = s_.branch_dist;
        t = base + (1 - base) * (d < 1 ? std::pow(above, 1 / d) : 1 - std::pow(1 - above, d));
    }
    return result;
}

// Each place on every piece that reaches there, and the tips.
std::vector<ChildPoint> SaplingGrower::points(const SaplingStem& stem, const std::vector<SaplingPiece>& pieces,
                                              std::int32_t branch) const {
    const std::vector<double> at = fractions(stem, pieces);
    const int res = p_.level[std::size_t(stem.level)].curve_res;
    const double base = base_size(stem.level);
    double longest = 0;
    for (const SaplingPiece& piece : pieces)
        longest = std::max(longest, piece.offset + double(piece.point.size() - 1) * piece.segment_length);
    std::vector<ChildPoint> result;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const SaplingPiece& piece = pieces[i];
        const std::size_t segments = piece.point.size() - 1;
        const double low = piece.offset / longest, high = low + double(segments) * piece.segment_length / longest;
        const double length = res * piece.segment_length;
        const std::int32_t own = branch + std::int32_t(i);
        for (const double t : at) {
            if (t < low || t > high || t >= 1) continue;
            check_size(out_, stack_.size() + result.size());
            const double along = std::min((t - low) / (high - low), 1.0) * double(segments);
            const std::size_t k = std::min(static_cast<std::size_t>(along), segments - 1);
            const double part = along - double(k);
            const Vec3 step = piece.point[k + 1] - piece.point[k];
            result.push_back({own, fraction_at(piece, k, part), piece.point[k] + part * step, step.normalized(),
                              piece.radius_start, piece.radius[k] + part * (piece.radius[k + 1] - piece.radius[k]), t,
                              (t - base) / (high - base) * (1 - base) + base, length});
        }
        result.push_back(
            {own, 1, piece.point.back(), piece.heading, piece.radius_start, piece.radius.back(), 1, 1, length});
    }
    return result;
}

// [rad] The child's angle from its stem.
double SaplingGrower::down_angle(const ChildPoint& c, RandomKey key, int level) const {
    const LevelParameters& l = p_.level[std::size_t(level)];
    if (c.offset == 1) return 0;
    const double up = (1 - c.offset) / (1 - base_size(level - 1));
    double v = l.down_angle_v * random_sign(key, Draw::down_angle);
    if (s_.old_down_angle && l.down_angle_v < 0) v = l.down_angle_v * (1 - 2 * (0.2 + 0.8 * up));
    if (!s_.old_down_angle && l.down_angle_v > 0) v = -l.down_angle_v * (1 - up) * (1 - up);
    return (l.down_angle + v) * degree;
}

// One child of the trunk a place, on the piece that stands where the child is to point, or a random one; turns become
// their headings, from -y about z.
void SaplingGrower::turn_outward(const SaplingStem& stem, std::vector<ChildPoint>& children,
                                 std::vector<double>& turns) const {
    std::map<double, std::vector<ChildPoint>> places;
    std::vector<ChildPoint> tips, chosen;
    for (const ChildPoint& c : children) (c.offset == 1 ? tips : places[c.offset]).push_back(c);
    const LevelParameters& l = p_.level[1];
    double turn = 0;
    for (const auto& [offset, here] : places) {
        const std::size_t index = chosen.size();
        if (s_.rotation == SaplingRules::Rotation::random) {
            chosen.push_back(here[std::size_t(random_unit(stem.key, Draw::place, index) * double(here.size()))]);
            continue;
        }
        turn = l.rotate < 0 ? -std::copysign(l.rotate, turn) : turn + l.rotate;
        const double wanted = (turn + l.rotate_v * random_sign(stem.key, Draw::rotate, index + 1)) * degree;
        const auto off = [wanted](const ChildPoint& c) {
            return std::abs(std::remainder(std::atan2(c.position.x(), -c.position.y()) - wanted, kTurn));
        };
        const ChildPoint& c =
            *std::min_element(here.begin(), here.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
        // A third of the child's length, seen from above, further out than where it starts.
        double reach = c.parent_length * l.length * shape_ratio(p_, p_.shape, (1 - c.offset) / (1 - base_size(0)));
        const double up = (1 - c.offset) / (1 - base_size(0));
        const double down = (l.down_angle - std::max(0.0, l.down_angle_v) * (1 - up) * (1 - up)) * degree;
        if (down < std::numbers::pi / 2) reach *= std::sin(down) * std::sin(down);
        const double far = std::hypot(c.position.x(), c.position.y()) + 0.33 * reach;
        turns.push_back(std::atan2(far * std::sin(wanted) - c.position.x(), far * std::cos(wanted) + c.position.y()));
        chosen.push_back(c);
    }
    chosen.insert(chosen.end(), tips.begin(), tips.end());
    turns.resize(turns.empty() ? 0 : chosen.size(), 0);
    children = std::move(chosen);
}

void SaplingGrower::bear(const SaplingStem& stem, const std::vector<ChildPoint>& all) {
    const int level = stem.level + 1;
    const LevelParameters& l = p_.level[std::size_t(level)];
    std::vector<ChildPoint> children = all;
    std::vector<double> outward;
    if (level == 1 && s_.rotation != SaplingRules::Rotation::original) turn_outward(stem, children, outward);
    double longest = stem.scale;
    for (int n = 0; n <= level; ++n) longest *= p_.level[std::size_t(n)].length;
    // Sapling turns on through all stems of a level.
    double turn = 360 * random_unit(stem.key, Draw::rotate, std::uint64_t(1) << 40) - 180;
    std::vector<SaplingStem> born;
    for (std::size_t i = 0; i < children.size(); ++i) {
        const ChildPoint& c = children[i];
        SaplingStem child;
        child.key = random_key(stem.key, Draw::child, i);
        child.level = level;
        child.scale = stem.scale;
        child.parent = c.branch;
        child.parent_at = c.at;
        child.position = c.position;
        turn = l.rotate < 0 ? -std::copysign(l.rotate, turn) : turn + l.rotate;
        double around = (turn + l.rotate_v * random_sign(child.key, Draw::rotate)) * degree;
        if (!outward.empty()) around = outward[i];
        const double down = down_angle(c, child.key, level);
        const Vec3 d = about_z(around) * Vec3(0, -std::sin(down), std::cos(down));
        if (outward.empty() || c.offset == 1)
            child.direction = level_frame(c.direction) * d;
        else
            child.direction = s_.use_parent_angle ? Vec3(shortest_turn(Vec3::UnitZ(), c.direction) * d) : d;
        child.direction.normalize();
        const double ratio = (1 - c.shape_offset) / (1 - base_size(stem.level));
        const double length =
            c.parent_length * l.length * shape_ratio(p_, level == 1 ? p_.shape : s_.second_shape, ratio);
        if (!(length > 1e-6)) continue;
        const double relative = 0.1 + 0.9 * length / longest;
        child.segment_length = length / l.curve_res;
        if (level + 1 < p_.levels)
            child.children = p_.level[std::size_t(level) + 1].branches * relative;
        else
            child.children = p_.leaves < 0 ? 0 : p_.leaves * relative * shape_ratio(p_, p_.leaf_distrib, 1 - c.offset);
        const double thin = l.radius_mod * c.radius_start * std::pow(length / c.parent_length, p_.ratio_power);
        const double start = c.offset == 1 ? c.radius : std::min(thin, c.radius);
        child.radius_end = end_radius(start, level);
        child.radius_start = std::max(start, p_.least_radius);
        born.push_back(child);
    }
    stack_.insert(stack_.end(), born.rbegin(), born.rend());
}

void SaplingGrower::leaves(const SaplingStem& stem, const std::vector<ChildPoint>& all) {
    const double rotate = p_.leaf_angles[2], rotate_v = p_.leaf_angles[3];
    double turn = 360 * random_unit(stem.key, Draw::rotate, std::uint64_t(2) << 40) - 180;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const ChildPoint& c = all[i];
        const RandomKey key = random_key(stem.key, Draw::leaf, i);
        if (p_.leaves >= 0) {
            const double vary = rotate_v * random_sign(key, Draw::rotate);
            const double next = rotate < 0 ? -std::copysign(rotate + vary, turn) : turn + rotate + vary;
            leaf(c, turn, next, c.offset, key);
            turn = next;
            continue;
        }
        check_size(out_, 0);
        const auto count = static_cast<int>(std::round(-p_.leaves));
        for (int k = 0; k < count; ++k) {
            const double fan = count == 1 ? 0 : rotate * (double(k) / (count - 1) - 0.5);
            const double part = count == 1 || rotate == 0 ? c.offset : 1 - std::abs(fan / (rotate / 2));
            leaf(c, fan, fan, part, random_key(key, Draw::leaf, std::uint64_t(k)));
        }
    }
}

// turn and next_turn [deg] about the stem, or in the fan; part: 0..1, by which leaf_scale_taper goes.
void SaplingGrower::leaf(const ChildPoint& c, double turn, double next_turn, double part, RandomKey key) {
    const double rotate = p_.leaf_angles[2], down_v = p_.leaf_angles[1];
    const bool fan = p_.leaves < 0;
    const Quat tilt = about(Vec3::UnitX(), -s_.leaf_angle * degree);
    Quat blade = level_frame(c.direction) * about(fan ? Vec3::UnitY() : Vec3::UnitZ(), turn * degree);
    if (!fan) {
        const double v = down_v > 0 ? -down_v * c.offset : down_v * random_sign(key, Draw::down_angle);
        blade = blade * about(Vec3::UnitX(), (p_.leaf_angles[0] + v) * degree);
        if (rotate > 0 && s_.level_leaves) blade = blade * about_z((rotate - next_turn) * degree);
    }
    if (rotate < 0) blade = blade * about_z((next_turn < 0 ? 270 : 90) * degree);
    blade = blade * tilt;
    if ((blade * Vec3::UnitY()).z() < 0) blade = blade * about_z(std::numbers::pi);
    const double taper = s_.leaf_scale_taper;
    const double smaller = taper < 0 ? 1 + (1 - part) * taper : 1 - part * taper;
    const double length = smaller * (p_.leaf_scale + p_.leaf_scale_v * random_sign(key, Draw::leaf_scale));
    if (!(length > 0)) return;
    out_.leaf_branch.push_back(c.branch);
    out_.leaf_at.push_back(c.at);
    out_.leaf_position.push_back(y_up(c.position));
    out_.leaf_rotation.push_back((about(Vec3::UnitX(), -std::numbers::pi / 2) * blade).normalized());
    out_.leaf_length.push_back(length);
    out_.leaf_width.push_back(length * p_.leaf_scale_x);
    out_.leaf_kind.push_back(0);
}

} // namespace

void grow_sapling(const GrowthParameters& p, std::uint64_t seed, const Items& items, Splines& out) {
    SaplingGrower(p, out).run(seed, items);
}

} // namespace bough
