// converted.h: a tree of any file that holds one: our own document as it is, splines and other programs' trees as treeconvert makes
// bodies of them where it is given no options.
#pragma once
#include "formats/imports/import.h"
#include "formats/open.h"
#include "lib/model/tree.h"

namespace bough {

struct TreeOfFile {
    Tree tree;
    // Of a file that was converted: what its reader found, and notes with the file's name, the last of them how to convert it by hand.
    std::optional<ImportNotes> imported;
    std::vector<std::string> notes;
};

// Whether a file is converted before it moves: neither a tree of ours nor a broken document of ours. Looks at its head; false for stdin.
bool is_converted(const std::string& file);
// Throws InputError: files that hold no tree, and those that are broken.
TreeOfFile read_any_tree(const std::string& file);
// The same of an input that is open, as stdin must be.
TreeOfFile read_any_tree(const Input&, const std::string& file);

} // namespace bough
