#include "dressing.h"
#include "exits.h"
#include "formats/documents/species.h"
#include "formats/open.h"

namespace bough {
namespace {

std::optional<Species> species_of(const std::string& name, const DressChoice& o) {
    if (o.look == "none") return std::nullopt;
    std::optional<Species> species = find_species(o.look.empty() ? name : o.look);
    if (species || o.look.empty()) return species && !species->leaf.none() ? species : std::nullopt;
    if (o.look.find_first_of("./") == std::string::npos)
        throw UsageError("--look is '" + o.look + "', neither none, a species (treegen --list-species) nor a file");
    return read_species(read_input(o.look), input_name(o.look));
}

std::string detail_of(const DressChoice& o, const std::string& format) {
    if (!o.leaf_detail.empty()) return o.leaf_detail;
    return has_textures(format) && o.textures != "none" ? "card" : "kite";
}

} // namespace

void add_dress_options(OptionList& list, DressChoice& o) {
    list.add("--look", o.look,
             "Species whose leaves and bark a mesh shows: a name, or a species document (the species that the tree is "
             "called after, where it is one); none: leaves are kites, parts have one colour")
        .takes("NAME|FILE");
    list.add("--leaf-detail", o.leaf_detail,
             "How its leaves are drawn: mesh, each by its outline, folded and curled; card, a rectangle whose picture "
             "cuts it out, clumps as sprays of six (the default where there are textures); kite (else)")
        .takes("NAME")
        .one_of({"kite", "card", "mesh"});
    list.add("--textures", o.textures,
             "Sides of the pictures of leaves and bark in a .glb, .usda or NAME_vat/ [pixels]: 256, 512 (default), "
             "1024; or "
             "none")
        .takes("N|none")
        .one_of({"none", "256", "512", "1024"});
}

void refuse_contradictions(const DressChoice& o, const std::string& format, bool mesh, const char* plain) {
    const char* const given = o.given();
    if (!given) return;
    if (mesh && o.look == "none" && o.leaf_detail.empty() && o.textures.empty()) return; // asks for nothing
    if (!mesh) throw UsageError(std::string(given) + ": only with a mesh");
    if (plain) throw UsageError(std::string(given) + ": not with " + plain);
    if (has_textures(format)) {
        if (!o.look.empty() && o.look != "none" && o.textures == "none" && o.leaf_detail != "mesh")
            throw UsageError("--look: not with --textures none, but with --leaf-detail mesh, as nothing would show it");
        if (o.leaf_detail == "card" && o.textures == "none")
            throw UsageError(
                "--leaf-detail card: not with --textures none, which leaves nothing to cut the leaves out");
        return;
    }
    if (!o.look.empty() && o.look != "none" && o.leaf_detail != "mesh")
        throw UsageError("--look: without --leaf-detail mesh only with .glb, .usda, NAME_vat/, whose textures show it");
    if (!o.textures.empty() && o.textures != "none") throw UsageError("--textures: only with .glb, .usda, NAME_vat/");
    if (o.leaf_detail == "card")
        throw UsageError("--leaf-detail card: only with .glb, .usda, NAME_vat/, whose textures cut the leaves out");
}

bool dresses(const DressChoice& o, const std::string& format, const char* plain) {
    return !plain && (detail_of(o, format) != "kite" || (has_textures(format) && o.textures != "none"));
}

std::string look_file(const DressChoice& o) {
    return o.look.empty() || o.look == "none" || find_species(o.look) ? "" : o.look;
}

bool has_look(const std::string& name, const DressChoice& o) {
    return species_of(name, o).has_value();
}

std::optional<OwnMesh> dressed(const Tree& tree, std::optional<int> sides, const DressChoice& o,
                               const std::string& format, const char* plain) {
    if (!dresses(o, format, plain)) return std::nullopt;
    const bool glb = has_textures(format);
    DressOptions options;
    const std::string detail = detail_of(o, format);
    if (sides) options.sides = *sides;
    if (!sides && (!glb || format == "vat"))
        options.sides = SkinOptions().sides; // as treeconvert --mesh and point caches have it
    if (format == "vat") {
        options.sprays = sprays_in_vat;
        options.clump_leaves = leaves_in_vat;
    }
    options.textures = !glb || o.textures == "none" ? 0 : o.textures.empty() ? 512 : std::stoi(o.textures);
    options.detail = detail == "card" ? LeafDetail::card : detail == "mesh" ? LeafDetail::mesh : LeafDetail::kite;
    const std::optional<Species> species = species_of(tree.name, o);
    if (!species) {
        if (o.given() && o.look != "none")
            throw UsageError(std::string(o.given()) + ": the tree is called '" + tree.name +
                             "', which is no species whose leaves are known; --look names one");
        return std::nullopt;
    }
    return dress(tree, *species, options);
}

} // namespace bough
