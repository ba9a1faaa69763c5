/* bough_imports.h: trees of other programs, from bytes: SpeedTree's XML, scans (TreeQSM, SimpleForest, treetools, PLY skeletons), SWC, MTG, Sapling's curves,
 * ez-tree's branches, OBJ lines, armatures and lines of glTF (formats/imports/README.md). For C and C++; link bough_imports (pkg-config bough_imports, in C++
 * beside bough; CMake's bough::imports). FBX, COLLADA and what meshoptimizer compressed are the tools' alone: the message has the line of treeconvert's.
 *
 *   bough::Tree tree = bough::import_tree(bytes, "maple.xml");    // or bough_import_tree(bytes, size, "maple.xml", NULL, &tree)
 *
 * `bytes` are the whole file, and may be anything: what is broken is an error, never more. What they are is told by them; `name` stands in messages, and
 * its ending tells what a damaged file was to be. `folder` is where a .gltf file's buffers are looked for, there and below, links followed; empty or NULL: nothing is
 * opened. Nothing is printed. Lengths are in metres afterwards, y is up, the tree's foot at the origin; what had to be guessed is a note.
 * Cost: about O(size), on as many threads as there are cores; memory 4 MB and 1000 bytes for each byte of the file at most. Any thread may call. */
#ifndef BOUGH_IMPORTS_H
#define BOUGH_IMPORTS_H

#include "bough_c.h"

#ifdef __cplusplus
#include "bough.h"
#include <string>
#include <string_view>
#include <vector>

namespace bough {

// Returns the tree's branches as curves, for convert(). It reads bough's own bough-splines too. Adds to `notes`, unless null, the format, and then a
// line for each guess and repair. Throws InputError (error.h), in the words of bough's tools.
Splines import_splines(std::string_view bytes, const std::string& name, const std::string& folder = {},
                       std::vector<std::string>* notes = nullptr);

// Returns the rigid bodies that `treeconvert FILE` makes without options, so that the tree moves alike. A bough-tree document is read as it is,
// without notes.
Tree import_tree(std::string_view bytes, const std::string& name, const std::string& folder = {},
                 std::vector<std::string>* notes = nullptr);

} // namespace bough

extern "C" {
#endif

/* As above. `name` NULL: "<memory>". BOUGH_INPUT for what cannot be read; bough_error() has the message. */
bough_result bough_import_splines(const void* bytes, size_t size, const char* name, const char* folder,
                                  bough_splines** splines);
bough_result bough_import_tree(const void* bytes, size_t size, const char* name, const char* folder, bough_tree** tree);

/* Of this thread's last import that was BOUGH_OK: the notes, a line each, "" for none. Valid until its next import. */
const char* bough_import_notes(void);

#ifdef __cplusplus
}
#endif
#endif
