#include "ply_elements.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

namespace bough {
namespace {

struct TypeName {
    const char* name;
    PlyType type;
};
constexpr TypeName type_names[] = {
    {"char", PlyType::i8},   {"int8", PlyType::i8},     {"uchar", PlyType::u8},   {"uint8", PlyType::u8},
    {"short", PlyType::i16}, {"int16", PlyType::i16},   {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
    {"int", PlyType::i32},   {"int32", PlyType::i32},   {"uint", PlyType::u32},   {"uint32", PlyType::u32},
    {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64}};

std::size_t size_of(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[std::size_t(type)];
}

class HeaderReader {
public:
    HeaderReader(std::string_view content, const std::string& name) : content_(content), name_(name) {}

    PlyHeader read() {
        bool has_form = false;
        if (line() != "ply") refuse("does not begin with ply");
        for (;;) {
            if (at_ >= content_.size()) refuse("the header ends without end_header");
            const std::string_view text = line();
            std::size_t in = 0;
            const std::string_view key = next_token(text, in);
            if (key.empty() || key == "comment" || key == "obj_info") continue;
            if (key == "end_header") break;
            if (key == "format") {
                take_form(next_token(text, in));
                has_form = true;
            } else if (key == "element") {
                take_element(text, in);
            } else if (key == "property") {
                take_property(text, in);
            } else {
                refuse(in_ascii_quotes(key) + " is no line of a PLY header");
            }
        }
        if (!has_form) refuse("has no format line, expected ascii, binary_little_endian or binary_big_endian");
        header_.data = at_;
        header_.lines = number_;
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse(const std::string& message) const { throw InputError(file_line(name_, number_), message); }

    std::string_view line() {
        // Old Mac programs end lines with CR alone; what follows the header may begin with any byte.
        const char last = content_.size() > 4 && content_[3] == '\r' && content_[4] != '\n' ? '\r' : '\n';
        const std::size_t end = std::min(content_.find(last, at_), content_.size());
        const std::string_view text = trimmed(content_.substr(at_, end - at_));
        at_ = std::min(end + 1, content_.size());
        ++number_;
        return text;
    }

    void take_form(std::string_view form) {
        if (form == "ascii")
            header_.form = PlyHeader::Form::ascii;
        else if (form == "binary_little_endian")
            header_.form = PlyHeader::Form::little;
        else if (form == "binary_big_endian")
            header_.form = PlyHeader::Form::big;
        else
            refuse("format " + in_ascii_quotes(form) + ", expected ascii, binary_little_endian or binary_big_endian");
    }

    void take_element(std::string_view text, std::size_t in) {
        PlyElement element;
        element.name = std::string(next_token(text, in));
        const auto count = parse_integer(next_token(text, in));
        if (!count || *count < 0) refuse("element without a count, expected: element NAME COUNT");
        element.count = std::uint64_t(*count);
        header_.element.push_back(std::move(element));
    }

    PlyType type(std::string_view name) const {
        for (const TypeName& t : type_names)
            if (name == t.name) return t.type;
        refuse(in_ascii_quotes(name) + " is no type of a property");
    }

    void take_property(std::string_view text, std::size_t in) {
        if (header_.element.empty()) refuse("property before any element");
        PlyProperty property;
        std::string_view first = next_token(text, in);
        property.list = first == "list";
        if (property.list) {
            property.count = type(next_token(text, in));
            if (property.count >= PlyType::f32) refuse("the count of a list is no integer");
            first = next_token(text, in);
        }
        property.type = type(first);
        property.name = std::string(next_token(text, in));
        header_.element.back().property.push_back(std::move(property));
    }

    std::string_view content_;
    const std::string& name_;
    std::size_t at_ = 0, number_ = 0;
    PlyHeader header_;
};

// What an entry takes at the least, in a file of this form.
std::size_t least_bytes(const PlyElement& element, PlyHeader::Form form) {
    std::size_t bytes = 0;
    for (const PlyProperty& p : element.property)
        bytes += form == PlyHeader::Form::ascii ? 2 : size_of(p.list ? p.count : p.type);
    return bytes;
}

template <class T> T swapped(const char* bytes, bool swap) {
    char copy[sizeof(T)];
    std::memcpy(copy, bytes, sizeof(T));
    if (swap) std::reverse(copy, copy + sizeof(T));
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
}

double decoded(const char* bytes, PlyType type, bool swap) {
    switch (type) {
    case PlyType::i8:
        return double(swapped<std::int8_t>(bytes, swap));
    case PlyType::u8:
        return double(swapped<std::uint8_t>(bytes, swap));
    case PlyType::i16:
        return double(swapped<std::int16_t>(bytes, swap));
    case PlyType::u16:
        return double(swapped<std::uint16_t>(bytes, swap));
    case PlyType::i32:
        return double(swapped<std::int32_t>(bytes, swap));
    case PlyType::u32:
        return double(swapped<std::uint32_t>(bytes, swap));
    case PlyType::f32:
        return double(swapped<float>(bytes, swap));
    case PlyType::f64:
        return swapped<double>(bytes, swap);
    }
    return 0;
}

class DataReader {
public:
    DataReader(std::string_view content, const PlyHeader& header, const std::string& name)
        : content_(content), at_(header.data), ascii_(header.form == PlyHeader::Form::ascii),
          swap_((header.form == PlyHeader::Form::big) != (std::endian::native == std::endian::big)) {
        entry_.name = &name;
        entry_.line = ascii_ ? header.lines + 1 : 0;
    }

    // Entries of this element follow.
    void begin(const PlyElement& element) {
        entry_.element = &element;
        const auto is_list = [](const PlyProperty& p) { return p.list; };
        lists_ = std::any_of(element.property.begin(), element.property.end(), is_list);
        entry_.values.resize(element.property.size());
        entry_.first.resize(element.property.size() + 1);
        std::iota(entry_.first.begin(), entry_.first.end(), std::size_t(0));
    }

    const PlyEntry& read(std::uint64_t index) {
        entry_.index = index;
        if (lists_)
            read_lists();
        else
            for (std::size_t k = 0; k < entry_.values.size(); ++k)
                entry_.values[k] = number(entry_.element->property[k].type);
        return entry_;
    }

private:
    void read_lists() {
        entry_.values.clear();
        for (std::size_t k = 0; k < entry_.element->property.size(); ++k) {
            const PlyProperty& p = entry_.element->property[k];
            std::size_t count = 1;
            if (p.list) {
                const double n = number(p.count);
                if (!(n >= 0 && n <= 0xffffffffu) || n != std::floor(n)) refuse("a list's length is no count");
                count = std::size_t(n);
            }
            const std::size_t left = (content_.size() - at_) / (ascii_ ? 1 : size_of(p.type));
            if (count > left) refuse("ends early");
            for (std::size_t i = 0; i < count; ++i) entry_.values.push_back(number(p.type));
            entry_.first[k + 1] = entry_.values.size();
        }
    }

    [[noreturn]] void refuse(const std::string& message) const {
        throw InputError(entry_.place(), message + " at " + entry_.element->name + " " + std::to_string(entry_.index) +
                                             " of " + std::to_string(entry_.element->count));
    }

    double number(PlyType type) {
        if (!ascii_) {
            const std::size_t size = size_of(type);
            if (content_.size() - at_ < size) refuse("ends early");
            const double value = decoded(content_.data() + at_, type, swap_);
            at_ += size;
            return value;
        }
        while (at_ < content_.size() && is_blank(content_[at_])) entry_.line += content_[at_++] == '\n';
        if (at_ == content_.size()) refuse("ends early");
        const std::string_view token = next_token(content_, at_);
        const auto value = parse_number(token);
        if (!value) refuse(in_ascii_quotes(token) + " is no finite number");
        return *value;
    }

    std::string_view content_;
    std::size_t at_;
    bool ascii_, swap_, lists_ = false; // lists_: the element has some
    PlyEntry entry_;
};

} // namespace

std::string PlyEntry::place() const {
    return line > 0 ? file_line(*name, line) : *name;
}

PlyHeader read_ply_header(std::string_view content, const std::string& name) {
    const PlyHeader header = HeaderReader(content, name).read();
    const std::size_t bytes = content.size() - header.data + 1; // the last number may end with the file
    for (const PlyElement& e : header.element) {
        const std::size_t least = least_bytes(e, header.form);
        if (least > 0 ? e.count > bytes / least : e.count > 0)
            throw InputError(name, "names " + std::to_string(e.count) + " of element " + in_ascii_quotes(e.name) +
                                       ", more than fit into the file: is it whole?");
    }
    return header;
}

void each_ply_entry(std::string_view content, const PlyHeader& header, const std::string& name,
                    const std::function<bool(const PlyElement&)>& wanted,
                    const std::function<void(const PlyElement&, const PlyEntry&)>& entry) {
    DataReader reader(content, header, name);
    std::size_t last = header.element.size(); // what comes after the last wanted element is not looked at
    while (last > 0 && !wanted(header.element[last - 1])) --last;
    for (std::size_t k = 0; k < last; ++k) {
        const PlyElement& element = header.element[k];
        const bool use = wanted(element);
        reader.begin(element);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            const PlyEntry& read = reader.read(i);
            if (use) entry(element, read);
        }
    }
}

} // namespace bough
