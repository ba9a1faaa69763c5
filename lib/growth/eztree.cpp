#include "eztree.h"
#include "eztree_check.h"
#include "eztree_rotation.h"
#include "turn.h"
#include <algorithm>
#include <deque>
#include <numbers>

namespace bough {
namespace {

constexpr double kLastRadius = 0.001; // [unit] radius at the end of the last branches

// George Marsaglia's multiply with carry, two of 16 bits, in the 32-bit signed arithmetic that ez-tree does it in.
class Draws {
public:
    // Only the seed's lower 32 bits count.
    explicit Draws(std::int64_t seed)
        : w_(static_cast<std::int32_t>(123456789 + static_cast<std::uint32_t>(seed))),
          z_(static_cast<std::int32_t>(987654321 - static_cast<std::uint32_t>(seed))) {}
    double unit() {
        z_ = static_cast<std::int32_t>(36969 * std::int64_t{z_ & 65535} + (z_ >> 16));
        w_ = static_cast<std::int32_t>(18000 * std::int64_t{w_ & 65535} + (w_ >> 16));
        const std::uint32_t bits = (static_cast<std::uint32_t>(z_) << 16) + static_cast<std::uint32_t>(w_ & 65535);
        return bits / 4294967296.0;
    }
    double between(double low, double high) { return (high - low) * unit() + low; }

private:
    std::int32_t w_, z_;
};

struct Waiting {
    std::int32_t parent;
    double parent_at;
    Vec3 origin, orientation;
    double length, radius;
    int level, sections;
};

struct Section {
    Vec3 origin, orientation;
    double radius;
};

Vec3 up(const Vec3& orientation) {
    return three::from_euler(orientation) * Vec3::UnitY();
}

// Of the bars that lie nearest in the trellis' plane.
Vec3 nearest_on(const EzTreeParameters::Trellis& t, const Vec3& p) {
    const double x0 = t.position.x() - t.width / 2, x1 = t.position.x() + t.width / 2;
    const double y0 = t.position.y(), y1 = y0 + t.height;
    const double x = std::clamp(p.x(), x0, x1), y = std::clamp(p.y(), y0, y1);
    const auto bar = [&](double at, double low, double high) {
        return std::clamp(std::floor((at - low) / t.spacing + 0.5) * t.spacing + low, low, high);
    };
    const Vec3 across(x, bar(y, y0, y1), t.position.z()), along(bar(x, x0, x1), y, t.position.z());
    return (across - p).norm() < (along - p).norm() ? across : along;
}

class EzGrower {
public:
    EzGrower(const EzTreeParameters& p, bool with_leaves) : p_(p), draws_(p.seed), with_leaves_(with_leaves) {}
    Splines run();

private:
    void grow(const Waiting&);
    double radius_of(const Waiting&, int section) const;
    Vec3 turned(const Waiting&, const Section&, const Vec3& end);
    Section between(double at, double& radius_share) const;
    Vec3 aside(const Section&, double radial, double angle) const;
    void bear(const Waiting&, std::int32_t branch);
    void add_leaves(std::int32_t branch);
    void add_leaf(std::int32_t branch, double at, const Vec3& origin, const Vec3& orientation);

    const EzTreeParameters& p_;
    Draws draws_;
    bool with_leaves_;
    std::deque<Waiting> queue_;
    std::vector<Section> section_; // of the branch that grows
    Splines out_;
};

Splines EzGrower::run() {
    out_.name = p_.name;
    out_.first_point.push_back(0);
    queue_.push_back({-1, 0, Vec3::Zero(), Vec3::Zero(), p_.length[0], p_.radius[0], 0, p_.sections[0]});
    while (!queue_.empty()) {
        const Waiting branch = queue_.front();
        queue_.pop_front();
        grow(branch);
    }
    for (Vec3& p : out_.point) p *= p_.unit;
    for (double& r : out_.radius) r *= p_.unit;
    for (Vec3& p : out_.leaf_position) p *= p_.unit;
    return std::move(out_);
}

double EzGrower::radius_of(const Waiting& b, int section) const {
    if (section == b.sections && b.level == p_.levels) return kLastRadius;
    const double along = static_cast<double>(section) / b.sections;
    return b.radius * (1 - (p_.evergreen ? 1 : p_.taper[static_cast<std::size_t>(b.level)]) * along);
}

// The orientation after a section that ends at `end`.
Vec3 EzGrower::turned(const Waiting& b, const Section& s, const Vec3& end) {
    const auto n = static_cast<std::size_t>(b.level);
    const double gnarl = std::max(1.0, 1 / std::sqrt(s.radius)) * p_.gnarliness[n];
    Vec3 orientation = s.orientation;
    orientation.x() += draws_.between(-gnarl, gnarl);
    orientation.z() += draws_.between(-gnarl, gnarl);
    const Quat twist(std::cos(p_.twist[n] / 2), 0, std::sin(p_.twist[n] / 2), 0);
    Quat q = three::from_euler(orientation) * twist;
    q = three::rotate_towards(q, three::y_to(p_.force_direction), p_.force_strength / s.radius);
    if (const EzTreeParameters::Trellis& t = p_.trellis; t.enabled) {
        const Vec3 way = nearest_on(t, end) - end;
        const double distance = way.norm();
        if (distance <= t.most_distance && distance >= 0.001) {
            const double strength = t.strength * (1 - std::pow(distance / t.most_distance, t.falloff)) / s.radius;
            q = three::rotate_towards(q, three::y_to(way / distance), strength);
        }
    }
    return three::to_euler(q);
}

void EzGrower::grow(const Waiting& b) {
    const auto branch = static_cast<std::int32_t>(out_.branches());
    out_.parent.push_back(b.parent);
    out_.parent_at.push_back(b.parent_at);
    out_.level.push_back(b.level);
    section_.clear();
    Section now{b.origin, b.orientation, 0};
    for (int i = 0; i <= b.sections; ++i) {
        now.radius = radius_of(b, i);
        section_.push_back(now);
        out_.point.push_back(now.origin);
        out_.radius.push_back(now.radius);
        if (i == b.sections) {
            draws_.unit(), draws_.unit(); // of the turn that nothing comes after
            break;
        }
        const Vec3 end = now.origin + b.length / b.sections * up(now.orientation);
        now.orientation = turned(b, now, end);
        now.origin = end;
    }
    out_.first_point.push_back(static_cast<std::int32_t>(out_.points()));
    const Section& last = section_.back();
    if (b.level == p_.levels) {
        if (!p_.evergreen) add_leaf(branch, 1, last.origin, last.orientation);
        add_leaves(branch);
        return;
    }
    if (!p_.evergreen)
        queue_.push_back({branch, 1, last.origin, last.orientation, p_.length[static_cast<std::size_t>(b.level) + 1],
                          last.radius, b.level + 1, b.sections});
    bear(b, branch);
}

// Where a child or leaf stands: between two sections' starts; the orientation runs the other way, as in ez-tree.
Section EzGrower::between(double at, double& share) const {
    const std::size_t pieces = section_.size() - 1;
    const auto index = static_cast<std::size_t>(std::floor(at * static_cast<double>(pieces)));
    const Section &a = section_[index], &b = section_[std::min(index + 1, pieces)];
    const double count = static_cast<double>(pieces);
    share = (at - static_cast<double>(index) / count) / (1 / count);
    const Quat q = three::slerp(three::from_euler(b.orientation), three::from_euler(a.orientation), share);
    return {a.origin + share * (b.origin - a.origin), three::to_euler(q), (1 - share) * a.radius + share * b.radius};
}

Vec3 EzGrower::aside(const Section& s, double radial, double angle) const {
    const Quat lean(std::cos(angle * degree / 2), std::sin(angle * degree / 2), 0, 0);
    const Quat round(std::cos(radial / 2), 0, std::sin(radial / 2), 0);
    return three::to_euler(three::from_euler(s.orientation) * (round * lean));
}

void EzGrower::bear(const Waiting& b, std::int32_t branch) {
    const auto n = static_cast<std::size_t>(b.level) + 1;
    const int count = p_.children[n - 1];
    const double offset = draws_.unit();
    for (int i = 0; i < count; ++i) {
        const double at = draws_.between(p_.start[n], 1);
        double share = 0;
        const Section place = between(at, share);
        const double radial = 2 * std::numbers::pi * (offset + static_cast<double>(i) / count);
        queue_.push_back({branch, std::clamp(at, 0.0, 1.0), place.origin, aside(place, radial, p_.angle[n]),
                          p_.length[n] * (p_.evergreen ? 1 - at : 1), p_.radius[n] * place.radius, b.level + 1,
                          p_.sections[n]});
    }
}

void EzGrower::add_leaves(std::int32_t branch) {
    const double offset = draws_.unit();
    for (int i = 0; i < p_.leaf_count; ++i) {
        const double at = draws_.between(p_.leaf_start, 1);
        double share = 0;
        const Section place = between(at, share);
        const double radial = 2 * std::numbers::pi * (offset + static_cast<double>(i) / p_.leaf_count);
        add_leaf(branch, std::clamp(at, 0.0, 1.0), place.origin, aside(place, radial, p_.leaf_angle));
    }
}

// ez-tree's square lies in its x-y plane, y along the leaf; ours has z along it and y as its normal.
void EzGrower::add_leaf(std::int32_t branch, double at, const Vec3& origin, const Vec3& orientation) {
    const double size = p_.leaf_size * (1 + draws_.between(-p_.leaf_size_variance, p_.leaf_size_variance));
    if (!with_leaves_) return;
    const Mat3 ez = three::from_euler(orientation).toRotationMatrix();
    Mat3 axes;
    axes << -ez.col(0), ez.col(2), ez.col(1);
    out_.leaf_branch.push_back(branch);
    out_.leaf_at.push_back(at);
    out_.leaf_position.push_back(origin);
    out_.leaf_rotation.push_back(Quat(axes).normalized());
    out_.leaf_length.push_back(size * p_.unit);
    out_.leaf_width.push_back(size * p_.unit);
}

} // namespace

std::array<std::int64_t, kEzLevels> eztree_branches(const EzTreeParameters& p) {
    std::array<std::int64_t, kEzLevels> count{1, 0, 0, 0};
    for (std::size_t n = 1; n <= static_cast<std::size_t>(p.levels); ++n)
        count[n] = count[n - 1] * (p.children[n - 1] + (p.evergreen ? 0 : 1));
    return count;
}

Splines grow_eztree(const EzTreeParameters& p, bool with_leaves) {
    check_eztree(p);
    return EzGrower(p, with_leaves).run();
}

} // namespace bough
