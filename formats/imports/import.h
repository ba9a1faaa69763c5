// import.h: splines from any file we can read: our own document or another program's. A format is one file of this
// folder or of models/ with a struct SplineFormat; which one a file has is decided by its content, never by its name alone.
#pragma once
#include "formats/open.h"
#include "import_notes.h"
#include "lib/model/splines.h"
#include <functional>
#include <optional>
#include <vector>

namespace bough {

struct ImportOptions {
    // [m] one unit of the file; absent: the file's own statement, else a guess with its reason
    std::optional<double> unit;
    char up = 0;                          // 'y' or 'z' for the file's up axis; 0: as above
    std::optional<double> trunk_diameter; // [m] of the thickest trunk at its base: all radii are multiplied alike
    bool keep_place = false;              // leaves the tree where the file has it, off the ground too (placed_import.h)
    std::string name;                     // how the file is called in messages
    std::string folder;                   // where files stand that it names (a .gltf's buffers); "": nowhere
    // Called by a reader that has taken the content in, before it makes a tree of it: whoever holds the content may give
    // its memory back meanwhile. It must stay readable, as messages look for lines in it. May be empty.
    std::function<void()> taken_in;

    void let_go() const {
        if (taken_in) taken_in();
    }
};

struct SplineFormat {
    const char* name;                                                              // "SpeedTree raw XML"
    bool (*recognizes)(std::string_view content);                                  // cheap: the head of the file
    Splines (*read)(std::string_view content, const ImportOptions&, ImportNotes&); // throws InputError
};

extern const SplineFormat armature_format;        // models/armature_format.cpp
extern const SplineFormat speedtree_format;       // speedtree.cpp
extern const SplineFormat treetools_format;       // treetools.cpp
extern const SplineFormat swc_format;             // swc.cpp
extern const SplineFormat obj_format;             // obj_skeleton.cpp
extern const SplineFormat ply_format;             // ply_graph.cpp
extern const SplineFormat sapling_table_format;   // sapling_table.cpp
extern const SplineFormat sapling_curves_format;  // sapling_curves.cpp
extern const SplineFormat cylinder_table_format;  // cylinder_table.cpp
extern const SplineFormat mtg_format;             // mtg.cpp
extern const SplineFormat eztree_branches_format; // eztree_branches.cpp

// Our own splines document, or the first format that recognizes the content. Throws InputError that lists what could
// be read, with advice for well-known files that cannot (refused.h).
Splines import_splines(std::string_view content, const ImportOptions&, ImportNotes&);

// Whether a reader takes the content, by its head alone; it may still find it broken. `name`: its ending decides for damaged files.
bool is_importable(std::string_view content, const std::string& name);

} // namespace bough
