#include "loop.h"
#include "../base/shortest_text.h"
#include "../model/tips.h"
#include "any_run.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bough {
namespace {

std::string text_of(const char* format, double a, double b) {
    char text[200];
    return std::string(text, std::size_t(std::snprintf(text, sizeof text, format, a, b)));
}

LoopGap gap_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::size_t tips, LoopGap most = {}) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        double& largest = k < tips ? most.branches : most.others;
        largest = std::max(largest, (a[k] - b[k]).norm());
    }
    return most;
}

// The farthest end's distance from its root.
double height_of(const Tree& tree, const std::vector<std::size_t>& bodies, const std::vector<Vec3>& end) {
    std::vector<std::size_t> root(tree.size_bodies());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = tree.parent[i] < 0 ? i : root[std::size_t(tree.parent[i])];
    double height = 0;
    for (std::size_t k = 0; k < bodies.size(); ++k)
        height = std::max(height, (end[k] - tree.joint_position[root[bodies[k]]]).norm());
    return height;
}

// Rotation of each body in its parent's, or of a root in the world.
std::vector<Quat> in_parents(const Tree& tree, std::span<const Quat> world) {
    std::vector<Quat> own(world.begin(), world.end());
    for (std::size_t i = 0; i < own.size(); ++i)
        if (tree.parent[i] >= 0) own[i] = world[std::size_t(tree.parent[i])].conjugate() * world[i];
    return own;
}

constexpr std::int64_t most_frames = 1'000'000'000, most_of_periods = 1'000'000; // whose product can be counted

void require_frames(std::int64_t frames, const char* call) {
    if (frames < 2 || frames > most_frames)
        throw SceneError(std::string(call) + ": frames is " + std::to_string(frames) + ", expected 2 to " +
                         std::to_string(most_frames));
}

void check(const LoopOptions& o) {
    require_frames(o.frames, "close_loop");
    if (!(o.tolerance > 0) || !std::isfinite(o.tolerance))
        throw SceneError("close_loop: tolerance is " + shortest_text(o.tolerance) +
                         ", expected a share of the height above 0");
    if (o.periods && (*o.periods < 2 || *o.periods > most_of_periods))
        throw SceneError("close_loop: periods is " + std::to_string(*o.periods) + ", expected 2 to " +
                         std::to_string(most_of_periods) + ", as each is compared with the one before");
}

} // namespace

void make_periodic(double seconds, Scene& scene) {
    if (!(seconds > 0) || !std::isfinite(seconds))
        throw SceneError("the loop is " + shortest_text(seconds) + " s, expected more than 0");
    const std::pair<bool, const char*> passing[] = {{!scene.pulls.empty(), "/pulls"},
                                                    {!scene.attachments.empty(), "/attachments"},
                                                    {!scene.root_motion.empty(), "/root_motion"},
                                                    {!scene.balls.empty(), "/balls"},
                                                    {scene.fracture.has_value(), "/fracture"},
                                                    {!scene.walkers.empty(), "/walkers"}};
    for (const auto& [there, pointer] : passing)
        if (there)
            throw SceneError(std::string("not with the scene's ") + pointer + ", which passes and does not come back");
    if (!scene.wind) throw SceneError("the scene has no /wind, so that nothing would move in it");
    if (scene.wind->period) {
        const double turns = seconds / *scene.wind->period;
        if (std::round(turns) >= 1 && std::abs(turns - std::round(turns)) <= 1e-6 * turns) return;
        throw SceneError(
            text_of("the loop is %.10g s, but the scene's /wind/period is %.10g s, which does not go into it a whole "
                    "number of times; leave it out",
                    seconds, *scene.wind->period));
    }
    scene.wind->period = seconds;
}

std::int64_t most_periods(const LoopOptions& o) {
    return o.periods.value_or(o.blend ? 5 : 20);
}

LoopStart close_loop(Simulation& simulation, const LoopOptions& o, const ToFrame& to) {
    check(o);
    AnyRun& run = run_of(simulation);
    const Tree& tree = run.assembly().tree; // of what moves
    const std::int64_t n = o.frames, most = most_periods(o);
    LoopStart start;
    start.bodies = tip_bodies(tree);
    start.tips = start.bodies.size();
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] != Kind::branch) start.bodies.push_back(i);
    run.ends(start.bodies, start.end);
    start.height = height_of(tree, start.bodies, start.end);
    std::vector<std::int64_t> looks{1, n / 4, n / 2, 3 * n / 4, n};
    looks.erase(std::remove(looks.begin(), looks.end(), 0), looks.end());
    std::sort(looks.begin(), looks.end());
    looks.erase(std::unique(looks.begin(), looks.end()), looks.end());
    std::vector<std::vector<Vec3>> before(looks.size());
    while (!start.closed && start.periods < most) {
        start.gap = {};
        std::size_t next = 0;
        for (std::int64_t f = 1; f <= n; ++f) {
            to(simulation, start.periods * n + f);
            if (o.blend && f == n - blended_frames(n)) start.before.emplace(simulation.copy());
            if (f != looks[next]) continue;
            run.ends(start.bodies, start.end);
            if (start.periods > 0) start.gap = gap_of(start.end, before[next], start.tips, start.gap);
            before[next++] = start.end;
        }
        start.closed = ++start.periods > 1 && start.gap.largest() <= o.tolerance * start.height;
    }
    return start;
}

LoopGap loop_seam(Simulation& simulation, const LoopStart& start) {
    std::vector<Vec3> end;
    run_of(simulation).ends(start.bodies, end);
    return gap_of(start.end, end, start.tips);
}

LoopBlend::LoopBlend(Simulation before, std::int64_t frames, ToFrame to)
    : before_(std::move(before)), frames_(frames), to_(std::move(to)) {
    require_frames(frames, "LoopBlend");
}

void LoopBlend::blend(MotionFrame& frame) {
    if (made_ > 0) to_(before_, made_ + 1);
    const Tree& tree = before_.tree();
    const std::int64_t count = blended_frames(frames_);
    const double x = double(made_++) / double(count), w = x * x * (3 - 2 * x);
    const std::vector<Quat> now = in_parents(tree, frame.rotation), then = in_parents(tree, before_.rotations());
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Quat q = now[i].slerp(w, then[i]);
        if (tree.parent[i] < 0) {
            frame.rotation[i] = q.normalized();
        } else {
            const auto p = std::size_t(tree.parent[i]);
            frame.rotation[i] = (frame.rotation[p] * q).normalized();
            frame.position[i] = frame.position[p] + frame.rotation[p] * tree.joint_position[i];
        }
        if (frame.rotation[i].w() < 0) frame.rotation[i].coeffs() *= -1;
    }
}

} // namespace bough
