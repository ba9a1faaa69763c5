#include "document_parts.h"
#include "formats/json_shape.h"
#include <algorithm>

namespace bough {
namespace {

using nlohmann::json;

// Builds a tree of values as nlohmann's own reader does, but takes no name twice and knows where it is.
class Builder : public nlohmann::json_sax<json> {
public:
    Builder(std::string_view text, const std::string& name, const std::string& at)
        : text_(text), name_(name), at_(at) {}
    json result;

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(std::int64_t value) override { return put(value); }
    bool number_unsigned(std::uint64_t value) override { return put(value); }
    bool number_float(double value, const std::string&) override { return put(value); }
    bool string(std::string& value) override { return put(std::move(value)); }
    bool binary(json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& key) override {
        keys_.back() = key;
        if (open_.back()->contains(key)) throw InputError(name_ + ": " + here(), "appears twice");
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e) override {
        syntax_error(text_, name_, 0, position, e.what(), here());
    }

private:
    std::string here() const {
        std::string at = at_;
        for (std::size_t i = 0; i < open_.size(); ++i) {
            const bool last = i + 1 == open_.size();
            if (open_[i]->is_array())
                at += "/" + std::to_string(open_[i]->size() - (last || open_[i]->empty() ? 0 : 1));
            else if (!keys_[i].empty())
                at = pointer(at, keys_[i]);
        }
        return at;
    }

    json* add(json&& value) {
        if (open_.empty()) {
            result = std::move(value);
            return &result;
        }
        json& parent = *open_.back();
        if (parent.is_object()) return &(parent[keys_.back()] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }

    bool put(json&& value) {
        add(std::move(value));
        return true;
    }

    bool open(json&& value) {
        if (open_.size() >= deepest_json) throw InputError(name_, nested_too_deep);
        open_.push_back(add(std::move(value)));
        keys_.emplace_back();
        return true;
    }

    bool close() {
        open_.pop_back();
        keys_.pop_back();
        return true;
    }

    std::string_view text_;
    const std::string &name_, &at_;
    std::vector<json*> open_; // objects and arrays around what is being read
    std::vector<std::string> keys_;
};

bool of_word(char c) {
    return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '+' || c == '-' || c == '.';
}

// Where the word began whose byte at `last` was the one too many: nlohmann's own token may begin long before.
std::size_t word_start(std::string_view text, std::size_t last, bool string) {
    if (string) {
        const auto escaped = [&](std::size_t i) { return (i - 1 - text.find_last_not_of('\\', i - 1)) % 2 == 1; };
        std::size_t open = last == 0 ? 0 : text.rfind('"', last - 1);
        while (open != std::string_view::npos && open > 0 && escaped(open)) open = text.rfind('"', open - 1);
        return open == std::string_view::npos ? last : open;
    }
    if (!of_word(text[last])) return last;
    while (last > 0 && of_word(text[last - 1])) --last;
    return last;
}

// The whole of it: "NaN", of which only the first letter was read.
std::string word_at(std::string_view text, std::size_t start) {
    std::size_t end = start;
    while (end < text.size() && end < start + 40 && of_word(text[end])) ++end;
    return std::string(text.substr(start, end - start));
}

bool is_not_finite(std::string word) {
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.erase(0, 1);
    for (char& c : word) c = char(c | 0x20); // letters to small ones
    return word == "nan" || word == "inf" || word == "infinity";
}

} // namespace

json parse_json(std::string_view text, const std::string& name, const std::string& at) {
    Builder builder(text, name, at);
    json::sax_parse(text.begin(), text.end(), &builder);
    return std::move(builder.result);
}

void syntax_error(std::string_view text, const std::string& name, std::size_t line, std::size_t position,
                  const std::string& why, const std::string& at) {
    const bool ended = position > text.size();
    const std::size_t stop = std::min(position, text.size());
    const bool whole_string = why.find("unexpected string literal") != std::string::npos;
    const std::size_t start = ended || stop == 0 ? stop : word_start(text, stop - 1, whole_string);
    const std::string_view before = text.substr(0, start);
    const std::size_t last_end = before.rfind('\n');
    const std::size_t column = start - (last_end == std::string_view::npos ? 0 : last_end + 1) + 1;
    if (line == 0) line = std::size_t(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::string in = at.empty() ? "" : at + " ";
    if (ended)
        throw InputError(name + ":" + std::to_string(line),
                         "ends here" + (at.empty() ? "" : " inside " + at) +
                             ", expected the rest of the document: is the file whole?");

    const std::string place = name + ":" + std::to_string(line) + ":" + std::to_string(column);
    const std::string word = word_at(text, start);
    if (is_not_finite(word) || why.find("number overflow") != std::string::npos)
        throw InputError(place, in + "is " + word + ", expected a finite number");
    const std::size_t reason = why.find("syntax error");
    std::string message = reason == std::string::npos ? why : why.substr(reason);
    message = message.substr(0, message.find("; "));
    std::string got;
    if (const std::size_t mark = why.rfind("; expected "); mark != std::string::npos && mark > reason)
        got = why.substr(mark + 2);
    if (got == "expected '}'" || got == "expected ']'") got = "expected ',' or " + got.substr(got.size() - 3);
    if (!got.empty() && message.find(got) == std::string::npos) message += ", " + got;
    std::string_view found = text.substr(start, 20);
    found = found.substr(0, found.find('\n', 1));
    throw InputError(place, (at.empty() ? "" : "in " + at + ": ") + message + " at " + in_quotes(found));
}

} // namespace bough
