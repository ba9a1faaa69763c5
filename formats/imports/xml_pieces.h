// xml_pieces.h: an XML file cut at the borders of elements, so that it can be read piece by piece and no document tree of all
// of it stands in memory.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace bough {

struct XmlPiece {
    std::size_t begin = 0, end = 0; // offsets in the file
};

struct XmlSection { // a child of the root
    std::string_view name;
    XmlPiece tag;                // its start tag, or all of it where it is an empty one
    std::vector<XmlPiece> piece; // one or more of its children each, in order, with what stands between them
};

struct XmlPieces {
    XmlPiece root_tag;
    std::vector<XmlSection> section;
};

// Cuts at children of the root's children, into pieces of at least `least` bytes where there is so much. Start and end tags
// are matched; what stands in pieces and tags is still to be read, and may be wrong. Nothing where the file is no XML, or
// has what is better read as a whole (a document type, zeros, text around the root). O(bytes), no recursion.
std::optional<XmlPieces> cut_xml(std::string_view content, std::size_t least);

} // namespace bough
