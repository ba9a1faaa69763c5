// speedtree.cpp: SpeedTree raw XML, <SpeedTreeRaw>: branches from the spines where the file has any, else from the bones,
// as thick as the bark that it holds; leaves from the leaf references. Mesh and materials are speedtree_mesh.h; Mass is not read.
#include "formats/plain_text.h"
#include "speedtree_bark.h"
#include "speedtree_bones.h"
#include "speedtree_leaves.h"
#include "speedtree_spines.h"

namespace bough {
namespace {

using namespace speedtree;

bool recognizes_speedtree(std::string_view content) {
    return content.substr(0, 65536).find("<SpeedTreeRaw") != std::string_view::npos;
}

// A leaf object's place in the object tree names its branch exactly; merged leaf objects have only their bones.
std::vector<std::int32_t> hosts_by_object(const File& file, const SpineBranches& spines) {
    std::vector<std::int32_t> host;
    host.reserve(file.leaves.size());
    for (const LeafReference& leaf : file.leaves) {
        const std::int32_t by_object = spines.branch_of_object[leaf.object];
        host.push_back(by_object < 0 && leaf.bone >= 0 ? spines.branch_of_bone[leaf.bone] : by_object);
    }
    return host;
}

std::vector<std::int32_t> hosts_by_bone(const File& file, const BoneBranches& bones) {
    std::vector<std::int32_t> host;
    host.reserve(file.leaves.size());
    for (const LeafReference& leaf : file.leaves) host.push_back(leaf.bone < 0 ? -1 : bones.branch_of[leaf.bone]);
    return host;
}

std::string tree_name(const File& file) {
    for (const Object& o : file.objects)
        if (o.parent < 0) return o.name;
    return {};
}

Splines read_speedtree(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    File file = parse(content, options.name);
    if (file.bones.empty() && !file.has_spines())
        throw InputError(options.name, "has no skeleton (neither Spine nor Bone); export it from SpeedTree as Raw XML "
                                       "with spines or bones switched on");
    BarkSurface bark; // where bones are all that tells of radii
    if (!file.has_spines()) bark = parse_bark(content, options.name, file.bones);
    options.let_go();
    ImportedTree tree;
    tree.name = tree_name(file);
    tree.source = "SpeedTree raw XML" + (file.version.empty() ? "" : " " + file.version) + " " + options.name +
                  (file.source.empty() ? "" : " (" + file.source + ")");
    tree.unit = file.unit;
    tree.up = file.up;
    if (file.has_spines()) {
        ImportNotes about_bones; // here bones only measure spines, nobody needs to know what they lack
        complete_ends(file.bones, about_bones);
        SpineBranches spines =
            branches_of_spines(file, branches_of_bones(file.bones), options.unit ? options.unit : file.unit, notes);
        tree.leaves = leaves_of(file, hosts_by_object(file, spines), notes);
        tree.branches = std::move(spines.branches);
    } else {
        complete_ends(file.bones, notes);
        take_bark_radii(std::move(bark), file.bones, notes);
        complete_radii(file.bones, notes);
        BoneBranches bones = branches_of_bones(file.bones);
        tree.leaves = leaves_of(file, hosts_by_bone(file, bones), notes);
        tree.branches = std::move(bones.branches);
    }
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat speedtree_format{"SpeedTree raw XML", recognizes_speedtree, read_speedtree};

} // namespace bough
