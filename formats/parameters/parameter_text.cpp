// The text of a dict, read character by character: JSON's and Python's literals differ in a few characters only.
#include "formats/plain_text.h"
#include "parameter_table.h"

namespace bough {

namespace {

class Parser {
public:
    Parser(std::string_view text, const std::string& file) : text_(text), file_(file), lines_(text) {}
    ParameterTable run();

private:
    [[noreturn]] void refuse(const std::string& expected) const;
    void skip();
    void skip_head();
    bool take(char c);
    std::string string();
    std::string_view word();
    ParameterValue value();
    double number();

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
    LineCounter lines_; // of values
};

void Parser::refuse(const std::string& expected) const {
    const std::string place = file_line(file_, line_of(text_, std::min(at_, text_.size())));
    if (at_ >= text_.size()) throw InputError(place, "ends early, expected " + expected);
    std::size_t end = at_ + 1;
    while (end < text_.size() && !is_blank(text_[end]) && text_[end] != ',') ++end;
    throw InputError(place, in_ascii_quotes(text_.substr(at_, end - at_)) + ", expected " + expected);
}

void Parser::skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
        if (text_[at_] == '#')
            at_ = std::min(text_.find('\n', at_), text_.size());
        else
            ++at_;
    }
}

bool Parser::take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
}

// A byte order mark, a docstring and "params =".
void Parser::skip_head() {
    at_ = bom_size(text_);
    skip();
    for (const char* quotes : {"\"\"\"", "'''"})
        if (text_.substr(at_).starts_with(quotes)) {
            const std::size_t end = text_.find(quotes, at_ + 3);
            if (end == std::string_view::npos)
                at_ = text_.size(), refuse(std::string("the docstring's closing ") + quotes);
            at_ = end + 3;
            skip();
        }
    if (!word().empty() && !take('=')) refuse("= after the dict's name");
}

std::string_view Parser::word() {
    skip();
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) ++at_;
    return text_.substr(start, at_ - start);
}

std::string Parser::string() {
    skip();
    if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) refuse("a name in quotes");
    const char quote = text_[at_];
    const std::size_t end = text_.find(quote, at_ + 1);
    const std::string_view inner = text_.substr(at_ + 1, end == std::string_view::npos ? end : end - at_ - 1);
    if (inner.find('\n') != std::string_view::npos || end == std::string_view::npos)
        refuse("a closing quote on its line");
    if (inner.find('\\') != std::string_view::npos) refuse("text without a backslash");
    at_ = end + 1;
    return std::string(inner);
}

double Parser::number() {
    skip();
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
            (text_[at_] != '\0' && std::string_view("+-._").find(text_[at_]) != std::string_view::npos)))
        ++at_;
    const auto result = parse_number(text_.substr(start, at_ - start));
    if (!result) at_ = start, refuse("a number, true or false, text, or a list of numbers");
    return *result;
}

ParameterValue Parser::value() {
    skip();
    ParameterValue result;
    result.line = lines_.line_of(at_);
    const std::size_t start = at_;
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if (c == '"' || c == '\'') {
        result.kind = ParameterValue::Kind::text;
        result.text = string();
        return result;
    }
    if (c == '[' || c == '(') {
        result.kind = ParameterValue::Kind::list;
        const char closing = c == '[' ? ']' : ')';
        ++at_;
        while (!take(closing)) {
            result.numbers.push_back(number());
            if (take(',')) continue;
            if (!take(closing)) refuse(std::string("a comma or ") + closing);
            break;
        }
    } else if (const std::string_view flag = word();
               flag == "true" || flag == "True" || flag == "false" || flag == "False") {
        result.kind = ParameterValue::Kind::flag;
        result.numbers = {flag == "true" || flag == "True" ? 1.0 : 0.0};
    } else {
        at_ = start;
        result.numbers = {number()};
    }
    result.text = std::string(text_.substr(start, at_ - start));
    return result;
}

ParameterTable Parser::run() {
    ParameterTable table(file_);
    skip_head();
    if (!take('{')) refuse("{ of a JSON object or a Python dict");
    while (!take('}')) {
        const std::string name = string();
        if (!take(':')) refuse(": after " + in_ascii_quotes(name));
        table.add(name, value());
        if (take(',')) continue;
        if (!take('}')) refuse("a comma or }");
        break;
    }
    skip();
    if (at_ < text_.size()) refuse("nothing after the closing }");
    return table;
}

} // namespace

ParameterTable parse_parameters(std::string_view content, const std::string& file) {
    return Parser(content, file).run();
}

} // namespace bough
