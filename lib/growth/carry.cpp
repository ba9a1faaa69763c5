#include "carry.h"
#include "../model/body_shape.h"
#include "../model/polyline.h"
#include "bark.h"
#include "curves.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {
namespace {

using std::numbers::pi;

constexpr double safety = 4; // against toppling

struct HungLoad {
    double at;         // fraction of the bearing branch's arc length
    double mass;       // [kg]
    Vec3 first_moment; // [kg m] about the world's origin
    double radius;     // [m] of the branch that begins here, 0 for leaves and fruit
};

// One branch while it is gone through from its tip.
class Carrier {
public:
    Carrier(Splines& s, const Material& wood, double most_sag, std::size_t b);
    void bear(std::vector<HungLoad>& loads);
    HungLoad whole() const { return {s_.parent_at[branch_], mass_, moment_, s_.radius[first_]}; }

private:
    void add(const HungLoad& load);
    void add_piece(std::size_t k);
    void raise(std::size_t k);

    Splines& s_;
    const Material& wood_;
    const double most_sag_;
    const std::size_t branch_, first_, last_;
    std::vector<double> arc_;
    double mass_ = 0, floor_ = 0;
    Vec3 moment_ = Vec3::Zero();
};

Carrier::Carrier(Splines& s, const Material& wood, double most_sag, std::size_t b)
    : s_(s), wood_(wood), most_sag_(most_sag), branch_(b), first_(std::size_t(s.first_point[b])),
      last_(std::size_t(s.first_point[b + 1]) - 1), arc_(arc_lengths(points_of(s, b))) {}

void Carrier::add(const HungLoad& load) {
    mass_ += load.mass;
    moment_ += load.first_moment;
}

// The wood between point k and the next one out.
void Carrier::add_piece(std::size_t k) {
    if (k == last_) return;
    const Vec3 along = s_.point[k + 1] - s_.point[k];
    const double length = along.norm();
    if (!(length > 0)) return;
    const MassProperties piece = frustum(length, s_.radius[k], s_.radius[k + 1], wood_.density);
    add({0, piece.mass, piece.mass * (s_.point[k] + along / length * piece.com.z()), 0});
}

void Carrier::raise(std::size_t k) {
    const double length = arc_.back();
    if (!(length > 0)) return;
    const Vec3 chord = s_.point[std::min(k + 1, last_)] - s_.point[k > first_ ? k - 1 : k];
    const Vec3 tangent = chord.norm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitY());
    const Vec3 arm = mass_ > 0 ? Vec3(moment_ / mass_ - s_.point[k]) : Vec3(Vec3::Zero());
    const double weight = growing_gravity * mass_;
    const Vec3 torque = weight * arm.cross(Vec3::UnitY());
    const double along = torque.dot(tangent);
    const double E = wood_.youngs_modulus, twice_G = 2 * wood_.shear_modulus;
    const double sag = std::hypot((torque - along * tangent).norm() / E, along / twice_G) / most_sag_;
    // What the load, tilting over with the wood that bears it, takes from its stiffness.
    const double topples = std::max(0.0, arm.y()) / E;
    const double rolls = std::max(0.0, arm.y() - arm.dot(tangent) * tangent.y()) / twice_G;
    const double section = length * std::max(sag, safety * weight * std::max(topples, rolls));
    const double needed = std::max(std::pow(4 * section / pi, 0.25), floor_);
    if (needed > s_.radius[k]) {
        s_.radius[k] = needed;
        floor_ = needed;
    }
}

void Carrier::bear(std::vector<HungLoad>& loads) {
    std::sort(loads.begin(), loads.end(), [](const HungLoad& x, const HungLoad& y) { return x.at > y.at; });
    std::size_t next = 0;
    for (std::size_t k = last_ + 1; k-- > first_;) {
        // What hangs between two points is borne by both.
        const double inner = k > first_ && arc_.back() > 0 ? arc_[k - 1 - first_] / arc_.back() : -1;
        for (; next < loads.size() && loads[next].at > inner; ++next) {
            add(loads[next]);
            if (loads[next].radius > s_.radius[k]) floor_ = std::max(floor_, loads[next].radius);
        }
        const double outer_mass = mass_;
        const Vec3 outer_moment = moment_;
        // The piece out to the next point grows heavier with the radius here, by its square, which the fourth power soon
        // outgrows.
        for (double before = -1; before < s_.radius[k] * (1 - 1e-3);) {
            before = s_.radius[k];
            mass_ = outer_mass;
            moment_ = outer_moment;
            add_piece(k);
            raise(k);
        }
    }
}

// What has none has the least that segmentation would give it, and a weight with it.
void give_a_radius(Splines& s) {
    const std::vector<double> extent = tree_extents(s);
    for (std::size_t b = 0; b < s.branches(); ++b)
        for (std::int32_t k = s.first_point[b]; k + 1 < s.first_point[b + 1]; ++k)
            if (double& radius = s.radius[std::size_t(k)]; !(radius > 0)) radius = thin_radius * extent[b];
}

} // namespace

std::vector<HungItem> hung_items(const Splines& s, const Material& wood) {
    std::vector<HungItem> items;
    items.reserve(s.leaves() + s.fruits());
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const double thickness = s.is_petal(i) ? wood.petal_thickness : wood.leaf_thickness;
        const MassProperties leaf = leaf_prism(s.leaf_length[i], s.leaf_width[i], thickness, wood.leaf_density);
        items.push_back(
            {s.leaf_branch[i], s.leaf_at[i], leaf.mass, s.leaf_position[i] + s.leaf_rotation[i] * leaf.com});
    }
    for (std::size_t i = 0; i < s.fruits(); ++i)
        items.push_back({s.fruit_branch[i], s.fruit_at[i],
                         wood.fruit_density * 4 / 3 * pi * std::pow(s.fruit_radius[i], 3), s.fruit_center[i]});
    return items;
}

std::size_t thicken_to_carry(Splines& s, const Material& wood, double most_sag) {
    const std::vector<double> drawn = s.radius;
    give_a_radius(s);
    std::vector<std::vector<HungLoad>> loads(s.branches());
    for (const HungItem& item : hung_items(s, wood))
        loads[std::size_t(item.branch)].push_back({item.at, item.mass, item.mass * item.center, 0});
    for (std::size_t b = s.branches(); b-- > 0;) {
        Carrier carrier(s, wood, most_sag, b);
        carrier.bear(loads[b]);
        if (s.parent[b] >= 0) loads[std::size_t(s.parent[b])].push_back(carrier.whole());
        loads[b] = {};
    }
    seat_on_bark(s, drawn);
    std::size_t thicker = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        const auto from = std::ptrdiff_t(s.first_point[b]), to = std::ptrdiff_t(s.first_point[b + 1]);
        thicker += !std::equal(drawn.begin() + from, drawn.begin() + to, s.radius.begin() + from);
    }
    return thicker;
}

} // namespace bough
