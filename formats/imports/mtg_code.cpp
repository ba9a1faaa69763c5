#include "mtg_code.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <array>
#include <optional>

namespace bough::mtg {
namespace {

bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Lines without comments and without the blanks at their end, not blank.
class Lines {
public:
    explicit Lines(std::string_view content) : content_(content), at_(bom_size(content)) {}
    bool next(std::string_view& line) {
        while (at_ < content_.size()) {
            const std::size_t end = std::min(content_.find('\n', at_), content_.size());
            line = content_.substr(at_, end - at_);
            at_ = end + 1;
            ++number;
            line = line.substr(0, std::min(line.find('#'), line.size()));
            while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
            if (!line.empty()) return true;
        }
        return false;
    }
    std::size_t number = 0;

private:
    std::string_view content_;
    std::size_t at_ = 0;
};

// "FEATURES :" -> "FEATURES"; empty for a line that is no section.
std::string_view section_of(std::string_view line) {
    std::size_t at = 0;
    const std::string_view word = next_token(line, at);
    const std::string_view name = word.substr(0, word.find(':'));
    const std::string_view rest = trimmed(line.substr(at));
    if (name.size() == word.size() && rest.substr(0, 1) != ":") return {};
    for (const char* section : {"CODE", "CLASSES", "DESCRIPTION", "FEATURES", "MTG"})
        if (name == section) return name;
    return {};
}

// Scale of each class, by its letters.
struct Classes {
    std::vector<std::pair<std::string_view, std::int64_t>> scale;
    std::optional<std::int64_t> find(std::string_view name) const {
        for (const auto& [n, s] : scale)
            if (n == name) return s;
        return {};
    }
};

class Parser {
public:
    Parser(std::string_view content, const std::string& name) : lines_(content), name_(name) {}
    File parse();

private:
    // The last entity, and one of a coarser scale whose parts come next; each as the vertex it is or comes from.
    struct At {
        std::int32_t fine = -1, whole = -1;
        std::int64_t scale = -1; // of the last entity, -1: none yet
        bool parts_next = false;
    };
    [[noreturn]] void refuse(const std::string& message) const {
        throw InputError(file_line(name_, lines_.number), message);
    }
    void add_class(std::string_view line);
    void add_features(std::string_view line);
    void go_on_from(std::string_view code, std::size_t indent);
    void open(char edge);
    void close();
    void entities(std::string_view code, std::string_view row);
    void add(char edge, std::int64_t scale, std::string_view row);

    Lines lines_;
    const std::string& name_;
    File file_;
    Classes classes_;
    At at_;
    std::vector<std::size_t> indent_{0};
    std::vector<char> edge_; // that each open line began with
    std::vector<At> opened_; // where the lines that began with '/' or '+' did
};

void Parser::add_class(std::string_view line) {
    std::size_t at = 0;
    const std::string_view symbol = next_token(line, at);
    if (symbol == "SYMBOL") return;
    const std::string_view token = next_token(line, at);
    const auto scale = parse_integer(token);
    if (!scale || *scale < 0)
        refuse("class " + in_ascii_quotes(symbol) + " has the scale " + in_ascii_quotes(token) +
               ", expected a whole number");
    classes_.scale.emplace_back(symbol, *scale);
}

void Parser::add_features(std::string_view line) {
    file_.line_of_features = lines_.number;
    std::size_t cell = 0;
    for (std::size_t at = 0; at <= line.size(); ++cell) {
        const std::size_t tab = std::min(line.find('\t', at), line.size());
        const std::string_view name = trimmed(line.substr(at, tab - at));
        at = tab + 1;
        if (cell == 0 || name.empty()) continue;
        if (file_.features.empty()) file_.first_feature = cell;
        file_.features.push_back(name);
    }
}

void Parser::open(char edge) {
    edge_.push_back(edge);
    if (edge != '<') opened_.push_back(at_);
}

void Parser::close() {
    if (edge_.empty()) return;
    const char edge = edge_.back();
    edge_.pop_back();
    if (edge == '<' || opened_.empty()) return;
    at_ = opened_.back();
    at_.parts_next = false;
    opened_.pop_back();
}

// Moves to where a line of this indentation goes on from.
void Parser::go_on_from(std::string_view code, std::size_t indent) {
    const char first = code.front() == '^' && code.size() > 1 ? code[1] : code.front();
    if (indent > indent_.back()) {
        indent_.push_back(indent);
        return open(first);
    }
    for (; indent < indent_.back(); indent_.pop_back()) close();
    if (indent != indent_.back())
        refuse("is indented by " + std::to_string(indent) + " tabs, expected those of a line before");
    if (code.front() == '^' || first == '<' || edge_.empty()) return;
    if (edge_.back() != '<') close();
    open(first);
}

// Only the last entity of a line becomes a vertex: the others have no features, so what comes from them comes from
// where they do.
void Parser::add(char edge, std::int64_t scale, std::string_view row) {
    const bool new_plant = edge == '/' && scale <= 1;
    std::int32_t index = new_plant ? -1 : edge == '/' && at_.parts_next ? at_.whole : at_.fine;
    if (!row.empty()) {
        file_.vertices.push_back({index, lines_.number, row});
        index = std::int32_t(file_.vertices.size()) - 1;
    }
    if (new_plant || scale >= at_.scale) {
        at_ = {index, -1, scale, false};
    } else {
        at_.whole = index;
        at_.parts_next = true;
    }
}

void Parser::entities(std::string_view code, std::string_view row) {
    std::size_t at = code.front() == '^' ? 1 : 0;
    std::int64_t index_before = -1;
    while (at < code.size()) {
        const char edge = code[at];
        if (edge != '/' && edge != '<' && edge != '+')
            refuse(in_ascii_quotes(code.substr(at)) + " does not begin with an edge, expected '/', '<' or '+'");
        const bool many = edge == '<' && code.substr(at, 2) == "<<";
        at += many ? 2 : 1;
        const std::size_t name = at;
        while (at < code.size() && is_letter(code[at])) ++at;
        const std::size_t number = at;
        while (at < code.size() && is_digit(code[at])) ++at;
        const std::string_view symbol = code.substr(name, number - name);
        const auto scale = classes_.find(symbol);
        if (!scale)
            refuse("entity " + in_ascii_quotes(code.substr(name, at - name)) + " is of no class that CLASSES names");
        const std::int64_t index = parse_integer(code.substr(number, at - number)).value_or(-1);
        file_.entities += many && index > index_before && index_before >= 0 ? std::size_t(index - index_before) : 1;
        index_before = index;
        add(edge, *scale, at < code.size() ? std::string_view() : row);
    }
}

File Parser::parse() {
    std::string_view line, section;
    bool has_header = false;
    while (lines_.next(line)) {
        if (section != "MTG") {
            const std::string_view next = section_of(line);
            if (!next.empty())
                section = next;
            else if (section == "CLASSES")
                add_class(line);
            continue;
        }
        if (!has_header) {
            std::size_t at = 0;
            const std::string_view word = next_token(line, at);
            if (word != "ENTITY-CODE" && word != "TOPO")
                refuse("begins with " + in_ascii_quotes(word) + ", expected ENTITY-CODE and the names of features");
            add_features(line);
            has_header = true;
            continue;
        }
        const std::size_t indent = line.find_first_not_of('\t');
        if (!file_.features.empty() && indent >= file_.first_feature)
            refuse("has no entity before column " + std::to_string(file_.first_feature + 1) + " of the features");
        std::size_t at = indent;
        const std::string_view code = next_token(line, at);
        if (code.front() == '*') {
            ++file_.dates;
            continue;
        }
        go_on_from(code, indent);
        entities(code, line);
    }
    if (!has_header)
        throw InputError(name_, "ends before the section MTG, expected CODE, CLASSES, DESCRIPTION, FEATURES and MTG");
    return std::move(file_);
}

} // namespace

File parse(std::string_view content, const std::string& name) {
    return Parser(content, name).parse();
}

std::string_view cell(const File& file, const Vertex& v, std::size_t feature) {
    std::string_view row = v.row;
    for (std::size_t k = file.first_feature + feature; k > 0; --k) {
        const std::size_t tab = row.find('\t');
        if (tab == std::string_view::npos) return {};
        row.remove_prefix(tab + 1);
    }
    return trimmed(row.substr(0, row.find('\t')));
}

} // namespace bough::mtg
