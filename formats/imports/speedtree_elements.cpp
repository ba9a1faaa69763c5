#include "speedtree_elements.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <array>

namespace bough::speedtree {
namespace {

constexpr std::size_t piece_bytes = std::size_t(1) << 16;
constexpr std::array<std::string_view, 3> asked_for{"Bones", "Objects", "Meshes"};

} // namespace

Elements::Elements(std::string_view content, const std::string& name)
    : content_(content), name_(name), pieces_(cut_xml(content, piece_bytes)) {
    pugi::xml_document some;
    if (pieces_)
        read_tag(pieces_->root_tag, some);
    else
        load(whole_, content, pugi::parse_default);
    const pugi::xml_node root = pieces_ ? some.document_element() : whole_.document_element();
    if (std::string_view(root.name()) != "SpeedTreeRaw")
        throw InputError(name, "root element is " + in_ascii_quotes(root.name()) + ", expected SpeedTreeRaw");
    if (!pieces_) return;
    for (const XmlSection& section : pieces_->section) {
        read_tag(section.tag, some);
        if (std::find(asked_for.begin(), asked_for.end(), section.name) != asked_for.end() &&
            &section == find(section.name))
            continue;
        for (const XmlPiece& piece : section.piece) read(piece, some); // nobody else finds out whether it is XML
    }
}

// In pieces it may be broken otherwise than as a whole, which is what a message should be about.
void Elements::load(pugi::xml_document& document, std::string_view text, unsigned options) const {
    pugi::xml_parse_result result = document.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
    if (result) return;
    std::size_t offset = std::size_t(std::max(std::ptrdiff_t(0), result.offset));
    if (text.size() != content_.size()) {
        pugi::xml_document whole;
        const auto again =
            whole.load_buffer(content_.data(), content_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!again) {
            result = again;
            offset = std::size_t(std::max(std::ptrdiff_t(0), again.offset));
        } else if (text.data() >= content_.data() && text.data() < content_.data() + content_.size()) {
            offset += std::size_t(text.data() - content_.data());
        }
    }
    throw InputError(file_line(name_, line_of(content_, offset)), std::string("XML is broken (") +
                                                                      result.description() +
                                                                      "), expected a whole SpeedTree raw XML file");
}

void Elements::read(const XmlPiece& piece, pugi::xml_document& document) const {
    load(document, content_.substr(piece.begin, piece.end - piece.begin), pugi::parse_default | pugi::parse_fragment);
}

void Elements::read_tag(const XmlPiece& tag, pugi::xml_document& document) const {
    std::string text(content_.substr(tag.begin, tag.end - tag.begin));
    if (text[text.size() - 2] != '/') text.insert(text.size() - 1, "/");
    load(document, text, pugi::parse_default);
}

const XmlSection* Elements::find(std::string_view name) const {
    const auto found = std::find_if(pieces_->section.begin(), pieces_->section.end(),
                                    [&](const XmlSection& s) { return s.name == name; });
    return found == pieces_->section.end() ? nullptr : &*found;
}

void Elements::root(const Take& take) const {
    if (!pieces_) return take(whole_.document_element(), Fields(content_, name_));
    pugi::xml_document document;
    read_tag(pieces_->root_tag, document);
    take(document.document_element(), Fields(content_, name_, pieces_->root_tag.begin));
}

void Elements::section(const char* name, const Take& take) const {
    if (!pieces_) {
        if (const pugi::xml_node node = whole_.document_element().child(name)) take(node, Fields(content_, name_));
        return;
    }
    const XmlSection* const section = find(name);
    if (!section) return;
    pugi::xml_document document;
    read_tag(section->tag, document);
    take(document.document_element(), Fields(content_, name_, section->tag.begin));
}

void Elements::each(const char* section, const char* child, const Take& take) const {
    if (!pieces_) {
        const Fields fields(content_, name_);
        for (const pugi::xml_node& node : whole_.document_element().child(section).children(child)) take(node, fields);
        return;
    }
    const XmlSection* const found = find(section);
    if (!found) return;
    pugi::xml_document document;
    for (const XmlPiece& piece : found->piece) {
        read(piece, document);
        const Fields fields(content_, name_, piece.begin);
        for (const pugi::xml_node& node : document.children(child)) take(node, fields);
    }
}

} // namespace bough::speedtree
