#include "assembly.h"
#include "../base/shortest_text.h"
#include "../model/append.h"
#include "../model/place.h"
#include "../model/static_load.h"
#include "../model/wood_overrides.h"
#include "../plan/hold.h"
#include "../plan/plan.h"
#include "../plan/settling.h"
#include <algorithm>
#include <numbers>

namespace bough {
namespace {

std::string count(std::size_t n, const char* what) {
    return std::to_string(n) + what;
}

} // namespace

void stand(Assembly& assembly, Tree tree, const Placement& at) {
    const std::vector<std::int32_t>& branch = assembly.tree.branch;
    const std::int32_t first_branch = branch.empty() ? 0 : *std::max_element(branch.begin(), branch.end()) + 1;
    const std::size_t first = assembly.tree.size_bodies(), bodies = tree.size_bodies();
    if (!tree.source.empty() && assembly.source.find(tree.source) == std::string::npos)
        assembly.source += (assembly.source.empty() ? "" : "\n") + tree.source;
    const double yaw = at.yaw * std::numbers::pi / 180;
    if (first == 0) {
        assembly.tree = std::move(tree);
        place(assembly.tree, at.position, yaw);
    } else {
        append(assembly.tree, tree, at.position, yaw);
    }
    assembly.ranges.push_back({first, bodies, first_branch});
}

void change_wood(Assembly& assembly) {
    if (assembly.scene.wood) {
        WoodChanges changes;
        try {
            changes = override_wood(assembly.tree, assembly.ranges, *assembly.scene.wood);
        } catch (const std::out_of_range& error) {
            throw SceneError(std::string("/") + error.what());
        }
        std::string line = "/wood: stiffness of " + count(changes.stiffness, " joints, damping of ") +
                           count(changes.damping, ", mass of ") + count(changes.mass, " bodies");
        if (assembly.scene.wood->fork)
            line += "; " + count(changes.near_forks, " joints near ") + count(changes.forks, " forks");
        assembly.changes.push_back(line);
        assembly.scene.wood.reset();
    }
    if (assembly.scene.load) {
        const LoadLaid laid = lay_load(assembly.tree, *assembly.scene.load);
        assembly.changes.push_back("/load: " + rounded_text(laid.mass, 6) + " kg on " + count(laid.bodies, " bodies"));
        assembly.scene.load.reset();
    }
}

void join_rigid(Assembly& assembly) {
    if (!assembly.scene.simulate && assembly.tree.rigid.empty()) return;
    try {
        const HeldJoints held = hold_rigid(assembly.tree, assembly.ranges, assembly.scene);
        assembly.changes.push_back((assembly.scene.simulate ? "/simulate: " : "/rigid: ") + text_of(held));
        assembly.scene.simulate.reset();
        if (!has_rigid(assembly.tree)) return assembly.tree.rigid.clear();
        const Scene& scene = assembly.scene;
        if (const char* part = free_part(scene) ? free_part(scene) : assembly.tree.load.empty() ? nullptr : "/load")
            throw SceneError(std::string(part) + ": not with rigid parts (/simulate, or /rigid of a tree), expected a "
                                                 "tree whose joints all move");
        auto whole = std::make_shared<Whole>();
        whole->places = reduce(assembly.tree, assembly.ranges, assembly.scene);
        whole->scene = assembly.scene;
        if (whole->places.leader.empty()) throw SceneError("nothing is left that moves: " + text_of(held));
        assembly.scene = scene_on(whole->places, assembly.tree, assembly.scene);
        whole->tree = std::move(assembly.tree);
        whole->tree.rigid.clear();
        assembly.tree = std::move(whole->places.tree);
        whole->places.tree = {};
        assembly.ranges = whole->places.ranges;
        assembly.whole = std::move(whole);
    } catch (const std::out_of_range& error) {
        throw SceneError(error.what());
    } catch (const std::domain_error& error) {
        throw SceneError(error.what());
    }
}

double settling_time(const Assembly& assembly) {
    return assembly.part.parts > 1 ? assembly.part.settling
                                   : settling_time(assembly.tree, assembly.ranges, assembly.scene);
}

std::string text_of(const Defect& defect) {
    return "/" + defect.field + (defect.index < 0 ? "" : "/" + std::to_string(defect.index)) + ": " + defect.message;
}

Assembly assemble(Scene scene) {
    if (const std::optional<Defect> defect = check(scene)) throw SceneError(text_of(*defect));
    if (scene.trees.empty()) throw SceneError("/trees: is empty, expected at least one tree (Scene::add)");
    Assembly assembly;
    assembly.scene = std::move(scene);
    for (std::size_t k = 0; k < assembly.scene.trees.size(); ++k) {
        Placement& at = assembly.scene.trees[k];
        const std::string name = "/trees/" + std::to_string(k);
        if (!at.tree)
            throw SceneError(name + ": only names a file, '" + at.file +
                             "', expected a tree in memory (Scene::add; read_scene of bough/files.h brings them)");
        if (const std::optional<Defect> defect = check(*at.tree)) throw SceneError(name + ": " + text_of(*defect));
        stand(assembly, *at.tree, at);
        at.tree.reset(); // a park's file is held once, by whoever added it
    }
    change_wood(assembly);
    join_rigid(assembly);
    return assembly;
}

} // namespace bough
