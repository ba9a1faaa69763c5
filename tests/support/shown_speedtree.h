// shown_speedtree.h: a SpeedTree file as a tree with its own mesh bound to it.
#pragma once
#include "formats/imports/import.h"
#include "formats/models/speedtree_model.h"
#include "lib/growth/segment.h"

namespace bough::test {

struct Shown {
    Tree tree;
    OwnMesh mesh;
    std::vector<std::string> notes;
};

// stands: the tree where it was put, null where an import puts it.
inline Shown shown_of(const std::string& content, const Eigen::Affine3d& place = Eigen::Affine3d::Identity(),
                      const Tree* stands = nullptr) {
    Shown made;
    ImportNotes found, notes;
    ImportOptions options;
    options.name = "t.xml";
    made.tree = segment(import_splines(content, options, found), wood_presets().front(), {});
    if (stands) made.tree = *stands;
    SpeedtreeModel model = read_speedtree_model(content, "t.xml", found, notes);
    made.notes = notes.lines;
    made.mesh = bound_to(std::move(model), made.tree, place, made.notes);
    return made;
}

} // namespace bough::test
