#include "dress.h"
#include "formats/documents/document_parts.h"
#include "formats/exports/gltf_parts.h"
#include "formats/exports/png_image.h"
#include "lib/growth/blade.h"
#include "lib/growth/clump.h"
#include "lib/model/body_shape.h"
#include "lib/model/drawn_pose.h"
#include "picture.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

// A part of a skin, by itself.
OwnPart part_of(const Skin& skin, const SkinPart& from) {
    OwnPart part;
    part.name = from.name;
    part.color = from.color;
    const VertexStretch used = vertices_of(skin, from);
    part.standing.uv.resize(1);
    for (auto v = std::size_t(used.first); v <= std::size_t(used.last); ++v) {
        part.standing.position.push_back(skin.position[v].cast<float>());
        part.standing.normal.push_back(skin.normal[v].cast<float>());
        part.standing.uv[0].push_back({skin.texture[v][0], 1 - skin.texture[v][1]});
        part.body.push_back({skin.joint[v][0], skin.joint[v][1]});
        part.second.push_back(skin.weight[v][1]);
    }
    for (std::size_t t = from.first_index; t < from.first_index + from.index_count; ++t) {
        const auto& [a, b, c] = skin.triangle[t];
        part.standing.triangle.push_back({a - used.first, b - used.first, c - used.first});
    }
    return part;
}

OwnSurface shape_of(const Blade& blade) {
    OwnSurface shape;
    for (const Vec3& p : blade.position) shape.position.push_back(p.cast<float>());
    for (const Vec3& n : blade.normal) shape.normal.push_back(n.cast<float>());
    shape.uv = {blade.uv};
    shape.triangle = blade.triangle;
    return shape;
}

OwnPlace placed(std::int32_t shape, std::size_t body, const Mat3& axes, const Vec3& foot, double length) {
    return {shape, std::int32_t(body), (length * axes).cast<float>(), foot.cast<float>()};
}

// Sprays a leaf of the clumps: six leaves make one, more where a tree has many, so that sprays are of one size all over the crown.
double sprays_of_a_leaf(const Tree& tree, std::int64_t most) {
    if (most == 0) most = std::max<std::int64_t>(5500, std::int64_t(tree.size_bodies()));
    std::int64_t leaves = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::leaf && is_clump(tree, i)) leaves += tree.leaf_count[i];
    return std::min(1 / double(spray_leaves().size()), double(most) / double(std::max<std::int64_t>(leaves, 1)));
}

constexpr double slender = 3;       // length over width
constexpr double strand_leaves = 3; // in place of a spray

bool is_strand(const Vec3& size) {
    return size.x() > slender * size.y();
}

// 0..1, how plumb the twigs of a species hang: a birch's 0.4, a willow's wholly.
double hang_of(const GrowthParameters& growth) {
    return std::clamp((-growth.level[std::size_t(growth.levels - 1)].attraction_up - 1) / 3, 0.0, 1.0);
}

// How long a clump's strands are, in sprays one after another, where twigs hang wholly.
constexpr double strung = 4;

// Places of a clump's cards, in its frame, each of a length: one by one, or as strands, of which each is a row of cards. No strand reaches below
// the tree's foot.
struct Row {
    std::int32_t most; // cards
    double hang, base; // [m] the foot's height
};
std::vector<ClumpLeaf> places_of(const Tree& tree, std::size_t i, const DrawnPose& pose, std::int32_t count,
                                 double length, const Row& row) {
    const std::int32_t strands = (count + row.most - 1) / row.most;
    const double drawn = clump_leaf_size(tree, i, strands).x();
    const Vec3 up = pose.R_wb[i].transpose() * Vec3::UnitY();
    std::vector<ClumpLeaf> cards;
    std::int64_t of = 0; // strands before
    for (const ClumpLeaf& strand : clump_leaves(tree, i, pose.R_wb[i], strands, row.hang)) {
        const auto first = count * of / strands, end = count * (of + 1) / strands;
        ++of;
        const Vec3& along = strand.axes.col(2);
        const double half = 0.5 * length * double(end - first);
        Vec3 middle = strand.foot + 0.5 * drawn * along;
        if (end - first > 1) middle += std::max(row.base - pose.at(i, middle + half * along).y(), 0.0) * up;
        for (auto k = first; k < end; ++k)
            cards.push_back({middle + (length * double(k - first) - half) * along, strand.axes});
    }
    return cards;
}

// Leaves at their places, as blades or sprays.
OwnPart leaves_of(OwnMesh& mesh, const Tree& tree, const Species& species, const DressOptions& o, const Vec3& color) {
    OwnPart part;
    part.name = "leaf";
    part.color = color;
    const double width = species.growth.leaf_scale_x;
    const bool card = o.detail == LeafDetail::card;
    const Blade blade = card ? blade_card(species.leaf, width) : blade_mesh(species.leaf, width);
    const Blade spray = spray_card(species.leaf, width);
    const auto single = std::int32_t(mesh.shape.size());
    mesh.shape.push_back(shape_of(blade));
    mesh.shape.push_back(shape_of(spray));
    mesh.shape.push_back(shape_of(spray_card(species.leaf, width, true)));
    const DrawnPose pose = drawn_pose(tree);
    const std::vector<std::int32_t> drawn_as = clump_leaves_drawn(tree, o.clump_leaves);
    const double sprays = sprays_of_a_leaf(tree, o.sprays), hang = hang_of(species.growth);
    const auto in_a_row = std::int32_t(std::lround(1 + (strung - 1) * hang));
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.kind[i] != Kind::leaf) continue;
        const double area = foliage_area(tree, i);
        if (!is_clump(tree, i)) {
            part.placed.push_back(placed(single, i, pose.R_wb[i], pose.x_w[i], std::sqrt(area / blade.area)));
            continue;
        }
        const std::int32_t leaves = tree.leaf_count[i];
        const bool sprayed = card && !is_strand(tree.size[i]);
        const double cards = (sprayed || o.sprays > 0 ? 1 : strand_leaves) * leaves * sprays;
        const std::int32_t count = card ? std::clamp(std::int32_t(std::lround(cards)), 1, leaves) : drawn_as[i];
        const double length = std::sqrt(area / count / (sprayed ? spray.area : blade.area));
        const Row row{sprayed ? in_a_row : 1, hang, pose.x_w[0].y()};
        std::int32_t other = 0; // of the two sprays
        for (const ClumpLeaf& leaf : places_of(tree, i, pose, count, length, row))
            part.placed.push_back(placed(single + (sprayed ? 1 + (other++ + std::int32_t(i)) % 2 : 0), i,
                                         pose.R_wb[i] * leaf.axes, pose.at(i, leaf.foot), length));
    }
    return part;
}

// What a skin draws of leaves and petals: kites.
void add_flat(OwnMesh& mesh, const Skin& skin, const char* name) {
    for (const SkinPart& part : skin.part)
        if (part.name == name) mesh.part.push_back(part_of(skin, part));
}

std::string texture_json(std::size_t image) {
    return "{\"index\":" + std::to_string(image) + "}";
}

// A picture of its own in the mesh; returns its number.
std::size_t add_image(OwnMesh& mesh, const char* name, const Picture& picture) {
    mesh.image.push_back({name, "image/png", png_of(picture.size, picture.size, picture.channels, picture.pixel)});
    return mesh.image.size() - 1;
}

std::string bark_material(OwnMesh& mesh, const Species& species, const Vec3& color, int size) {
    const BarkPictures pictures = bark_pictures(species.bark, color, size);
    const std::size_t base = add_image(mesh, "bark", pictures.color),
                      normal = add_image(mesh, "bark normal", pictures.normal);
    return "{\"name\":\"bark\",\"pbrMetallicRoughness\":{\"baseColorTexture\":" + texture_json(base) +
           ",\"metallicFactor\":0,\"roughnessFactor\":0.92},\"normalTexture\":" + texture_json(normal) + "}";
}

std::string leaf_material(OwnMesh& mesh, const Species& species, const std::vector<Vec3>& color,
                          const DressOptions& o) {
    const Picture picture = leaf_picture(species.leaf, species.growth.leaf_scale_x, color[1], color[0], o.textures);
    const std::string base = texture_json(add_image(mesh, "leaf", picture));
    std::string cutoff;
    append_number(cutoff, std::round(1000 * alpha_cutoff(picture)) / 1000);
    return "{\"name\":\"leaf\",\"pbrMetallicRoughness\":{\"baseColorTexture\":" + base +
           ",\"metallicFactor\":0,\"roughnessFactor\":0.6},\"doubleSided\":true" +
           (o.detail == LeafDetail::card ? ",\"alphaMode\":\"MASK\",\"alphaCutoff\":" + cutoff + "}" : "}");
}

} // namespace

OwnMesh dress(const Tree& tree, const Species& species, const DressOptions& o) {
    const std::vector<Vec3>& color = tree.color.empty() ? default_colors() : tree.color;
    const Skin skin = build_skin(tree, {o.sides, true, o.clump_leaves});
    OwnMesh mesh;
    add_flat(mesh, skin, "bark");
    if (o.detail == LeafDetail::kite || species.leaf.none())
        add_flat(mesh, skin, "leaf");
    else if (OwnPart leaves = leaves_of(mesh, tree, species, o, color[1]); !leaves.placed.empty())
        mesh.part.push_back(std::move(leaves));
    add_flat(mesh, skin, "petal");
    add_flat(mesh, skin, "fruit");
    for (std::size_t k = 0; k < mesh.part.size(); ++k) {
        OwnPart& part = mesh.part[k];
        part.material = std::int32_t(k);
        if (part.name == "bark" && o.textures > 0)
            mesh.material.push_back(bark_material(mesh, species, color[0], o.textures));
        else if (part.name == "leaf" && !part.placed.empty() && o.textures > 0)
            mesh.material.push_back(leaf_material(mesh, species, color, o));
        else
            mesh.material.push_back(gltf_material(part.name, part.color));
    }
    return mesh;
}

} // namespace bough
