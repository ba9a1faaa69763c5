#include "colonize.h"
#include "point_grid.h"
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

enum class CloudDraw : std::uint8_t { points };

constexpr double kNearer = 0.25; // of a step, that a child must come nearer to a point
constexpr int kLevels = 256;     // at which the envelope is looked for above the foot of the trunk

class Colonizer {
public:
    Colonizer(const ColonizeParameters& p, Colony& colony)
        : p_(p), c_(colony), grid_(colony.point, std::max(p.kill, p.influence / 4)), nearest_(colony.point.size(), -1),
          square_(colony.point.size(), std::numeric_limits<double>::infinity()), waits_(colony.point.size(), 0),
          next_(colony.point.size(), -1), alive_(colony.point.size()), radius_(p.influence) {
        for (std::size_t i = 0; i < alive_.size(); ++i) alive_[i] = static_cast<std::int32_t>(i);
    }
    void run();

private:
    Vec3 entry() const;
    Vec3 risen(const Vec3&) const;
    void raise_trunk();
    void gather();
    void grow(std::int32_t node);
    void grow_straight(std::int32_t node);
    bool try_child(const Vec3& direction, std::int32_t node, bool nearer);
    void add(const Vec3&, std::int32_t parent);
    void notice(std::size_t node);

    const ColonizeParameters& p_;
    Colony& c_;
    PointGrid grid_;
    // Per attraction point: the node nearest to it that is within its influence, and the distance's square.
    std::vector<std::int32_t> nearest_;
    std::vector<double> square_;
    std::vector<std::uint8_t> waits_;            // blocked as long as its nearest node stays
    std::vector<std::int32_t> next_;             // the next point that pulls at the same node, -1: none
    std::vector<std::int32_t> alive_;            // points not reached, rising
    std::vector<std::int32_t> head_;             // per node: the first point that pulls at it
    std::vector<std::int32_t> pulled_, reached_; // nodes of this round; points to be taken out
    bool felt_ = false;                          // a point has come within the influence of a node
    // [m] in which a new node looks for points: none left is farther from its nearest node, or influence
    double radius_;
};

void Colonizer::add(const Vec3& at, std::int32_t parent) {
    if (c_.node.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw std::invalid_argument("step: makes more than 2^31 nodes, expected a longer one");
    c_.node.push_back(at);
    c_.parent.push_back(parent);
    head_.push_back(-1);
}

// Tells the points near a new node of it: it is the nearest, or has reached them.
void Colonizer::notice(std::size_t node) {
    const double kill = p_.kill * p_.kill;
    reached_.clear();
    const double most = radius_ * radius_;
    grid_.each_nearer(c_.node[node], radius_, [&](std::int32_t point, double square) {
        const auto i = static_cast<std::size_t>(point);
        if (square <= kill)
            reached_.push_back(point);
        else if (square < square_[i] && square <= most) {
            square_[i] = square;
            nearest_[i] = static_cast<std::int32_t>(node);
            waits_[i] = 0;
            felt_ = true;
        }
        return square_[i];
    });
    for (const std::int32_t point : reached_) {
        grid_.remove(point);
        c_.reached[static_cast<std::size_t>(point)] = 1;
        felt_ = true;
    }
}

// The lowest point of the envelope above the foot of the trunk.
Vec3 Colonizer::entry() const {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : c_.point) mean += p / static_cast<double>(c_.point.size());
    const double bottom = lower_corner(p_.envelope).y(), top = upper_corner(p_.envelope).y();
    const auto lowest = [&](double x, double z, double high) -> std::optional<Vec3> {
        for (int i = 0; i <= kLevels; ++i) {
            const double y = i == kLevels ? high : bottom + (high - bottom) * i / kLevels;
            if (!contains(p_.envelope, {x, y, z})) continue;
            if (i == 0) return Vec3(x, y, z);
            double outside = bottom + (high - bottom) * (i - 1) / kLevels, inside = y;
            for (int k = 0; k < 40; ++k) {
                const double middle = (outside + inside) / 2;
                (contains(p_.envelope, {x, middle, z}) ? inside : outside) = middle;
            }
            return Vec3(x, inside, z);
        }
        return {};
    };
    if (const auto found = lowest(mean.x(), mean.z(), top)) return *found;
    const auto aside = [&](const Vec3& p) { return std::hypot(p.x() - mean.x(), p.z() - mean.z()); };
    const Vec3 near = *std::min_element(c_.point.begin(), c_.point.end(),
                                        [&](const Vec3& a, const Vec3& b) { return aside(a) < aside(b); });
    return lowest(near.x(), near.z(), near.y()).value_or(near);
}

// A step up from a point of the envelope, or as far as the envelope goes.
Vec3 Colonizer::risen(const Vec3& from) const {
    const Vec3 up = from + Vec3(0, p_.step, 0);
    if (contains(p_.envelope, up)) return up;
    double inside = from.y(), outside = up.y();
    for (int k = 0; k < 40; ++k) {
        const double middle = (outside + inside) / 2;
        (contains(p_.envelope, {from.x(), middle, from.z()}) ? inside : outside) = middle;
    }
    if (!(inside > from.y())) throw std::invalid_argument("step: the trunk cannot rise, expected a shorter one");
    return {from.x(), inside, from.z()};
}

void Colonizer::raise_trunk() {
    const Vec3 in = entry();
    const double bottom = lower_corner(p_.envelope).y(), top = upper_corner(p_.envelope).y();
    const double foot = std::min(0.0, bottom);
    const auto below = static_cast<std::int32_t>(std::ceil((in.y() - foot) / p_.step));
    for (std::int32_t i = 0; i <= below; ++i)
        add({in.x(), i == below ? in.y() : foot + (in.y() - foot) * i / below, in.z()}, i - 1);
    c_.crown = below;
    notice(c_.node.size() - 1);
    if (in.y() - foot < p_.step / 2) { // else a tree whose points are all near the foot would be one node, no branch
        add(risen(in), below);
        notice(c_.node.size() - 1);
    }
    const double leader = bottom + p_.leader * (top - bottom);
    while (true) {
        const Vec3 up = c_.node.back() + Vec3(0, p_.step, 0);
        if (up.y() > leader && felt_) return;
        if (!contains(p_.envelope, up)) {
            if (felt_) return;
            throw std::invalid_argument(
                "influence: no attraction point comes within it of the trunk, expected a longer "
                "one, or more points");
        }
        add(up, static_cast<std::int32_t>(c_.node.size()) - 1);
        notice(c_.node.size() - 1);
    }
}

// Which points pull at which nodes, in rising order of both.
void Colonizer::gather() {
    pulled_.clear();
    std::size_t kept = 0;
    double most = 0;
    for (const std::int32_t point : alive_)
        if (!c_.reached[static_cast<std::size_t>(point)]) alive_[kept++] = point;
    alive_.resize(kept);
    for (std::size_t k = kept; k-- > 0;) {
        const auto i = static_cast<std::size_t>(alive_[k]);
        most = std::max(most, square_[i]);
        if (nearest_[i] < 0 || waits_[i]) continue;
        std::int32_t& head = head_[static_cast<std::size_t>(nearest_[i])];
        if (head < 0) pulled_.push_back(nearest_[i]);
        next_[i] = head;
        head = alive_[k];
    }
    radius_ = std::min(p_.influence, std::sqrt(most));
    std::sort(pulled_.begin(), pulled_.end());
}

// Adds the child if it may stand there and, where asked for, comes nearer to one of the points that pull.
bool Colonizer::try_child(const Vec3& direction, std::int32_t node, bool nearer) {
    const Vec3 &from = c_.node[static_cast<std::size_t>(node)], child = from + p_.step * direction;
    if (!contains(p_.envelope, child) || !contains(p_.envelope, (from + child) / 2)) return false;
    for (std::int32_t i = head_[static_cast<std::size_t>(node)]; nearer && i >= 0;
         i = next_[static_cast<std::size_t>(i)])
        if ((c_.point[static_cast<std::size_t>(i)] - child).norm() <=
            std::sqrt(square_[static_cast<std::size_t>(i)]) - kNearer * p_.step)
            nearer = false;
    if (nearer) return false;
    add(child, node);
    return true;
}

// Toward one point alone, the nearest that can be; those it cannot grow to wait.
void Colonizer::grow_straight(std::int32_t node) {
    std::vector<std::int32_t> points;
    for (std::int32_t i = head_[static_cast<std::size_t>(node)]; i >= 0; i = next_[static_cast<std::size_t>(i)])
        points.push_back(i);
    std::stable_sort(points.begin(), points.end(), [&](std::int32_t a, std::int32_t b) {
        return square_[static_cast<std::size_t>(a)] < square_[static_cast<std::size_t>(b)];
    });
    for (const std::int32_t i : points) {
        const Vec3 way = c_.point[static_cast<std::size_t>(i)] - c_.node[static_cast<std::size_t>(node)];
        if (try_child(way.normalized(), node, false)) return;
        waits_[static_cast<std::size_t>(i)] = 1;
    }
}

void Colonizer::grow(std::int32_t node) {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t i = head_[static_cast<std::size_t>(node)]; i >= 0; i = next_[static_cast<std::size_t>(i)])
        sum += (c_.point[static_cast<std::size_t>(i)] - c_.node[static_cast<std::size_t>(node)]).normalized();
    const double length = sum.norm();
    if (length > 1e-9) {
        const Vec3 direction = sum / length + p_.tropism;
        const double size = direction.norm();
        if (size > 1e-9 && try_child(direction / size, node, true)) return;
    }
    grow_straight(node);
}

void Colonizer::run() {
    raise_trunk();
    while (true) {
        gather();
        if (pulled_.empty()) break;
        const std::size_t before = c_.node.size();
        for (const std::int32_t node : pulled_) grow(node);
        for (const std::int32_t node : pulled_) head_[static_cast<std::size_t>(node)] = -1;
        for (std::size_t node = before; node < c_.node.size(); ++node) notice(node);
    }
    for (const std::int32_t point : alive_)
        ++(nearest_[static_cast<std::size_t>(point)] < 0 ? c_.out_of_reach : c_.blocked);
}

} // namespace

Colony colonize_nodes(const ColonizeParameters& p, std::uint64_t seed) {
    Colony colony;
    const RandomKey key = random_key(RandomKey{0}, CloudDraw::points, seed);
    for (std::int64_t i = 0; i < p.points; ++i)
        colony.point.push_back(point_inside(p.envelope, key, static_cast<std::uint64_t>(i)));
    colony.reached.assign(colony.point.size(), 0);
    Colonizer(p, colony).run();
    return colony;
}

} // namespace bough
