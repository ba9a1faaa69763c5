#include "scene_trees.h"
#include "converted.h"
#include "exits.h"
#include "formats/documents/scene.h"
#include "formats/open.h"
#include "lib/lanes/stands.h"
#include "lib/laws/wind_field.h"
#include "lib/simulation/fingerprint.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>

namespace bough {
namespace {

// Each file is read when it is first wanted, and let go when it is last.
class TreeFiles {
public:
    TreeFiles(const Scene& scene, const std::string& scene_file, const MaterialChange& material)
        : scene_file_(scene_file), material_(material) {
        for (const Placement& place : scene.trees) ++wanted_[place.file];
    }
    Tree take(const Placement& place) {
        const std::string& file = place.file;
        std::size_t& left = wanted_[file];
        auto known = read_.find(file);
        if (known == read_.end()) {
            const std::string path = tree_file(scene_file_, place);
            TreeOfFile read = read_any_tree(path);
            notes_.insert(notes_.end(), read.notes.begin(), read.notes.end());
            if (read.imported) converted_.push_back(path);
            known = read_.emplace(file, with_material(std::move(read.tree), material_, path)).first;
        }
        if (--left > 0) return known->second;
        Tree tree = std::move(known->second);
        read_.erase(known);
        return tree;
    }
    const std::vector<std::string>& notes() const { return notes_; }
    const std::vector<std::string>& converted() const { return converted_; }

private:
    std::string scene_file_;
    const MaterialChange& material_;
    std::map<std::string, std::size_t> wanted_;
    std::map<std::string, Tree> read_;
    std::vector<std::string> notes_, converted_; // of files that were converted
};

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

// One after the other, no two of different files in memory at a time but what is wanted again.
void measure(const Scene& scene, const std::string& scene_file, const MaterialChange& material,
             std::vector<TreeSize>& sizes, Part& part) {
    TreeFiles files(scene, scene_file, material);
    for (std::size_t k = 0; k < scene.trees.size(); ++k) {
        Setting alone;
        stand(alone, files.take(scene.trees[k]), scene.trees[k]);
        TreeSize size{alone.tree.size_bodies(), {}};
        for (std::size_t i = 0; i < size.bodies; ++i)
            if (alone.tree.parent[i] < 0) size.roots.push_back(i);
        sizes.push_back(std::move(size));
        if (!alone.tree.rigid.empty())
            throw UsageError("--shard: not where joints are held (/rigid of " + scene.trees[k].file + ")");
        part.whole = part.whole * 1099511628211u ^ fingerprint(alone.tree, alone.scene); // FNV's prime
        if (!scene.wind) continue;
        const WindReach reach = wind_reach(alone.tree, alone.ranges, scene_of_tree(scene, k));
        part.top = std::max(part.top, reach.top);
        part.reach = std::max(part.reach, reach.reach);
    }
    Setting all; // what acts on them
    all.scene = scene;
    part.whole = part.whole * 1099511628211u ^ fingerprint(all.tree, all.scene);
    part.clocks = wind_clocks(scene);
    part.moved = !scene.root_motion.empty();
}

} // namespace

Part parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto number = [&](const std::string& digits) -> std::int32_t {
        const bool whole =
            !digits.empty() && digits.size() < 7 && digits.find_first_not_of("0123456789") == std::string::npos;
        return whole ? std::stoi(digits) : 0;
    };
    Part part;
    part.part = number(text.substr(0, slash));
    part.parts = slash == std::string::npos ? 0 : number(text.substr(slash + 1));
    if (part.part < 1 || part.part > part.parts)
        throw UsageError("--shard is '" + text + "', expected i/n, i from 1 to n");
    return part;
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

Scene scene_of_part(const Scene& scene, std::size_t first, std::size_t end) {
    if (const char* together = free_part(scene))
        throw UsageError(std::string("--shard: not with the scene's ") + together + ", which goes from tree to tree");
    if (scene.wind && scene.wind->shelter)
        throw UsageError("--shard: not with the scene's /wind/shelter, by which trees act on each other");
    if (scene.simulate) throw UsageError("--shard: not with the scene's /simulate, which joins bodies anew");
    const auto within = [&](std::int32_t tree) { return std::size_t(tree) >= first && std::size_t(tree) < end; };
    Scene part = scene;
    part.trees.assign(scene.trees.begin() + std::ptrdiff_t(first), scene.trees.begin() + std::ptrdiff_t(end));
    part.pulls.clear();
    for (std::size_t k = 0; k < scene.pulls.size(); ++k) {
        Pull pull = scene.pulls[k];
        if (pull.on.by == Selector::By::nearest || pull.on.by == Selector::By::level)
            throw UsageError("--shard: not with the scene's /pulls/" + std::to_string(k) +
                             "/on, which looks for its body in all trees; name it by body or branch");
        if (!within(pull.on.tree)) continue;
        pull.on.tree -= std::int32_t(first);
        part.pulls.push_back(std::move(pull));
    }
    if (part.wood) {
        std::size_t k = 0;
        std::erase_if(part.wood->curves, [&](WoodCurve& curve) {
            const std::string at = "/wood/curves/" + std::to_string(k++) + "/on";
            if (!curve.on) return false;
            if (curve.on->by == Selector::By::nearest || curve.on->by == Selector::By::level)
                throw UsageError("--shard: not with the scene's " + at +
                                 ", which looks for its body in all trees; name it by body or branch");
            if (!within(curve.on->tree)) return true;
            curve.on->tree -= std::int32_t(first);
            return false;
        });
    }
    part.root_motion.clear();
    for (RootMotion motion : scene.root_motion) {
        if (!within(motion.tree)) continue;
        motion.tree -= std::int32_t(first);
        part.root_motion.push_back(std::move(motion));
    }
    return part;
}

void stand_trees(Setting& setting, const std::string& scene_file, const std::string& shard,
                 const MaterialChange& material) {
    if (setting.scene.trees.empty())
        throw InputError(input_name(scene_file), "/trees: is empty or missing, expected at least one tree");
    if (!shard.empty()) {
        setting.part = parse_shard(shard);
        std::vector<TreeSize> sizes;
        measure(setting.scene, scene_file, material, sizes, setting.part);
        const std::vector<std::size_t> units = cuts(sizes);
        if (std::size_t(setting.part.parts) > units.size())
            throw UsageError("--shard " + shard + ": the scene has " + std::to_string(sizes.size()) +
                             " trees, which can be cut into " + std::to_string(units.size()) +
                             (units.size() == 1 ? " part" : " parts") + " (of 256 bodies at least)");
        std::vector<std::size_t> bodies(units.size(), 0);
        for (std::size_t u = 0, k = 0; u < units.size(); ++u)
            for (const std::size_t next = u + 1 < units.size() ? units[u + 1] : sizes.size(); k < next; ++k)
                bodies[u] += sizes[k].bodies;
        const auto [first_unit, end_unit] = units_of_part(bodies, setting.part);
        const std::size_t first = units[first_unit], end = end_unit < units.size() ? units[end_unit] : sizes.size();
        for (std::size_t k = 0; k < first; ++k) setting.part.first_body += std::int64_t(sizes[k].bodies);
        setting.scene = scene_of_part(setting.scene, first, end);
    }
    TreeFiles files(setting.scene, scene_file, material);
    for (const Placement& place : setting.scene.trees) stand(setting, files.take(place), place);
    setting.notes = files.notes();
    setting.converted = files.converted();
}

} // namespace bough
