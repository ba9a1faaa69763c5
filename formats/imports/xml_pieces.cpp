#include "xml_pieces.h"
#include "formats/plain_text.h"
#include <algorithm>

namespace bough {
namespace {

class Cutter {
public:
    Cutter(std::string_view content, std::size_t least) : content_(content), least_(least) {}

    std::optional<XmlPieces> cut() {
        if (content_.find('\0') != std::string_view::npos) return {};
        if (content_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
        for (;;) {
            const std::size_t begin = std::min(content_.find('<', at_), content_.size());
            if (open_.empty() && !trimmed(content_.substr(at_, begin - at_)).empty()) return {};
            if (begin == content_.size()) break;
            at_ = begin;
            const std::string_view mark = content_.substr(begin, 9);
            const bool good = mark.starts_with("<!--")                ? skip(4, "-->")
                              : mark == "<![CDATA[" && !open_.empty() ? skip(9, "]]>")
                              : mark.starts_with("<?")                ? skip(2, "?>")
                              : mark.starts_with("<!")                ? false
                              : mark.starts_with("</")                ? end_tag()
                                                                      : start_tag();
            if (!good) return {};
        }
        if (!open_.empty() || !rooted_) return {};
        return std::move(pieces_);
    }

private:
    // Over what begins with so many characters and goes on to `last`.
    bool skip(std::size_t length, std::string_view last) {
        const std::size_t end = content_.find(last, at_ + length);
        if (end == std::string_view::npos) return false;
        at_ = end + last.size();
        return true;
    }

    static bool ends_name(char c) { return is_blank(c) || c == '>' || c == '/'; }

    std::string_view name_at(std::size_t begin) const {
        std::size_t end = begin;
        while (end < content_.size() && !ends_name(content_[end])) ++end;
        return content_.substr(begin, end - begin);
    }

    bool start_tag() {
        const std::size_t begin = at_;
        const std::string_view name = name_at(begin + 1);
        if (name.empty()) return false;
        std::size_t end = begin + 1 + name.size();
        for (; end < content_.size() && content_[end] != '>'; ++end) {
            if (content_[end] == '<') return false;
            if (content_[end] != '"' && content_[end] != '\'') continue;
            end = content_.find(content_[end], end + 1);
            if (end == std::string_view::npos) return false;
        }
        if (end >= content_.size()) return false;
        at_ = end + 1;
        const bool empty = content_[end - 1] == '/';
        if (open_.empty()) {
            if (rooted_) return false;
            rooted_ = true;
            pieces_.root_tag = {begin, at_};
        } else if (open_.size() == 1) {
            pieces_.section.push_back({name, {begin, at_}, {}});
        } else if (open_.size() == 2 && !(full() || pieces_.section.back().piece.empty())) {
            pieces_.section.back().piece.back().end = at_;
        } else if (open_.size() == 2) {
            pieces_.section.back().piece.push_back({begin, at_});
        }
        if (!empty) open_.push_back(name);
        return true;
    }

    // Whether the last piece of this section takes no more.
    bool full() const {
        const std::vector<XmlPiece>& piece = pieces_.section.back().piece;
        return !piece.empty() && piece.back().end - piece.back().begin >= least_;
    }

    bool end_tag() {
        const std::string_view name = name_at(at_ + 2);
        std::size_t end = at_ + 2 + name.size();
        while (end < content_.size() && is_blank(content_[end])) ++end;
        if (end >= content_.size() || content_[end] != '>' || open_.empty() || open_.back() != name) return false;
        at_ = end + 1;
        open_.pop_back();
        if (open_.size() == 2) pieces_.section.back().piece.back().end = at_;
        return true;
    }

    std::string_view content_;
    const std::size_t least_;
    std::size_t at_ = 0;
    bool rooted_ = false;
    std::vector<std::string_view> open_; // elements that are open
    XmlPieces pieces_;
};

} // namespace

std::optional<XmlPieces> cut_xml(std::string_view content, std::size_t least) {
    return Cutter(content, least).cut();
}

} // namespace bough
