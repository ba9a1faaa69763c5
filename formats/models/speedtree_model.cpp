#include "speedtree_model.h"
#include "formats/imports/placed_import.h"
#include "formats/imports/speedtree_bones.h"
#include "formats/imports/speedtree_fields.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "own_materials.h"
#include "wood_axes.h"
#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace bough {
namespace {

using namespace speedtree;

// The world [m], Y up, from a file's unit and axes.
Eigen::Affine3d world_of(const ImportNotes& found) {
    Mat3 turn = Mat3::Identity();
    if (found.up == 'z') turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return Eigen::Translation3d(found.moved) * Eigen::Affine3d(Mat3(found.unit * turn));
}

// Which chains of wood the bones and the objects of a file are.
struct Chains {
    std::vector<std::int32_t> of_bone, of_object; // -1: none
};

void refuse_other_tree(const SpeedtreeModel& model, const BoneBodies& bodies, std::size_t all,
                       std::vector<std::string>& notes) {
    constexpr const char* expected = "; expected the model that the tree was made from, in its own units and up axis";
    const double ratio = bodies.tree_size / bodies.bones_size;
    if (!(ratio > 0.5 && ratio < 2))
        throw InputError(model.name, "its skeleton is " + shown(bodies.bones_size) + " m large, the tree is " +
                                         shown(bodies.tree_size) + " m" + expected);
    if (2 * bodies.missed > all)
        throw InputError(model.name, std::to_string(bodies.missed) + " of its " + std::to_string(all) +
                                         " bones and pieces of spine lie beside the tree, up to " +
                                         shown(bodies.worst) + " m" + expected);
    if (bodies.missed > 0)
        notes.push_back(model.name + ": " + std::to_string(bodies.missed) + " of " + std::to_string(all) +
                        " bones and pieces of spine lie beside the tree, up to " + shown(bodies.worst) +
                        " m: their bark goes with the nearest wood");
}

Chains chains_of(const SpeedtreeModel& model, const Eigen::Affine3d& place, const Tree& tree, const DrawnPose& pose,
                 const WoodAxes& wood, std::vector<std::string>& notes) {
    const File& file = model.file;
    const Eigen::Affine3d world = place * model.world;
    std::vector<Bone> rods;
    for (Bone bone : file.bones) {
        bone.start = world * bone.start;
        bone.end = world * bone.end;
        rods.push_back(std::move(bone));
    }
    std::vector<std::int32_t> object; // of the rods behind the bones
    for (std::size_t o = 0; o < file.objects.size(); ++o)
        for (std::size_t k = 0; k + 1 < file.objects[o].spine.size(); ++k) {
            Bone rod;
            rod.start = world * file.objects[o].spine[k];
            rod.end = world * file.objects[o].spine[k + 1];
            if ((rod.end - rod.start).squaredNorm() <= 0) continue;
            rods.push_back(std::move(rod));
            object.push_back(std::int32_t(o));
        }
    const BoneBodies bodies = bodies_of_bones(rods, tree, pose.R_wb, pose.x_w);
    refuse_other_tree(model, bodies, rods.size(), notes);
    Chains chains;
    for (std::size_t b = 0; b < file.bones.size(); ++b) chains.of_bone.push_back(wood.chain_of(bodies.turn[b]));
    std::vector<std::unordered_map<std::int32_t, std::size_t>> votes(file.objects.size());
    for (std::size_t k = 0; k < object.size(); ++k)
        if (const std::int32_t chain = wood.chain_of(bodies.turn[file.bones.size() + k]); chain >= 0)
            ++votes[std::size_t(object[k])][chain];
    chains.of_object.assign(file.objects.size(), -1);
    for (std::size_t o = 0; o < votes.size(); ++o) {
        std::pair<std::size_t, std::int32_t> best{0, -1};
        for (const auto& [chain, count] : votes[o])
            if (count > best.first || (count == best.first && chain < best.second)) best = {count, chain};
        chains.of_object[o] = best.second;
    }
    return chains;
}

// Of an object or the nearest above it that has one.
std::int32_t chain_above(const File& file, const Chains& chains, std::int32_t object) {
    for (; object >= 0; object = file.objects[std::size_t(object)].parent)
        if (chains.of_object[std::size_t(object)] >= 0) return chains.of_object[std::size_t(object)];
    return -1;
}

// Normals of the faces about each vertex, for surfaces without.
void add_normals(OwnSurface& s) {
    if (s.normal.size() == s.position.size()) return;
    s.normal.assign(s.position.size(), Eigen::Vector3f::Zero());
    for (const auto& [a, b, c] : s.triangle) {
        const Eigen::Vector3f n = (s.position[std::size_t(b)] - s.position[std::size_t(a)])
                                      .cross(s.position[std::size_t(c)] - s.position[std::size_t(a)]);
        for (const std::int32_t v : {a, b, c}) s.normal[std::size_t(v)] += n;
    }
    for (Eigen::Vector3f& n : s.normal)
        n = n.squaredNorm() > 0 ? Eigen::Vector3f(n.normalized()) : Eigen::Vector3f(Eigen::Vector3f::UnitY());
}

// From the bottom of an image up, to glTF's from the top down.
OwnSurface own_surface(Surface&& from) {
    OwnSurface made;
    made.position = std::move(from.position);
    made.normal = std::move(from.normal);
    made.tangent = std::move(from.tangent);
    made.uv = std::move(from.uv);
    for (auto& set : made.uv)
        for (auto& [u, v] : set) v = 1 - v;
    made.color = std::move(from.color);
    made.triangle = std::move(from.triangle);
    add_normals(made);
    return made;
}

template <class T> void append(std::vector<T>& to, std::vector<T>&& more) {
    if (to.empty())
        to = std::move(more);
    else
        to.insert(to.end(), more.begin(), more.end());
}

void append(OwnSurface& to, OwnSurface&& more) {
    const std::int32_t base = std::int32_t(to.position.size());
    for (auto& triangle : more.triangle)
        for (std::int32_t& v : triangle) v += base;
    const std::size_t before = to.position.size(), added = more.position.size();
    const std::size_t sets = std::max(to.uv.size(), more.uv.size());
    to.uv.resize(sets, std::vector<std::array<float, 2>>(before));
    more.uv.resize(sets, std::vector<std::array<float, 2>>(added));
    for (std::size_t s = 0; s < sets; ++s) append(to.uv[s], std::move(more.uv[s]));
    if (to.color.empty() != more.color.empty() && before > 0)
        (to.color.empty() ? to : more).color.assign(to.color.empty() ? before : added, {1, 1, 1, 1});
    if (to.tangent.size() != before || more.tangent.size() != added) { // all have some, or none has
        to.tangent.clear();
        more.tangent.clear();
    }
    append(to.tangent, std::move(more.tangent));
    append(to.color, std::move(more.color));
    append(to.position, std::move(more.position));
    append(to.normal, std::move(more.normal));
    append(to.triangle, std::move(more.triangle));
}

class Binder {
public:
    Binder(SpeedtreeModel model, const Tree& tree, const Eigen::Affine3d& place, std::vector<std::string>& notes)
        : model_(std::move(model)), tree_(tree), place_(place), notes_(notes), pose_(drawn_pose(tree)),
          wood_(tree, pose_) {
        if (wood_.empty()) throw InputError(model_.name, "has a mesh, but the tree has no wood that could move it");
        complete_ends(model_.file.bones, none_);
        chains_ = chains_of(model_, place, tree, pose_, wood_, notes);
        mesh_ = std::move(model_.shown);
        part_of_.assign(model_.mesh.materials.size() + 1, -1);
    }

    OwnMesh bound() {
        for (Surface& surface : model_.mesh.surface) add_standing(std::move(surface));
        add_placed();
        return std::move(mesh_);
    }

private:
    // The last material is that of what names none.
    OwnPart& part(std::int32_t material) {
        if (material < 0) material = std::int32_t(model_.mesh.materials.size());
        std::int32_t& index = part_of_[std::size_t(material)];
        if (index < 0) {
            index = std::int32_t(mesh_.part.size());
            OwnPart made;
            made.material = material;
            const bool none = std::size_t(material) == model_.mesh.materials.size();
            made.name = none ? "none" : model_.mesh.materials[std::size_t(material)].name;
            if (!none) made.color = color_of(model_.mesh.materials[std::size_t(material)]);
            mesh_.part.push_back(std::move(made));
        }
        return mesh_.part[std::size_t(index)];
    }

    void add_standing(Surface&& surface) {
        const std::vector<std::int32_t> bone = std::move(surface.bone);
        const std::int32_t beside = chain_above(model_.file, chains_, surface.object);
        OwnPart& to = part(surface.material);
        OwnSurface from = own_surface(std::move(surface));
        const bool moved = !place_.isApprox(Eigen::Affine3d::Identity(), 0);
        for (std::size_t v = 0; v < from.position.size(); ++v) {
            if (moved) {
                from.position[v] = (place_ * Vec3(from.position[v].cast<double>())).cast<float>();
                from.normal[v] = (place_.linear() * from.normal[v].cast<double>()).cast<float>();
                if (!from.tangent.empty()) from.tangent[v] = turned(from.tangent[v]);
            }
            std::int32_t chain = bone[v] < 0 ? -1 : chains_.of_bone[std::size_t(bone[v])];
            if (chain < 0) chain = beside;
            const WoodAxes::Bound to_wood = wood_.bind(chain, from.position[v].cast<double>());
            to.body.push_back({to_wood.first, to_wood.second});
            to.second.push_back(to_wood.weight);
        }
        append(to.standing, std::move(from));
    }

    std::array<float, 4> turned(const std::array<float, 4>& tangent) const {
        const Vec3 t = place_.linear() * Vec3(tangent[0], tangent[1], tangent[2]);
        return {float(t.x()), float(t.y()), float(t.z()), tangent[3]};
    }

    // The leaf bodies of the references, -1: none. Both stand in the order of the file.
    std::vector<std::int32_t> leaf_bodies(const Eigen::Affine3d& world) const {
        std::vector<std::int32_t> body;
        for (std::size_t i = 0; i < tree_.size_bodies(); ++i)
            if (tree_.kind[i] == Kind::leaf) body.push_back(std::int32_t(i));
        std::vector<std::int32_t> found(model_.file.leaves.size(), -1);
        if (body.size() != found.size()) return found;
        double size = 0;
        for (const Vec3& p : pose_.x_w) size = std::max(size, (p - pose_.x_w.front()).norm());
        for (std::size_t k = 0; k < found.size(); ++k)
            if ((pose_.x_w[std::size_t(body[k])] - world * model_.file.leaves[k].position).norm() <= 1e-5 * size)
                found[k] = body[k];
        return found;
    }

    // Places of one material's surfaces share them.
    const std::vector<std::pair<std::int32_t, std::int32_t>>& shapes_of(const LeafReference& leaf) {
        const Shape* shape = nullptr;
        for (const Shape& s : model_.mesh.shape)
            if (s.mesh == leaf.mesh && (!shape || s.level == leaf.lod)) shape = &s;
        const auto [at, fresh] = made_.try_emplace({shape, leaf.material});
        if (!fresh || !shape) return at->second;
        for (const Surface& surface : shape->surface) {
            at->second.emplace_back(material_of(surface, leaf), std::int32_t(mesh_.shape.size()));
            mesh_.shape.push_back(own_surface(Surface(surface)));
        }
        return at->second;
    }

    std::int32_t material_of(const Surface& surface, const LeafReference& leaf) const {
        if (surface.material >= 0 || leaf.material == no_material) return surface.material;
        for (std::size_t m = 0; m < model_.mesh.materials.size(); ++m)
            if (model_.mesh.materials[m].id == leaf.material) return std::int32_t(m);
        return -1;
    }

    void add_placed() {
        const Eigen::Affine3d world = place_ * model_.world;
        const std::vector<std::int32_t> leaf_body = leaf_bodies(world);
        std::size_t bare = 0, borne = 0;
        for (std::size_t k = 0; k < model_.file.leaves.size(); ++k) {
            const LeafReference& leaf = model_.file.leaves[k];
            const auto& shapes = shapes_of(leaf);
            bare += shapes.empty();
            OwnPlace place;
            const Vec3 at = world * leaf.position;
            Mat3 turn = world.linear() * leaf.scale;
            if (leaf.angle != 0)
                turn = turn *
                       Eigen::AngleAxisd(leaf.angle * 3.14159265358979323846 / 180, leaf.axis.normalized()).matrix();
            place.turn = turn.cast<float>();
            place.place = at.cast<float>();
            place.body = leaf_body[k];
            if (place.body < 0) {
                std::int32_t chain = leaf.bone < 0 ? -1 : chains_.of_bone[std::size_t(leaf.bone)];
                if (chain < 0) chain = chain_above(model_.file, chains_, leaf.object);
                place.body = wood_.bind(chain, at).stronger();
                ++borne;
            }
            bend(place, shapes);
            for (const auto& [material, shape] : shapes) {
                place.shape = shape;
                part(material).placed.push_back(place);
            }
        }
        if (bare > 0)
            notes_.push_back(model_.name + ": " +
                             counted(bare, "leaf reference names no mesh with triangles: it is not shown",
                                     "leaf references name no mesh with triangles: they are not shown"));
        if (borne > 0)
            notes_.push_back(model_.name + ": " +
                             counted(borne, "leaf reference has no leaf body: it moves with the wood that bears it",
                                     "leaf references have no leaf bodies: they move with the wood that bears them"));
    }

    // A twig, of all its shapes.
    void bend(OwnPlace& place, const std::vector<std::pair<std::int32_t, std::int32_t>>& shapes) const {
        const auto body = std::size_t(place.body);
        if (!is_clump(tree_, body) || tree_.parent[body] < 0) return;
        for (const auto& [material, shape] : shapes)
            for (const Eigen::Vector3f& p : mesh_.shape[std::size_t(shape)].position)
                place.length = std::max(place.length, p.norm());
        if (place.length > 0) place.foot = tree_.parent[body];
    }

    SpeedtreeModel model_;
    const Tree& tree_;
    const Eigen::Affine3d place_;
    std::vector<std::string>& notes_;
    ImportNotes none_;
    const DrawnPose pose_;
    const WoodAxes wood_;
    Chains chains_;
    OwnMesh mesh_;
    std::vector<std::int32_t> part_of_; // of each material
    std::map<std::pair<const Shape*, std::int64_t>, std::vector<std::pair<std::int32_t, std::int32_t>>> made_;
};

// Where a mesh may be that goes with a skeleton: as far as a skeleton's own points may be from each other (placed_import.h).
Eigen::AlignedBox3d about_skeleton(const SpeedtreeModel& model) {
    Eigen::AlignedBox3d box;
    for (const Bone& bone : model.file.bones) {
        box.extend(model.world * bone.start);
        if (bone.has_end) box.extend(model.world * bone.end);
    }
    for (const Object& object : model.file.objects)
        for (const Vec3& p : object.spine) box.extend(model.world * p);
    Vec3 around = Vec3::Constant(largest_length);
    if (!box.isEmpty() && box.diagonal().norm() > 0)
        around.setConstant(std::min(largest_length, aloof * box.diagonal().norm()));
    const Vec3 middle = box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.center());
    return {Vec3(middle - around), Vec3(middle + around)};
}

// A leaf's material is that of the surfaces of its mesh that name none.
void check_leaf_materials(const SpeedtreeModel& model, const Fields& f) {
    if (model.mesh.materials.empty()) return;
    std::unordered_set<std::int64_t> known{-1, no_material}, plain;
    for (const MeshMaterial& material : model.mesh.materials) known.insert(material.id);
    for (const Shape& shape : model.mesh.shape)
        for (const Surface& surface : shape.surface)
            if (surface.material < 0) plain.insert(shape.mesh);
    for (const LeafReference& leaf : model.file.leaves)
        if (!known.contains(leaf.material) && plain.contains(leaf.mesh))
            f.refuse("LeafReferences", leaf.offset,
                     "Material " + std::to_string(leaf.material) + " does not exist, expected the ID of a Material");
}

} // namespace

NoOwnMesh::NoOwnMesh(const std::string& name, const std::string& advice)
    : InputError(name, "has no mesh of its own (no triangles in its objects), expected one to be moved" + advice),
      name(name) {}

bool has_speedtree_mesh(std::string_view content) {
    return content.substr(0, 65536).find("<SpeedTreeRaw") != std::string_view::npos && has_mesh(content);
}

SpeedtreeModel read_speedtree_model(std::string_view content, const std::string& path, const ImportNotes& found,
                                    ImportNotes& notes, const std::function<void()>& taken_in) {
    SpeedtreeModel model;
    model.name = input_name(path);
    model.world = world_of(found);
    model.file = parse(content, model.name);
    model.mesh = parse_mesh(content, model.name, model.file.bones, model.world, about_skeleton(model));
    check_leaf_materials(model, Fields(content, model.name));
    if (taken_in) taken_in();
    if (model.mesh.surface.empty()) throw NoOwnMesh(model.name);
    add_materials(model.mesh, model.name, folder_of(path), model.shown, notes);
    return model;
}

OwnMesh bound_to(SpeedtreeModel model, const Tree& tree, const Eigen::Affine3d& place,
                 std::vector<std::string>& notes) {
    const std::string name = model.name;
    OwnMesh mesh = Binder(std::move(model), tree, place, notes).bound();
    std::erase_if(mesh.part, [&](const OwnPart& part) { return triangles_of(mesh, part) == 0; });
    if (mesh.part.empty()) throw InputError(name, "has a mesh that nothing places, expected one to be moved");
    const auto last = std::int32_t(mesh.material.size()) - 1; // of what names none
    if (std::none_of(mesh.part.begin(), mesh.part.end(), [&](const OwnPart& part) { return part.material == last; }))
        mesh.material.pop_back();
    return mesh;
}

} // namespace bough
