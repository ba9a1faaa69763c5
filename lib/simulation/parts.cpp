#include "parts.h"
#include "../lanes/stands.h"
#include "../laws/wind_field.h"
#include "../plan/make_plan.h"
#include "../plan/state.h"
#include "fingerprint.h"
#include <algorithm>
#include <numeric>

namespace bough {
namespace {

Scene scene_of_tree(const Scene& scene, std::size_t k) {
    Scene alone;
    alone.trees = {scene.trees[k]};
    alone.wind = scene.wind;
    for (RootMotion motion : scene.root_motion)
        if (std::size_t(motion.tree) == k) {
            motion.tree = 0;
            alone.root_motion.push_back(std::move(motion));
        }
    return alone;
}

// One after the other, no two in memory at a time but what the source keeps.
std::vector<TreeSize> measure(const Scene& scene, const TreeSource& tree_of, Part& part) {
    constexpr std::uint64_t prime = 1099511628211u; // FNV's
    std::vector<TreeSize> sizes;
    for (std::size_t k = 0; k < scene.trees.size(); ++k) {
        Assembly alone;
        stand(alone, tree_of(scene.trees[k]), scene.trees[k]);
        TreeSize size{alone.tree.size_bodies(), {}};
        for (std::size_t i = 0; i < size.bodies; ++i)
            if (alone.tree.parent[i] < 0) size.roots.push_back(i);
        sizes.push_back(std::move(size));
        if (!alone.tree.rigid.empty())
            throw SceneError("not where joints are held (/rigid of " + scene.trees[k].file + ")");
        part.whole = part.whole * prime ^ fingerprint(alone.tree, alone.scene);
        if (!scene.wind) continue;
        for (std::size_t i = 0; i < alone.tree.size_bodies(); ++i) {
            part.foliage |= is_foliage(kind_in_air(alone.tree, i));
            part.faces |= facing_in_air(alone.tree, i) > 0;
        }
        const WindReach reach = wind_reach(alone.tree, alone.ranges, scene_of_tree(scene, k));
        part.top = std::max(part.top, reach.top);
        part.reach = std::max(part.reach, reach.reach);
        alone.scene = scene_of_part(scene, k, k + 1);
        change_wood(alone);
        part.settling = std::max(part.settling, settling_time(alone));
    }
    part.whole = part.whole * prime ^ fingerprint(Tree(), scene); // what acts on them
    part.clocks = wind_clocks(scene);
    part.moved = !scene.root_motion.empty();
    return sizes;
}

template <class T> std::uint64_t hash_in(std::span<const SavedState* const> parts) {
    State<T> whole;
    for (const SavedState* part : parts) {
        for (const Vec3& theta : part->theta) whole.theta.push_back(theta.template cast<T>());
        for (const Vec3& rate : part->theta_dot) whole.theta_dot.push_back(rate.template cast<T>());
    }
    return state_hash(whole);
}

} // namespace

void stand_trees(Assembly& assembly, const TreeSource& tree_of) {
    for (const Placement& place : assembly.scene.trees) stand(assembly, tree_of(place), place);
}

void stand_part(Assembly& assembly, std::int32_t part, std::int32_t parts, const OpenTrees& open) {
    Scene& scene = assembly.scene;
    assembly.part.part = part;
    assembly.part.parts = parts;
    const std::vector<TreeSize> sizes = measure(scene, open(scene), assembly.part);
    const std::vector<std::size_t> units = cuts(sizes);
    if (std::size_t(parts) > units.size())
        throw SceneError("the scene has " + std::to_string(sizes.size()) + " trees, which can be cut into " +
                         std::to_string(units.size()) + (units.size() == 1 ? " part" : " parts") +
                         " (of 256 bodies at least)");
    std::vector<std::size_t> bodies(units.size(), 0);
    for (std::size_t u = 0, k = 0; u < units.size(); ++u)
        for (const std::size_t next = u + 1 < units.size() ? units[u + 1] : sizes.size(); k < next; ++k)
            bodies[u] += sizes[k].bodies;
    const auto [first_unit, end_unit] = units_of_part(bodies, assembly.part);
    const std::size_t first = units[first_unit], end = end_unit < units.size() ? units[end_unit] : sizes.size();
    for (std::size_t k = 0; k < first; ++k) assembly.part.first_body += std::int64_t(sizes[k].bodies);
    scene = scene_of_part(scene, first, end);
    stand_trees(assembly, open(scene));
}

std::pair<std::size_t, std::size_t> units_of_part(const std::vector<std::size_t>& bodies, const Part& part) {
    const double all = double(std::accumulate(bodies.begin(), bodies.end(), std::size_t(0)));
    const std::size_t trees = bodies.size(), parts = std::size_t(part.parts);
    std::vector<std::size_t> first(parts + 1, trees); // tree of each part
    std::size_t k = 0;
    double before = 0;
    for (std::size_t p = 0; p < parts; ++p) {
        const std::size_t least = p == 0 ? 0 : first[p - 1] + 1, most = trees - (parts - p);
        while (k < trees && before + double(bodies[k]) / 2 < all * double(p) / double(parts))
            before += double(bodies[k++]);
        first[p] = std::clamp(k, least, most);
    }
    return {first[std::size_t(part.part) - 1], first[std::size_t(part.part)]};
}

std::vector<std::size_t> cuts(const std::vector<TreeSize>& sizes) {
    std::vector<std::size_t> before;
    std::size_t offset = 0, stand = 0; // where the present one begins
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        for (const std::size_t root : sizes[k].roots) {
            const std::size_t i = offset + root;
            if (i > 0 && i - stand < fast::smallest_stand) continue;
            stand = i;
            if (root == sizes[k].roots.front()) before.push_back(k);
        }
        offset += sizes[k].bodies;
    }
    return before;
}

namespace {

// Throws SceneError for a selector of the scene's `place` whose body any tree may have: a part has not all of them.
void refuse_search(const Selector& on, const std::string& place) {
    if (on.by == Selector::By::nearest || on.by == Selector::By::level)
        throw SceneError("not with the scene's " + place +
                         ", which looks for its body in all trees; name it by body or branch");
}

// Of a scene's trees, those of one part.
struct PartTrees {
    std::size_t first, end;
    bool has(std::int32_t tree) const { return std::size_t(tree) >= first && std::size_t(tree) < end; }
    void renumber(std::int32_t& tree) const { tree -= std::int32_t(first); }
};

void cut_pulls(Scene& scene, const PartTrees& trees) {
    std::size_t k = 0;
    std::erase_if(scene.pulls, [&](Pull& pull) {
        refuse_search(pull.on, "/pulls/" + std::to_string(k++) + "/on");
        if (!trees.has(pull.on.tree)) return true;
        trees.renumber(pull.on.tree);
        return false;
    });
}

void cut_attachments(Scene& scene, const PartTrees& trees) {
    std::size_t k = 0;
    std::erase_if(scene.attachments, [&](Attachment& held) {
        const std::string place = "/attachments/" + std::to_string(k++);
        refuse_search(held.on, place + "/on");
        if (held.with && (held.with->by == Selector::By::nearest || held.with->tree != held.on.tree))
            throw SceneError("not with the scene's " + place + "/with, which goes from tree to tree");
        if (!trees.has(held.on.tree)) return true;
        trees.renumber(held.on.tree);
        if (held.with) trees.renumber(held.with->tree);
        return false;
    });
}

void cut_curves(Wood& wood, const PartTrees& trees) {
    std::size_t k = 0;
    std::erase_if(wood.curves, [&](WoodCurve& curve) {
        const std::string place = "/wood/curves/" + std::to_string(k++) + "/on";
        if (!curve.on) return false;
        refuse_search(*curve.on, place);
        if (!trees.has(curve.on->tree)) return true;
        trees.renumber(curve.on->tree);
        return false;
    });
}

} // namespace

Scene scene_of_part(const Scene& scene, std::size_t first, std::size_t end) {
    if (const char* together = free_part(scene))
        throw SceneError(std::string("not with the scene's ") + together + ", which goes from tree to tree");
    if (scene.wind && scene.wind->shelter)
        throw SceneError("not with the scene's /wind/shelter, by which trees act on each other");
    if (scene.simulate) throw SceneError("not with the scene's /simulate, which joins bodies anew");
    const PartTrees trees{first, end};
    Scene part = scene;
    part.trees.assign(scene.trees.begin() + std::ptrdiff_t(first), scene.trees.begin() + std::ptrdiff_t(end));
    cut_pulls(part, trees);
    cut_attachments(part, trees);
    if (part.wood) cut_curves(*part.wood, trees);
    std::erase_if(part.root_motion, [&](const RootMotion& motion) { return !trees.has(motion.tree); });
    for (RootMotion& motion : part.root_motion) trees.renumber(motion.tree);
    return part;
}

std::uint64_t hash_of_parts(std::span<const SavedState* const> parts) {
    return parts.front()->precision == "float" ? hash_in<float>(parts) : hash_in<double>(parts);
}

} // namespace bough
