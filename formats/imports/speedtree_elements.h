// speedtree_elements.h: the elements of a SpeedTree file one after another, read a piece of the file at a time, as a document
// tree of all of it takes several times its size.
#pragma once
#include "speedtree_fields.h"
#include "xml_pieces.h"
#include <functional>
#include <optional>

namespace bough::speedtree {

class Elements {
public:
    using Take = std::function<void(const pugi::xml_node&, const Fields&)>; // the fields are those of the node

    // The content must outlive it. Throws InputError FILE:LINE for broken XML and for another root than SpeedTreeRaw; what
    // is broken within elements that are asked for is told then. A file that cannot be cut is held as a whole.
    Elements(std::string_view content, const std::string& name);

    void root(const Take&) const;                                         // has attributes alone
    void section(const char* name, const Take&) const;                    // first of this name in the root, likewise
    void each(const char* section, const char* child, const Take&) const; // whole children of that one, in order

private:
    void load(pugi::xml_document&, std::string_view text, unsigned options) const;
    void read(const XmlPiece&, pugi::xml_document&) const;
    void read_tag(const XmlPiece&, pugi::xml_document&) const;
    const XmlSection* find(std::string_view name) const;

    std::string_view content_;
    std::string name_;
    std::optional<XmlPieces> pieces_;
    pugi::xml_document whole_; // empty unless the file cannot be cut
};

} // namespace bough::speedtree
