#include "added_motion.h"
#include "../model/drawn_pose.h"
#include "air_load.h"
#include "wind.h"
#include "wind_field.h"
#include <algorithm>
#include <limits>
#include <numbers>

namespace bough {
namespace {

constexpr double swing = 2; // of an undamped oscillator under a load that comes at once, over its rest there

// Mean velocity of the cell under a place, and whether it swings.
struct Mean {
    Vec3 velocity;
    bool swings;
};
Mean mean_at(const Wind& wind, const Vec3& place) {
    if (!wind.grid) return {wind.velocity, false};
    const WindGrid& grid = *wind.grid;
    const std::size_t cell = cell_at(grid, place.x(), place.z());
    return {grid.velocity.empty() ? wind.velocity : of_cell(grid.velocity, cell), of_cell(grid.octaves, cell) > 0};
}

// turned: -1, 0, 1 of the swirl's largest angle.
Vec3 peak_wind(const Wind& wind, const Vec3& place, int turned) {
    const Mean mean = mean_at(wind, place);
    const double speed = mean.velocity.norm(), own = wind.velocity.norm();
    if (speed == 0) return Vec3::Zero();
    Vec3 v = mean.velocity * ((mean.swings ? 2 : 1) * wind.gust_factor + 3 * wind.turbulence * own / speed);
    if (wind.swirl && turned != 0) {
        double most = 0;
        for (const double angle : wind.swirl->angle) most = std::max(most, std::abs(angle));
        const double a = turned * most * std::numbers::pi / 180;
        v = swirled<double>(v, std::cos(a), std::sin(a));
    }
    return wind_factor(wind, place) * v;
}

// Of the loads on bodies: force, and moment about the world's origin; of plates also what they may feel about their own joint.
struct Loads {
    std::vector<Vec3> force, moment;
    std::vector<double> own;
    explicit Loads(std::size_t n) : force(n, Vec3::Zero()), moment(n, Vec3::Zero()), own(n, 0) {}
    void add(std::size_t i, const Vec3& at, const Vec3& f) {
        force[i] += f;
        moment[i] += at.cross(f);
    }
};

void add_wind(const Tree& tree, const DrawnPose& drawn, const Scene& scene, int turned, Loads& loads) {
    const LeafTerms<double> leaf = leaf_terms<double>(scene);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 at = drawn.x_w[i] + drawn.R_wb[i] * tree.com[i];
        const Vec3 u = peak_wind(*scene.wind, at, turned);
        const double drag = drag_area(tree, i, tree.kind[i], scene.air_density, plate_kappa(scene));
        const AirBody<double> body{tree.kind[i], drag, tree.mass[i], tree.com[i]};
        const AirPeak<double> peak = air_peak(body, leaf, drawn.R_wb[i], u);
        loads.add(i, at, peak.force);
        loads.own[i] = peak.own;
    }
}

// Angle of each joint under the loads on all it carries; `more`: further moments about the joint's axes, of either sign.
void raise_angles(const Tree& tree, const DrawnPose& drawn, double scale, Loads loads, const std::vector<Vec3>& more,
                  std::vector<double>& angle) {
    for (std::size_t i = tree.size_bodies(); i-- > 0;) {
        const Vec3 moment = drawn.R_wb[i].transpose() * (loads.moment[i] - drawn.x_w[i].cross(loads.force[i]));
        for (int k = 0; k < 3; ++k) {
            const double load = std::max(std::abs(moment[k]), k < 2 ? loads.own[i] : 0) + more[i][k];
            const double K = scale * tree.stiffness[i][k];
            if (load > 0) angle[i] = std::max(angle[i], K > 0 ? load / K : std::numeric_limits<double>::infinity());
        }
        if (tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        loads.force[p] += loads.force[i];
        loads.moment[p] += loads.moment[i];
    }
}

void add_pulls(const Tree& tree, const std::vector<TreeRange>& ranges, const DrawnPose& drawn, const Scene& scene,
               std::vector<Vec3>& more) {
    for (const Pull& pull : scene.pulls)
        for (const Selected& on : select(tree, ranges, pull.on)) {
            const Vec3 at = drawn.x_w[on.body] + drawn.R_wb[on.body] * on.point_b;
            for (auto i = std::int64_t(on.body); i >= 0; i = tree.parent[std::size_t(i)]) {
                const auto j = std::size_t(i);
                Vec3 most = Vec3::Zero();
                for (const Vec3& force : pull.force)
                    most = most.cwiseMax(
                        Vec3(drawn.R_wb[j].transpose() * Vec3(at - drawn.x_w[j]).cross(force)).cwiseAbs());
                more[j] += most;
            }
        }
}

// What is held pushes back as hard as it has to, and on the joints between it and the ground alone.
void keep_attached(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene,
                   std::vector<double>& motion) {
    const auto keep = [&](const Selector& end) {
        for (const Selected& on : select(tree, ranges, end))
            for (auto i = std::int64_t(on.body); i >= 0; i = tree.parent[std::size_t(i)])
                motion[std::size_t(i)] = std::numeric_limits<double>::infinity();
    };
    for (const Attachment& held : scene.attachments) {
        keep(held.on);
        if (held.with) keep(*held.with);
    }
}

} // namespace

std::vector<double> composite_reach(const Tree& tree) {
    std::vector<double> reach(tree.size_bodies());
    for (std::size_t i = reach.size(); i-- > 0;) {
        reach[i] = std::max(reach[i], tree.size[i][0] + (tree.kind[i] == Kind::fruit ? tree.size[i][1] : 0));
        if (tree.parent[i] < 0) continue;
        double& below = reach[std::size_t(tree.parent[i])];
        below = std::max(below, tree.joint_position[i].norm() + reach[i]);
    }
    return reach;
}

std::string no_estimate(const Scene& scene) {
    for (const Attachment& held : scene.attachments)
        if (!held.time.empty()) return "its estimate knows nothing of /attachments whose targets move";
    for (const Pull& pull : scene.pulls)
        if (pull.in_body) return "its estimate knows nothing of /pulls that turn with their bodies";
    if (!scene.root_motion.empty()) return "its estimate knows nothing of what /root_motion does";
    const bool sags = scene.pose != Pose::drawn && !scene.gravity.isZero();
    const bool blows = scene.wind && scene.air_density > 0;
    if (!blows && scene.pulls.empty() && !sags)
        return "nothing moves the tree, so there is nothing to estimate: name a wind or pulls";
    return {};
}

std::vector<double> added_motion(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene) {
    const DrawnPose drawn = drawn_pose(tree);
    std::vector<Vec3> more(tree.size_bodies(), Vec3::Zero());
    add_pulls(tree, ranges, drawn, scene, more);
    std::vector<double> motion(tree.size_bodies(), 0);
    const bool swirls = scene.wind && scene.wind->swirl;
    for (int turned = swirls ? -1 : 0; turned <= (swirls ? 1 : 0); ++turned) {
        Loads loads(tree.size_bodies());
        if (scene.wind) add_wind(tree, drawn, scene, turned, loads);
        const double weight = scene.pose == Pose::drawn ? 0 : scene.pose == Pose::rest ? 1 : 1 / swing;
        for (std::size_t i = 0; weight > 0 && i < tree.size_bodies(); ++i)
            loads.add(i, drawn.x_w[i] + drawn.R_wb[i] * tree.com[i], weight * tree.mass[i] * scene.gravity);
        raise_angles(tree, drawn, scene.stiffness_scale, std::move(loads), more, motion);
    }
    const std::vector<double> reach = composite_reach(tree);
    for (std::size_t i = 0; i < motion.size(); ++i) motion[i] *= swing * reach[i];
    keep_attached(tree, ranges, scene, motion);
    return motion;
}

} // namespace bough
