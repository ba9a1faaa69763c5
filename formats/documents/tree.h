// tree.h: the tree document, "bough-tree" (formats/documents/README.md), JSON or safetensors by content.
#pragma once
#include "formats/open.h"
#include "lib/model/tree.h"

namespace bough {

bool is_tree(std::string_view content);
Tree read_tree(std::string_view content, const std::string& name);
Tree read_tree(const Input&); // of a file in the binary form, never all of it in memory beside the tree
void write_tree(Output&, const Tree&, Form);

} // namespace bough
