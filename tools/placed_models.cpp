#include "placed_models.h"
#include "formats/exports/gltf_parts.h"
#include "formats/plain_text.h"
#include "lib/model/split.h"
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace bough {
namespace {

MotionFrame part_of(const MotionFrame& frame, const Bodies& bodies) {
    MotionFrame part;
    part.frame = frame.frame;
    part.time = frame.time;
    for (const std::int32_t body : bodies) {
        part.position.push_back(frame.position[std::size_t(body)]);
        part.rotation.push_back(frame.rotation[std::size_t(body)]);
    }
    return part;
}

// The model's mesh as it is drawn, each vertex bound to the body of its largest share.
OwnMesh drawn_mesh(const DrivenMesh& from) {
    const Skin skin = from.skin_of_bodies();
    OwnMesh mesh = from.look();
    for (std::size_t m = 0; m < skin.part.size(); ++m) {
        OwnPart& part = mesh.part[m];
        const VertexStretch used = vertices_of(skin, skin.part[m]);
        part.standing.uv.resize(1);
        for (std::size_t v = std::size_t(used.first); v <= std::size_t(used.last); ++v) {
            part.standing.position.push_back(skin.position[v].cast<float>());
            part.standing.normal.push_back(skin.normal[v].cast<float>());
            part.standing.uv[0].push_back({skin.texture[v][0], 1 - skin.texture[v][1]});
            part.body.push_back({skin.joint[v][0], skin.joint[v][0]});
            part.second.push_back(0);
        }
        for (std::size_t t = skin.part[m].first_index; t < skin.part[m].first_index + skin.part[m].index_count; ++t) {
            const auto& [a, b, c] = skin.triangle[t];
            part.standing.triangle.push_back({a - used.first, b - used.first, c - used.first});
        }
    }
    return mesh;
}

// Bodies as the tree of those that are left numbers them.
void number_among(OwnMesh& mesh, const Bodies& bodies) {
    const auto number = [&bodies](std::int32_t& body) {
        body = std::int32_t(std::lower_bound(bodies.begin(), bodies.end(), body) - bodies.begin());
    };
    for (OwnPart& part : mesh.part) {
        for (auto& two : part.body)
            for (std::int32_t& body : two) number(body);
        for (OwnPlace& place : part.placed) {
            number(place.body);
            if (place.foot >= 0) number(place.foot);
        }
    }
}

// Names of materials that are each taken by one file.
class MaterialNames {
public:
    explicit MaterialNames(const OwnMesh& others) {
        for (const OwnPart& part : others.part) taken_.insert(part.name);
    }
    // Of another file's tree: the same names of each tree.
    void give(OwnMesh& mesh, bool next_file) {
        if (next_file) choose(mesh);
        for (OwnPart& part : mesh.part) part.name = given_.at(part.name);
    }

private:
    void choose(const OwnMesh& mesh) {
        given_.clear();
        for (const OwnPart& part : mesh.part) given_[part.name] = "";
        const std::set<std::string> before = taken_; // by other files
        for (auto& [name, given] : given_)
            if (!before.contains(name)) taken_.insert(given = name);
        for (auto& [name, given] : given_) {
            if (!given.empty() || name.empty()) continue;
            int k = 2;
            while (taken_.contains(given = name + "_" + std::to_string(k))) ++k;
            taken_.insert(given);
        }
    }

    std::set<std::string> taken_;
    std::map<std::string, std::string> given_; // of the last file's names
};

// Puts the parts of each model behind those of `to`: trees of one file share materials and images.
void add_looks(OwnMesh& to, const std::vector<PlacedMesh>& meshes,
               const std::function<OwnMesh(const PlacedMesh&)>& look) {
    std::optional<SharedParts> at;
    MaterialNames names(to);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        OwnMesh own = look(meshes[k]);
        const bool next_file = k == 0 || meshes[k].file != meshes[k - 1].file;
        names.give(own, next_file);
        if (next_file) at = share(to, own);
        add_parts(to, std::move(own), *at, meshes[k].bodies);
    }
}

// What is left is moved by its bodies, and each model's vertices by its bones.
class PlacedMover {
public:
    // first: vertices before each mesh's, of all in `skin`.
    PlacedMover(std::shared_ptr<std::vector<PlacedMesh>> meshes, const std::vector<std::size_t>& first,
                const Skin& skin, const Tree& shown)
        : meshes_(std::move(meshes)), first_(first), all_(skin.position.size()) {
        const std::size_t others = first_.empty() ? all_ : first_.front();
        if (others == 0) return;
        const auto begin = [others](const auto& array) {
            return std::vector(array.begin(), array.begin() + std::ptrdiff_t(others));
        };
        others_.position = begin(skin.position);
        others_.normal = begin(skin.normal);
        others_.joint = begin(skin.joint);
        others_.weight = begin(skin.weight);
        mover_.emplace(others_, shown, nullptr);
    }
    void move(const MotionFrame& frame, std::vector<Vec3>& position, std::vector<Vec3>& normal) {
        if (mover_) mover_->move(frame, position, normal);
        position.resize(all_);
        normal.resize(all_);
        for (std::size_t k = 0; k < meshes_->size(); ++k) {
            PlacedMesh& placed = (*meshes_)[k];
            placed.mesh.go_to(part_of(frame, placed.bodies));
            const std::size_t count = placed.mesh.vertices();
            placed.mesh.positions(0, std::span(position).subspan(first_[k], count));
            placed.mesh.normals(0, std::span(normal).subspan(first_[k], count));
        }
    }

private:
    std::shared_ptr<std::vector<PlacedMesh>> meshes_;
    std::vector<std::size_t> first_;
    std::size_t all_;
    Skin others_;
    std::optional<SkinMover> mover_;
};

// Where each mesh begins among the kept vertices, of which all that it has not are taken out of it.
std::vector<std::size_t> keep(std::vector<PlacedMesh>& meshes, const std::vector<std::size_t>& first, const Skin& skin,
                              std::span<const std::int32_t> vertex) {
    if (vertex.empty()) return first;
    std::vector<std::size_t> begins;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const auto at = [&](std::size_t v) {
            return std::size_t(std::lower_bound(vertex.begin(), vertex.end(), std::int32_t(v)) - vertex.begin());
        };
        const std::size_t from = at(first[k]), to = at(first[k] + meshes[k].mesh.vertices());
        std::vector<std::int32_t> own;
        for (std::size_t i = from; i < to; ++i) own.push_back(vertex[i] - std::int32_t(first[k]));
        meshes[k].mesh.keep(own, std::span(skin.position).subspan(from, to - from));
        begins.push_back(from);
    }
    return begins;
}

class ForestSink : public FrameSink {
public:
    ForestSink(const std::string& file, std::vector<PlacedForest> forests, OtherMesh others, const Tree& shown,
               double fps, const GltfChoice& choice, const std::string& source, std::vector<std::string>& notes)
        : output_(file), forests_(std::move(forests)), bodies_(std::move(others.bodies)), source_(source),
          notes_(notes) {
        if (bodies_.empty()) return;
        rest_ = part_of_tree(shown);
        number_among(others.mesh, bodies_);
        others_ = own_sink_into(glb_, rest_, std::move(others.mesh), fps, choice, source, notes);
    }
    void write(const MotionFrame& frame) override {
        if (others_) others_->write(part_of(frame, bodies_));
        for (PlacedForest& placed : forests_)
            for (std::size_t k = 0; k < placed.bodies.size(); ++k)
                placed.forest.write(k, part_of(frame, placed.bodies[k]));
    }
    void finish() override {
        if (others_) others_->finish();
        std::vector<DrivenForest> forests;
        for (PlacedForest& placed : forests_) forests.push_back(std::move(placed.forest));
        output_.write(glb_with(glb_, forests, gltf_options({}, "").generator, source_, output_.name()));
        output_.finish();
        std::size_t bones = 0, all = 0, kept = 0;
        for (const DrivenForest& forest : forests)
            bones += forest.bones(), all += forest.keys(), kept += forest.keys_written();
        note_driven(bones, all, kept, notes_);
    }

private:
    Tree part_of_tree(const Tree& shown) const { return bough::part_of(shown, bodies_); }

    Output output_;
    std::vector<PlacedForest> forests_;
    const Bodies bodies_; // that are none of theirs
    Tree rest_;
    std::string glb_; // of these
    std::unique_ptr<FrameSink> others_;
    const std::string source_;
    std::vector<std::string>& notes_;
};

} // namespace

std::vector<PlacedFile> placed_files(std::vector<SkinnedFile> files, const Tree& shown, const Setting& setting) {
    const std::vector<TreeRange>& ranges = setting.whole ? setting.whole->places.whole : setting.ranges;
    std::vector<PlacedFile> placed;
    for (SkinnedFile& file : files) {
        PlacedFile& to = placed.emplace_back(PlacedFile{std::move(file.model), {}});
        for (const std::size_t k : file.trees) {
            PlacedTree tree;
            for (std::size_t i = 0; i < ranges[k].bodies; ++i)
                tree.bodies.push_back(std::int32_t(ranges[k].first_body + i));
            tree.stand.tree = part_of(shown, tree.bodies);
            const Placement& place = setting.scene.trees[k];
            tree.stand.place = {place.position, place.yaw * std::numbers::pi / 180};
            tree.stand.name = stem_of(place.file) + (setting.ranges.size() > 1 ? " " + std::to_string(k + 1) : "");
            to.tree.push_back(std::move(tree));
        }
    }
    return placed;
}

Bodies bodies_of(const PlacedFile& file) {
    Bodies all;
    for (const PlacedTree& tree : file.tree) all.insert(all.end(), tree.bodies.begin(), tree.bodies.end());
    return all;
}

std::size_t bones_of(const std::vector<PlacedMesh>& meshes) {
    std::size_t bones = 0;
    for (const PlacedMesh& placed : meshes) bones += placed.mesh.bones();
    return bones;
}

OtherMesh other_mesh(OwnMesh mesh, const Bodies& elsewhere, std::size_t bodies) {
    OtherMesh others{std::move(mesh), {}};
    for (std::size_t i = 0; i < bodies; ++i)
        if (!std::binary_search(elsewhere.begin(), elsewhere.end(), std::int32_t(i)))
            others.bodies.push_back(std::int32_t(i));
    return others;
}

PlacedForest forest_of(PlacedFile file, const DrivenOptions& options, std::vector<std::string>& notes) {
    std::vector<DrivenStand> stands;
    std::vector<Bodies> bodies;
    for (PlacedTree& tree : file.tree) {
        stands.push_back(std::move(tree.stand));
        bodies.push_back(std::move(tree.bodies));
    }
    return {DrivenForest(std::move(file.model), stands, options, notes), std::move(bodies)};
}

std::vector<PlacedMesh> meshes_of(PlacedFile file, std::size_t number, std::vector<std::string>& notes) {
    std::vector<PlacedMesh> meshes;
    std::vector<std::string> again; // the same of each tree
    for (PlacedTree& tree : file.tree) {
        const DrivenStand& at = tree.stand;
        DrivenMesh mesh = meshes.empty() ? DrivenMesh(file.model, at.tree, at.place, notes)
                                         : DrivenMesh(meshes.front().mesh, file.model, at.tree, at.place, again);
        meshes.push_back({std::move(mesh), std::move(tree.bodies), number});
    }
    return meshes;
}

MovedMesh moved(std::vector<PlacedMesh> placed, OtherMesh others, const Tree& shown) {
    const auto meshes = std::make_shared<std::vector<PlacedMesh>>(std::move(placed));
    MovedMesh made;
    made.own = std::move(others.mesh);
    std::size_t count = 0;
    for (const OwnPart& part : made.own->part) count += vertices_of(*made.own, part);
    std::vector<std::size_t> first;
    for (const PlacedMesh& mesh : *meshes) {
        first.push_back(count);
        count += mesh.mesh.vertices();
    }
    add_looks(*made.own, *meshes, [](const PlacedMesh& of) { return drawn_mesh(of.mesh); });
    made.skin = skin_of(*made.own);
    made.mover = [meshes, first, &shown](const Skin& skin, std::span<const std::int32_t> vertex) -> Mover {
        const auto mover = std::make_shared<PlacedMover>(meshes, keep(*meshes, first, skin, vertex), skin, shown);
        return [mover](const MotionFrame& frame, std::vector<Vec3>& position, std::vector<Vec3>& normal) {
            mover->move(frame, position, normal);
        };
    };
    return made;
}

RiggedMesh rigged(const std::vector<PlacedMesh>& meshes, OtherMesh others, const Tree& shown, const GltfChoice& choice,
                  std::vector<std::string>& notes) {
    RiggedMesh made;
    std::vector<std::function<RigPose(const MotionFrame&)>> poses;
    made.note = [] {};
    if (!others.bodies.empty()) {
        const auto rest = std::make_shared<const Tree>(part_of(shown, others.bodies));
        number_among(others.mesh, others.bodies);
        Skin skin = skin_of(others.mesh);
        made = rigged(*rest, std::move(skin), std::move(others.mesh), choice, notes);
        poses.push_back([rest, pose = std::move(made.pose), bodies = others.bodies](const MotionFrame& frame) {
            return pose(part_of(frame, bodies));
        });
    }
    add_looks(made.look, meshes, [](const PlacedMesh& of) { return of.mesh.look(); });
    for (const PlacedMesh& placed : meshes) {
        RiggedMesh one = rigged(placed.mesh);
        append(made.rig, std::move(one.rig));
        poses.push_back([pose = std::move(one.pose), bodies = placed.bodies](const MotionFrame& frame) {
            return pose(part_of(frame, bodies));
        });
    }
    made.pose = [poses = std::move(poses)](const MotionFrame& frame) {
        RigPose all;
        for (const auto& pose : poses) append(all, pose(frame));
        return all;
    };
    return made;
}

std::unique_ptr<FrameSink> forest_sink(const std::string& file, std::vector<PlacedForest> forests, OtherMesh others,
                                       const Tree& shown, double fps, const GltfChoice& choice,
                                       const std::string& source, std::vector<std::string>& notes) {
    return std::make_unique<ForestSink>(file, std::move(forests), std::move(others), shown, fps, choice, source, notes);
}

} // namespace bough
