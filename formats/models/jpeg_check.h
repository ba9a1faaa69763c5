// jpeg_check.h: what is looked at in a JPEG before stb_image reads it (private to this folder).
#pragma once
#include <string_view>

namespace bough {

// Whether each Huffman table that a decoder could meet has at most 256 codes: Debian 12's stb_image writes the lengths of more behind the end of
// an array. Segments are followed up to the first scan, and their tables have to end where they do; behind it, where FF C4 stands for nothing but a
// table, each of these is looked at.
// O(bytes).
bool jpeg_tables_fit(std::string_view jpeg);

} // namespace bough
