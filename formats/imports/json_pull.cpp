#include "json_pull.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <vector>

namespace bough {

JsonPull::JsonPull(std::string_view text, const std::string& name) : text_(text), name_(name), at_(bom_size(text)) {}

void JsonPull::refuse(const std::string& message) const {
    throw InputError(file_line(name_, line_of(text_, at_)), message);
}

void JsonPull::blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

char JsonPull::peek() {
    blanks();
    if (at_ == text_.size()) refuse("the JSON text ends early");
    return text_[at_];
}

void JsonPull::begin(char bracket) {
    if (peek() != bracket) refuse(std::string("expected ") + (bracket == '{' ? "an object" : "an array"));
    ++at_;
    first_ = true;
}

bool JsonPull::next(char close) {
    const bool first = first_;
    first_ = false;
    if (peek() == close) {
        ++at_;
        return false;
    }
    if (first) return true;
    if (text_[at_] != ',') refuse(std::string("expected , or ") + close);
    ++at_;
    return true;
}

bool JsonPull::next_key(std::string_view& key) {
    if (!next('}')) return false;
    key = string();
    if (peek() != ':') refuse("expected : after " + in_ascii_quotes(key));
    ++at_;
    return true;
}

bool JsonPull::next_item() {
    return next(']');
}

std::string_view JsonPull::string() {
    if (peek() != '"') refuse("expected a text in quotes");
    const std::size_t start = ++at_;
    for (;; ++at_) {
        if (at_ >= text_.size()) refuse("the JSON text ends early");
        if (text_[at_] == '\\')
            ++at_;
        else if (text_[at_] == '"')
            return text_.substr(start, at_++ - start);
    }
}

std::string_view JsonPull::word() {
    peek();
    const std::size_t start = at_;
    const auto ends = [](char c) { return is_blank(c) || c == ',' || c == ']' || c == '}' || c == ':'; };
    while (at_ < text_.size() && !ends(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
}

double JsonPull::number() {
    const std::string_view token = word();
    const auto value = parse_number(token);
    if (!value) refuse(in_ascii_quotes(token) + ", expected a finite number");
    return *value;
}

bool JsonPull::boolean() {
    const std::string_view token = word();
    if (token != "true" && token != "false") refuse(in_ascii_quotes(token) + ", expected true or false");
    return token == "true";
}

void JsonPull::skip() {
    std::vector<char> open; // brackets to be closed
    std::string_view key;
    do {
        if (!open.empty() && !(open.back() == '}' ? next_key(key) : next_item())) {
            open.pop_back();
            continue;
        }
        const char c = peek();
        if (c == '{' || c == '[') {
            begin(c);
            open.push_back(c == '{' ? '}' : ']');
        } else if (c == '"') {
            string();
        } else if (const std::string_view token = word();
                   token != "true" && token != "false" && token != "null" && !parse_number(token)) {
            refuse(in_ascii_quotes(token) + " is no value");
        }
    } while (!open.empty());
}

void JsonPull::end() {
    blanks();
    if (at_ < text_.size()) refuse("expected the end of the JSON text");
}

} // namespace bough
