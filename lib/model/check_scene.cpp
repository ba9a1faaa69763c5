#include "../base/counted.h"
#include "check_parts.h"

namespace bough {

std::optional<Defect> finite(std::string_view field, const Vec3& value) {
    if (value.allFinite()) return std::nullopt;
    return Defect{std::string(field), -1, "is not finite, expected finite numbers"};
}

std::optional<Defect> not_too_far(std::string_view field, const Vec3& value) {
    if (auto defect = finite(field, value)) return defect;
    Eigen::Index most = 0;
    if (value.cwiseAbs().maxCoeff(&most) <= largest_length) return std::nullopt;
    return Defect{std::string(field), -1,
                  "holds " + shortest_text(value[most]) + ", expected at most " + shortest_text(largest_length) +
                      " either way"};
}

std::optional<Defect> not_too_far(std::string_view field, double value) {
    if (std::abs(value) <= largest_length) return std::nullopt;
    return Defect{std::string(field), -1,
                  "is " + shortest_text(value) + ", expected at most " + shortest_text(largest_length)};
}

std::optional<Defect> at_least(std::string_view field, double value, double low) {
    if (std::isfinite(value) && value >= low) return std::nullopt;
    return Defect{std::string(field), -1,
                  "is " + shortest_text(value) + ", expected " + shortest_text(low) + " or more"};
}

std::optional<Defect> above_zero(std::string_view field, double value) {
    if (std::isfinite(value) && value > 0) return std::nullopt;
    return Defect{std::string(field), -1, "is " + shortest_text(value) + ", expected more than 0"};
}

std::optional<Defect> finite(std::string_view field, double value) {
    if (std::isfinite(value)) return std::nullopt;
    return Defect{std::string(field), -1, "is not finite, expected a number"};
}

std::optional<Defect> one_of(std::string_view field, std::size_t value, std::initializer_list<const char*> names) {
    if (value < names.size()) return std::nullopt;
    std::string expected;
    for (const char* const name : names) expected += (expected.empty() ? "" : ", ") + std::string(name);
    return Defect{std::string(field), -1, "is " + std::to_string(value) + ", expected one of " + expected};
}

namespace {

std::optional<Defect> check(const Placement& tree, const std::string& at) {
    if (tree.file.empty() && !tree.tree) return Defect{at + "/file", -1, "is empty, expected the file of a tree"};
    if (auto defect = not_too_far(at + "/position", tree.position)) return defect;
    if (!std::isfinite(tree.yaw)) return Defect{at + "/yaw", -1, "is not finite, expected degrees"};
    if (!(std::abs(tree.start) <= 1e9))
        return Defect{at + "/start", -1, "is " + shortest_text(tree.start) + ", expected seconds, -1e9 to 1e9"};
    return std::nullopt;
}

std::optional<Defect> check(const Pull& pull, const std::string& at, std::size_t trees) {
    if (auto defect = check(pull.on, at + "/on", trees)) return defect;
    const std::string count = std::to_string(pull.time.size());
    if (pull.time.empty()) return Defect{at + "/time", -1, "is empty, expected at least one time"};
    if (pull.force.size() != pull.time.size())
        return Defect{at + "/force", -1,
                      "has " + counted(pull.force.size(), "force", "forces") + ", expected " + count +
                          " (one for each time)"};
    for (std::size_t i = 0; i < pull.time.size(); ++i) {
        const std::int64_t entry = std::int64_t(i);
        if (!std::isfinite(pull.time[i])) return Defect{at + "/time", entry, "is not finite, expected seconds"};
        if (i > 0 && !(pull.time[i] > pull.time[i - 1]))
            return Defect{at + "/time", entry,
                          "is " + shortest_text(pull.time[i]) + ", expected more than " +
                              shortest_text(pull.time[i - 1]) + " (times rise)"};
        if (!pull.force[i].allFinite()) return Defect{at + "/force", entry, "is not finite, expected newtons"};
    }
    return std::nullopt;
}

std::optional<Defect> check_keys(const std::vector<double>& time, const std::string& at) {
    if (time.size() < 2)
        return Defect{at, -1, "has " + counted(time.size(), "time", "times") + ", expected at least 2"};
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (!std::isfinite(time[i])) return Defect{at, std::int64_t(i), "is not finite, expected seconds"};
        if (i > 0 && !(time[i] > time[i - 1]))
            return Defect{at, std::int64_t(i),
                          "is " + shortest_text(time[i]) + ", expected more than " + shortest_text(time[i - 1]) +
                              " (times rise)"};
    }
    return std::nullopt;
}

std::optional<Defect> check(const Attachment& held, const std::string& at, std::size_t trees) {
    if (auto defect = check(held.on, at + "/on", trees)) return defect;
    if (held.with) {
        if (auto defect = check(*held.with, at + "/with", trees)) return defect;
        if (held.with->by == Selector::By::level)
            return Defect{at + "/with", -1, "is by level, expected one body: by body, branch or nearest"};
    }
    if (held.target && !held.time.empty())
        return Defect{at + "/target", -1, "stands beside time and position, expected one of the two"};
    if (held.target)
        if (auto defect = not_too_far(at + "/target", *held.target)) return defect;
    if (!held.time.empty())
        if (auto defect = check_keys(held.time, at + "/time")) return defect;
    if (held.position.size() != held.time.size())
        return Defect{at + "/position", -1,
                      "has " + counted(held.position.size(), "key", "keys") + ", expected " +
                          std::to_string(held.time.size()) + " (one for each time)"};
    for (std::size_t i = 0; i < held.position.size(); ++i)
        if (auto defect = not_too_far(at + "/position/" + std::to_string(i), held.position[i])) return defect;
    if (auto defect = at_least(at + "/stiffness", held.stiffness, 0)) return defect;
    if (auto defect = at_least(at + "/damping", held.damping, 0)) return defect;
    if (held.stiffness == 0 && held.damping == 0)
        return Defect{at, -1, "holds nothing, expected stiffness or damping above 0"};
    if (std::isnan(held.from)) return Defect{at + "/from", -1, "is not finite, expected seconds"};
    if (held.to > held.from) return std::nullopt;
    return Defect{at + "/to", -1,
                  "is " + shortest_text(held.to) + ", expected more than from, " + shortest_text(held.from)};
}

// `which`: the entry's place in the list; an earlier one may have its tree already.
std::optional<Defect> check(const std::vector<RootMotion>& motions, std::size_t which, std::size_t trees) {
    const RootMotion& motion = motions[which];
    const std::string at = "root_motion/" + std::to_string(which);
    const std::size_t count = trees == 0 ? 1 : trees;
    if (motion.tree < 0 || std::size_t(motion.tree) >= count)
        return Defect{at + "/tree", -1,
                      "is " + std::to_string(motion.tree) + ", expected a tree of the scene, 0 to less than " +
                          std::to_string(count)};
    for (std::size_t i = 0; i < which; ++i)
        if (motions[i].tree == motion.tree)
            return Defect{at + "/tree", -1,
                          "is " + std::to_string(motion.tree) + ", which /root_motion/" + std::to_string(i) +
                              " moves already"};
    if (auto defect = check_keys(motion.time, at + "/time")) return defect;
    if (motion.position.empty() && motion.rotation.empty())
        return Defect{at, -1, "moves nothing, expected position or rotation"};
    const auto count_defect = [&](const char* field, std::size_t found) -> std::optional<Defect> {
        if (found == 0 || found == motion.time.size()) return std::nullopt;
        return Defect{at + "/" + field, -1,
                      "has " + counted(found, "key", "keys") + ", expected " + std::to_string(motion.time.size()) +
                          " (one for each time)"};
    };
    if (auto defect = count_defect("position", motion.position.size())) return defect;
    if (auto defect = count_defect("rotation", motion.rotation.size())) return defect;
    for (std::size_t i = 0; i < motion.position.size(); ++i)
        if (auto defect = not_too_far(at + "/position/" + std::to_string(i), motion.position[i])) return defect;
    for (std::size_t i = 0; i < motion.rotation.size(); ++i)
        if (!(std::abs(motion.rotation[i].norm() - 1) <= 1e-6))
            return Defect{at + "/rotation", std::int64_t(i),
                          "has length " + shortest_text(motion.rotation[i].norm()) + ", expected a unit quaternion"};
    return std::nullopt;
}

// The place is the number's own, or what stands for all the equal numbers under it: people may write one number there.
std::optional<Defect> check(const JointLimit& limit) {
    const Vec3 same = Vec3::Constant(limit.branch[0]);
    const bool one = limit.branch == same && limit.leaf == same && limit.fruit == same;
    for (const auto& [kind, most] : {std::pair{"branch", limit.branch}, {"leaf", limit.leaf}, {"fruit", limit.fruit}})
        for (int k = 0; k < 3; ++k) {
            if (most[k] > 0 && most[k] <= 180) continue;
            const bool whole = most == Vec3::Constant(most[k]);
            return Defect{one ? "joint_limit" : std::string("joint_limit/") + kind, whole ? -1 : k,
                          "is " + shortest_text(most[k]) + ", expected degrees, more than 0 and at most 180"};
        }
    return std::nullopt;
}

std::optional<Defect> check(const LeafAir& leaves) {
    if (auto defect = at_least("leaves/kappa", leaves.kappa, 0)) return defect;
    if (auto defect = at_least("leaves/air_resistance", leaves.air_resistance, 0)) return defect;
    if (auto defect = above_zero("leaves/drag_ratio", leaves.drag_ratio)) return defect;
    if (std::isfinite(leaves.offset)) return std::nullopt;
    return Defect{"leaves/offset", -1, "is not finite, expected degrees"};
}

} // namespace

// `trees` of 0: the caller has the one tree that the scene is for.
std::optional<Defect> check(const Selector& on, const std::string& at, std::size_t trees) {
    const std::size_t count = trees == 0 ? 1 : trees;
    const auto index = [&](const char* field, std::int64_t value) -> std::optional<Defect> {
        if (value >= 0) return std::nullopt;
        return Defect{at + field, -1, "is " + std::to_string(value) + ", expected 0 or more"};
    };
    if (on.tree < 0 || std::size_t(on.tree) >= count)
        return Defect{at + "/tree", -1,
                      "is " + std::to_string(on.tree) + ", expected a tree of the scene, 0 to less than " +
                          std::to_string(count)};
    if (auto defect = one_of(at + "/by", std::size_t(on.by), {"body", "branch", "nearest", "level"})) return defect;
    switch (on.by) {
    case Selector::By::body:
        if (on.point)
            if (auto defect = finite(at + "/point", *on.point)) return defect;
        return index("/body", on.body);
    case Selector::By::level:
        return index("/level", on.level);
    case Selector::By::nearest:
        return finite(at + "/nearest", on.nearest);
    case Selector::By::branch:
        break;
    }
    if (auto defect = index("/branch", on.branch)) return defect;
    if (on.at >= 0 && on.at <= 1) return std::nullopt;
    return Defect{at + "/at", -1, "is " + shortest_text(on.at) + ", expected 0 to 1"};
}

std::optional<Defect> check(const Scene& scene) {
    for (std::size_t i = 0; i < scene.trees.size(); ++i)
        if (auto defect = check(scene.trees[i], "trees/" + std::to_string(i))) return defect;
    if (auto defect = not_too_far("gravity", scene.gravity)) return defect;
    if (scene.wind)
        if (auto defect = check(*scene.wind)) return defect;
    if (auto defect = at_least("air_density", scene.air_density, 0)) return defect;
    for (std::size_t i = 0; i < scene.pulls.size(); ++i)
        if (auto defect = check(scene.pulls[i], "pulls/" + std::to_string(i), scene.trees.size())) return defect;
    for (std::size_t i = 0; i < scene.attachments.size(); ++i)
        if (auto defect = check(scene.attachments[i], "attachments/" + std::to_string(i), scene.trees.size()))
            return defect;
    for (std::size_t i = 0; i < scene.root_motion.size(); ++i)
        if (auto defect = check(scene.root_motion, i, scene.trees.size())) return defect;
    if (auto defect = one_of("pose", std::size_t(scene.pose), {"drawn", "settled", "rest"})) return defect;
    if (auto defect = one_of("joint_inertia", std::size_t(scene.joint_inertia), {"branch", "paper"})) return defect;
    if (scene.joint_limit)
        if (auto defect = check(*scene.joint_limit)) return defect;
    if (scene.fracture)
        if (auto defect = check(*scene.fracture, scene.trees.size())) return defect;
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        if (auto defect = check(scene.balls[i], "balls/" + std::to_string(i))) return defect;
    if (scene.contact)
        if (auto defect = check(*scene.contact)) return defect;
    if (scene.leaves)
        if (auto defect = check(*scene.leaves)) return defect;
    for (std::size_t i = 0; i < scene.walkers.size(); ++i)
        if (auto defect = check(scene.walkers[i], "walkers/" + std::to_string(i), scene.trees.size())) return defect;
    if (scene.wood)
        if (auto defect = check(*scene.wood, scene.trees.size())) return defect;
    if (scene.load)
        if (auto defect = check(*scene.load)) return defect;
    if (scene.fictitious)
        if (auto defect = check(*scene.fictitious)) return defect;
    if (auto defect = check_simulate(scene)) return defect;
    if (auto defect = at_least("stiffness_scale", scene.stiffness_scale, 0)) return defect;
    return at_least("damping_scale", scene.damping_scale, 0);
}

} // namespace bough
