#include "colonize.h"
#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace bough {
namespace {

constexpr double kMostRise = 1e7; // steps from the trunk's foot to the envelope's top

std::string text(double value) {
    char buffer[32];
    return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr);
}

// Written so that NaN fails.
void require(bool holds, const std::string& name, double value, const std::string& expected) {
    if (!holds) throw std::invalid_argument(name + ": is " + text(value) + ", expected " + expected);
}

void require_within(const std::string& name, double value, double least, double most) {
    require(value >= least && value <= most, name, value, text(least) + " to " + text(most));
}

} // namespace

ColonizeParameters with_defaults(const ColonizeParameters& given) {
    ColonizeParameters p = given;
    check_envelope(p.envelope);
    require(p.points >= 1 && p.points <= 20'000'000, "attractors", static_cast<double>(p.points), "1 to 2e7");
    const double space = volume(p.envelope);
    if (!(space > 0)) throw std::invalid_argument("envelope: encloses no volume, expected a closed mesh");
    const double s = std::cbrt(space / static_cast<double>(p.points));
    // A radius given alone moves the others' defaults where they would contradict it.
    if (p.kill == 0) {
        p.kill = 0.8 * s;
        if (p.step > 0) p.kill = std::max(p.kill, p.step);
        if (p.influence > 0) p.kill = std::min(p.kill, p.influence / 2);
    }
    if (p.influence == 0) p.influence = std::max(6 * s, 2 * p.kill);
    if (p.step == 0) p.step = p.kill / 2;
    if (p.leaf_length == 0) p.leaf_length = std::clamp(0.4 * s, 0.03, 0.3);
    if (p.leaf_width == 0) p.leaf_width = 0.55 * p.leaf_length;
    if (p.leafy == 0) p.leafy = 1.5 * s;
    if (p.leader < 0) p.leader = p.envelope.shape == EnvelopeShape::cone ? 0.8 : 0.25;
    require(p.step > 0 && p.step < 1e6, "step", p.step, "more than 0 m");
    const double height = upper_corner(p.envelope).y() - std::min(0.0, lower_corner(p.envelope).y());
    require(height / p.step <= kMostRise, "step", p.step,
            "at least 1e-7 of the height, " + text(height / kMostRise) + " m");
    require(p.kill >= p.step && p.kill < 1e6, "kill", p.kill, "at least the step, " + text(p.step) + " m");
    require(p.influence > p.kill && p.influence < 1e9, "influence", p.influence,
            "more than the kill distance, " + text(p.kill) + " m");
    for (int k = 0; k < 3; ++k) require_within("tropism", p.tropism[k], -100, 100);
    require_within("leader", p.leader, 0, 1);
    require(p.tip_radius >= 0 && p.tip_radius <= 10, "tip radius", p.tip_radius, "0 to 10 m");
    require_within("leaves", p.leaves, 0, 1e6);
    require(p.leaf_length > 0 && p.leaf_length <= 100, "leaf length", p.leaf_length, "more than 0 m, at most 100");
    require(p.leaf_width > 0 && p.leaf_width <= 100, "leaf width", p.leaf_width, "more than 0 m, at most 100");
    require_within("leaf angle", p.leaf_angle, -360, 360);
    require(p.leafy > 0 && p.leafy < 1e6, "leafy stretch", p.leafy, "more than 0 m");
    require_within("fruits", p.fruits, 0, 1e6);
    require(p.fruit_radius > 0 && p.fruit_radius <= 100, "fruit radius", p.fruit_radius, "more than 0 m, at most 100");
    return p;
}

Splines colonize(const ColonizeParameters& given, std::uint64_t seed, bool with_leaves, bool with_fruit,
                 ColonizeReport* report) {
    const ColonizeParameters p = with_defaults(given);
    const Colony colony = colonize_nodes(p, seed);
    if (report) *report = {p.points, colony.blocked, colony.out_of_reach};
    return colony_splines(colony, p, seed, with_leaves, with_fruit);
}

} // namespace bough
