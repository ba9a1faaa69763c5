// dressing.h: --look, --leaf-detail, --textures: how a tree's leaves and bark are drawn (formats/models/dress.h).
#pragma once
#include "formats/models/dress.h"
#include "option_list.h"
#include <optional>

namespace bough {

struct DressChoice {
    std::string look;        // a species, a species document, "none"; empty: the species that the tree is called after
    std::string leaf_detail; // "kite", "card", "mesh"; empty: card where there are textures, else kite
    std::string textures;    // "none" or a number; empty: 512 where a format has them, else none
    const char* given() const {
        return !look.empty()          ? "--look"
               : !leaf_detail.empty() ? "--leaf-detail"
               : !textures.empty()    ? "--textures"
                                      : nullptr;
    }
};
// A vertex animation texture holds 8192 vertices, four of a spray, eight of a leaf: of clumps no more than
constexpr int sprays_in_vat = 1000, leaves_in_vat = 500;

// Whether a mesh of that format has textures.
inline bool has_textures(const std::string& format) {
    return format == "glb" || format == "usda" || format == "vat";
}
void add_dress_options(OptionList&, DressChoice&);

// Throws UsageError where an option is given for a mesh of that format (glb, usda, vat, obj, mdd, pc2) that cannot have it, or for none. plain: an
// option that asks for leaves as they are without species, by name; null: none.
void refuse_contradictions(const DressChoice&, const std::string& format, bool mesh, const char* plain);

// Whether `dressed` gives any tree of that format leaves or textures.
bool dresses(const DressChoice&, const std::string& format, const char* plain);
// The file that --look names, "" where it names none.
std::string look_file(const DressChoice&);
// Whether a tree's look is known: by its name, or by --look. Throws as `dressed` does.
bool has_look(const std::string& name, const DressChoice&);

// The tree as its species looks; nothing where it has none, or where leaves are kites and nothing is textured. Throws UsageError for a species that
// is not known, InputError for a document that is wrong.
std::optional<OwnMesh> dressed(const Tree&, std::optional<int> sides, const DressChoice&, const std::string& format,
                               const char* plain);

} // namespace bough
