#include "sapling_family.h"
#include "turn.h"
#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace bough {

namespace {

double declination_of(const Vec3& direction) {
    return std::acos(std::clamp(direction.z(), -1.0, 1.0));
}

// The trunk keeps its x where it is as far as it leans, so that it does not roll about the vertical.
Quat trunk_frame(const Vec3& d) {
    const double y = std::atan2(d.x(), d.z());
    const Vec3 back = about_y(-y) * d;
    return about_y(y) * about_x(-std::atan2(back.y(), back.z()));
}

// Of the stem at the start of its segment k; the first is 0.
double along(const LevelParameters& l, int k) {
    return l.curve_res > 1 ? double(k) / (l.curve_res - 1) : 1;
}

// How many parts split off a piece at the start of segment k >= 1: `count` of them with probability `chance`.
struct Splitting {
    double count, chance;
};

Splitting splitting(const GrowthParameters& p, int level, int k, bool split_last, double longer) {
    const LevelParameters& l = p.level[std::size_t(level)];
    const bool trunk = level == 0;
    double chance = l.seg_splits;
    if (trunk) chance = std::max(0.0, (2 * p.sapling.split_bias * (along(l, k) - 0.5) + 1) * chance);
    chance = split_last ? chance * chance : 1.33 * chance;
    const double low = (l.curve_res - 1) * p.sapling.split_height;
    if (trunk && k != 1 && k < low) return {0, 0};
    if (trunk && k == 1) return {std::floor(l.base_splits), 1};
    if (trunk && k == static_cast<int>(low) + 1 && chance > 0) return {1, 1};
    if (!trunk && p.sapling.split_by_length) chance *= longer;
    return {1, chance};
}

class Family {
public:
    Family(const GrowthParameters& p, const SaplingStem& stem)
        : p_(p), s_(p.sapling), l_(p.level[std::size_t(stem.level)]), stem_(stem), trunk_(stem.level == 0) {}
    std::vector<SaplingPiece> run();

private:
    int splits(const SaplingPiece&, int k) const;
    void grow(std::size_t piece, int k);
    Vec3 lifted(const Vec3& direction) const;
    Quat frame_of(const SaplingPiece&) const;
    void extend(SaplingPiece&, const Vec3& direction, double length) const;
    double length_factor(RandomKey key, std::uint64_t index) const {
        return 1 + l_.length_v / l_.length * random_sign(key, Draw::length, index);
    }

    const GrowthParameters& p_;
    const SaplingRules& s_;
    const LevelParameters& l_;
    const SaplingStem& stem_;
    bool trunk_;
    std::vector<SaplingPiece> pieces_;
};

std::vector<SaplingPiece> Family::run() {
    SaplingPiece first;
    first.key = stem_.key;
    first.point = {stem_.position};
    first.radius = {stem_.radius_start * (trunk_ ? s_.root_flare : 1)};
    first.heading = stem_.direction;
    first.segment_length = stem_.segment_length * length_factor(stem_.key, 0);
    first.radius_start = stem_.radius_start;
    first.radius_end = stem_.radius_end;
    first.curve = l_.curve / l_.curve_res * degree;
    first.turned = 2 * std::numbers::pi * random_unit(stem_.key, Draw::rotate);
    pieces_ = {first};
    for (int k = 0; k < l_.curve_res; ++k) {
        const std::size_t count = pieces_.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (k == static_cast<int>(l_.curve_res / 2.0 + 0.5))
                pieces_[i].curve += 2 * l_.curve_back / l_.curve_res * degree;
            grow(i, k);
            if (double(pieces_.size()) > kMostPieces)
                throw std::invalid_argument("level[" + std::to_string(stem_.level) +
                                            "].seg_splits: a stem splits into more than 1e6 over its curve_res, "
                                            "expected fewer");
        }
    }
    return std::move(pieces_);
}

int Family::splits(const SaplingPiece& piece, int k) const {
    if (k == 0) return 0;
    double longest = stem_.scale;
    for (int n = 0; n <= stem_.level; ++n) longest *= p_.level[std::size_t(n)].length;
    const Splitting s =
        splitting(p_, stem_.level, k, piece.split_last == 1, piece.segment_length * l_.curve_res / longest);
    return random_unit(piece.key, Draw::splits, std::uint64_t(k)) < s.chance ? static_cast<int>(s.count) : 0;
}

// Turned up (or down) by attraction, never past the vertical.
Vec3 Family::lifted(const Vec3& direction) const {
    const double down = declination_of(direction);
    double up = l_.attraction_up * down * std::sin(down) / l_.curve_res;
    up = std::clamp(up, down - std::numbers::pi, down);
    return (about(level_frame(direction) * Vec3::UnitX(), -up) * direction).normalized();
}

Quat Family::frame_of(const SaplingPiece& piece) const {
    Vec3 d = piece.heading;
    const Vec3& at = piece.point.back();
    const double k = along(l_, piece.made), out = p_.sapling.attract_out[std::size_t(stem_.level)];
    const double level = std::hypot(d.x(), d.y());
    if (!trunk_ && k > 0 && out > 0 && level > 1e-9 && std::hypot(at.x(), at.y()) > 1e-9) {
        // The mean of the two headings as Sapling takes it, of unit vectors.
        const Vec3 away = Vec3(at.x(), at.y(), 0).normalized(), now = Vec3(d.x(), d.y(), 0) / level;
        const Vec3 mean = now + (away - now) * k * out;
        if (mean.norm() > 1e-9) d = level * mean.normalized() + Vec3(0, 0, d.z());
    }
    return trunk_ ? trunk_frame(d) : level_frame(d);
}

void Family::extend(SaplingPiece& piece, const Vec3& direction, double length) const {
    piece.heading = direction;
    piece.point.push_back(piece.point.back() + direction * length);
    ++piece.made;
    const double part = double(piece.made) / l_.curve_res;
    piece.radius.push_back(piece.radius_start * (1 - part) + piece.radius_end * part);
}

void Family::grow(std::size_t number, int k) {
    SaplingPiece piece = std::move(pieces_[number]);
    const auto draw = static_cast<std::uint64_t>(k);
    const bool straight = trunk_ && along(l_, k) <= s_.split_height; // the trunk's foot does not curve
    const double vary = l_.curve_v / l_.curve_res * degree * along(l_, k) * piece.sign;
    const double curve = (straight ? 0 : piece.curve) + vary * random_unit(piece.key, Draw::curve, draw);
    const double aside = vary * random_unit(piece.key, Draw::curve_axis, draw);
    piece.sign = -piece.sign;
    const Quat frame = frame_of(piece);
    const double lean = trunk_ ? declination_of(piece.heading) / std::numbers::pi : 0;
    const double shorter = std::max(0.1, 1 - lean * lean * s_.taper_crown * 30);
    const int count = splits(piece, k);
    if (count == 0) {
        piece.split_last = 0;
        extend(piece, lifted(frame * about_y(aside) * about_x(curve) * Vec3::UnitZ()), piece.segment_length * shorter);
        pieces_[number] = std::move(piece);
        return;
    }
    const auto side = [&](Draw name) {
        const double angle = l_.split_angle + l_.split_angle_v * random_sign(piece.key, Draw::split_angle,
                                                                             2 * draw + (name == Draw::split_sign));
        return (random_unit(piece.key, name, draw) < 0.5 ? -1 : 1) * angle * degree;
    };
    double angle = side(Draw::split_sign);
    if (!trunk_) {
        const double flatter = std::max(0.0, 1 - declination_of(frame * Vec3::UnitZ()) / (std::numbers::pi / 2));
        angle *= flatter * 0.67 + 0.33;
    }
    const double spread = side(Draw::split_spread);
    const LevelParameters& trunk = p_.level[0];
    piece.turned += (trunk.rotate + trunk.rotate_v * random_sign(piece.key, Draw::rotate, draw + 1)) * degree;
    // Turns of a part that leans by `lean_by`: of the trunk's about the vertical, of others' to the side.
    const auto heading = [&](double lean_by, double around, double apart) {
        const Vec3 d = about_y(aside) * about_x(lean_by + curve) * Vec3::UnitZ();
        return lifted(frame * (trunk_ ? Vec3(about_z(around) * about_z(piece.turned) * d) : Vec3(about_y(apart) * d)));
    };
    for (int i = 0; i < count; ++i) {
        const double around = std::numbers::pi - 2 * std::numbers::pi / (count + 1) * (i + 1);
        SaplingPiece part;
        part.key = random_key(piece.key, Draw::clone, draw << 32 | std::uint64_t(i));
        const double factor = length_factor(part.key, 0), thick = std::min(factor * shorter, 1.0);
        part.parent = int(number);
        part.from = piece.point.size() - 1;
        part.point = {piece.point.back()};
        part.radius = {piece.radius.back() * thick};
        part.offset = piece.offset + piece.segment_length * double(piece.point.size() - 1);
        part.segment_length = stem_.segment_length * factor;
        part.radius_start = piece.radius_start * thick;
        part.radius_end = piece.radius_end * thick;
        part.curve = piece.curve;
        part.made = piece.made;
        part.split_last = 1;
        part.turned = piece.turned + std::numbers::pi;
        extend(part, heading(angle, around, spread), part.segment_length * shorter);
        pieces_.push_back(std::move(part));
    }
    piece.split_last = 1;
    extend(piece, heading(-angle, 0, -spread), piece.segment_length * shorter);
    pieces_[number] = std::move(piece);
}

} // namespace

Quat level_frame(const Vec3& direction) {
    Vec3 x = Vec3::UnitZ().cross(direction);
    x = x.norm() < 1e-9 ? Vec3::UnitX() : Vec3(x.normalized());
    Mat3 axes;
    axes << x, direction.cross(x), direction;
    return Quat(axes).normalized();
}

double sapling_pieces(const GrowthParameters& p, int level) {
    // Those that did not split a segment ago, and those that did.
    double whole = 1, parts = 0;
    for (int k = 1; k < p.level[std::size_t(level)].curve_res; ++k) {
        double stay = 0, split = 0;
        for (const bool last : {false, true}) {
            const auto [count, chance] = splitting(p, level, k, last, 1);
            const double now = last ? parts : whole, often = count > 0 ? std::min(chance, 1.0) : 0;
            stay += (1 - often) * now;
            split += often * (1 + count) * now;
        }
        whole = stay, parts = split;
        if (whole + parts > kMostPieces) return std::numeric_limits<double>::infinity();
    }
    return whole + parts;
}

std::vector<SaplingPiece> sapling_family(const GrowthParameters& p, const SaplingStem& stem) {
    return Family(p, stem).run();
}

} // namespace bough
