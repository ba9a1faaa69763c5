#include "scene_trees.h"
#include "converted.h"
#include "exits.h"
#include "formats/documents/scene.h"
#include "formats/free_memory.h"
#include "formats/open.h"
#include <limits>
#include <map>

namespace bough {
namespace {

// [bytes] of a body in a Tree without clumps, at least.
constexpr std::size_t body_bytes = 4 * sizeof(Vec3) + sizeof(Quat) + sizeof(Mat3) + 3 * sizeof(double) + 13;

// Each file is read when it is first wanted, and let go when it is last. together: all that are taken stay in memory.
class TreeFiles {
public:
    TreeFiles(const Scene& scene, const std::string& scene_file, const MaterialChange& material, bool together)
        : scene_file_(scene_file), material_(material), together_(together) {
        for (const Placement& place : scene.trees) ++wanted_[place.file];
    }
    Tree take(const Placement& place) {
        const std::string& file = place.file;
        std::size_t& left = wanted_[file];
        auto known = read_.find(file);
        if (known == read_.end()) {
            const std::string path = tree_file(scene_file_, place);
            TreeOfFile read = read_named(path);
            notes_.insert(notes_.end(), read.notes.begin(), read.notes.end());
            if (read.imported) converted_.push_back(path);
            known = read_.emplace(file, with_material(std::move(read.tree), material_, path)).first;
            looks_[file] = {known->second.name, known->second.color};
            if (together_) count(known->second.size_bodies(), left);
        }
        if (--left > 0) return known->second;
        Tree tree = std::move(known->second);
        read_.erase(known);
        return tree;
    }
    const std::vector<std::string>& notes() const { return notes_; }
    const std::vector<std::string>& converted() const { return converted_; }
    std::vector<TreeLook> looks(const Scene& scene) const {
        std::vector<TreeLook> looks;
        for (const Placement& place : scene.trees) looks.push_back(looks_.at(place.file));
        return looks;
    }

private:
    // A tree of a scene: what is wrong with it is said with the scene.
    TreeOfFile read_named(const std::string& path) const {
        try {
            return read_any_tree(path);
        } catch (const InputError& error) {
            throw InputError(input_name(scene_file_) + ": /trees", error.what());
        }
    }

    // A scene of a megabyte may name one tree forty thousand times: it is refused before its trees stand.
    void count(std::size_t bodies, std::size_t times) {
        bodies_ += bodies * times;
        const std::string all = "/trees: have " + std::to_string(bodies_) + " bodies";
        if (bodies_ > std::size_t(std::numeric_limits<std::int32_t>::max()))
            throw InputError(input_name(scene_file_), all + ", expected at most 2147483647 (--shard takes a part)");
        if (const std::size_t left = free_memory().value_or(SIZE_MAX); left / body_bytes < bodies_)
            throw InputError(input_name(scene_file_),
                             all + ", which take " + std::to_string(bodies_ * body_bytes >> 20) + " MB and more, and " +
                                 std::to_string(left >> 20) + " MB are free (--shard takes a part)");
    }

    std::string scene_file_;
    const MaterialChange& material_;
    const bool together_;
    std::size_t bodies_ = 0; // of the files that were read, as often as they are wanted
    std::map<std::string, std::size_t> wanted_;
    std::map<std::string, Tree> read_;
    std::map<std::string, TreeLook> looks_;      // of trees that were read
    std::vector<std::string> notes_, converted_; // of files that were converted
};

// "i/n", 1 <= i <= n.
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

} // namespace

TreesRead read_trees(Assembly& assembly, const std::string& scene_file, const std::string& shard,
                     const MaterialChange& material) {
    if (assembly.scene.trees.empty())
        throw InputError(input_name(scene_file), "/trees: is empty or missing, expected at least one tree");
    std::shared_ptr<TreeFiles> files; // of the last pass over them
    const OpenTrees open = [&](const Scene& scene) -> TreeSource {
        files = std::make_shared<TreeFiles>(scene, scene_file, material, shard.empty());
        return [files](const Placement& place) { return files->take(place); };
    };
    if (shard.empty()) {
        try {
            stand_trees(assembly, open(assembly.scene));
        } catch (const std::bad_alloc&) { // a limit that the system does not count as free memory, such as ulimit -v
            throw InputError(input_name(scene_file), "/trees: do not fit into memory (--shard takes a part)");
        }
    } else {
        const Part part = parse_shard(shard);
        try {
            stand_part(assembly, part.part, part.parts, open);
        } catch (const SceneError& error) {
            throw UsageError("--shard " + shard + ": " + error.what());
        }
    }
    return {files->notes(), files->converted(), files->looks(assembly.scene)};
}

} // namespace bough
