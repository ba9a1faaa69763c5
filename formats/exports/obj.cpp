#include "obj.h"
#include "float_range.h"
#include "formats/text.h"
#include <cassert>
#include <charconv>

namespace bough {

namespace {

template <class Number> void add_positions(Text& text, const std::vector<Vec3>& position) {
    for (const Vec3& p : position) {
        text.put('v');
        for (int k = 0; k < 3; ++k) {
            text.put(' ');
            text.add_number(Number(p[k]));
        }
        text.end_line();
    }
}

void add_faces(Text& text, const Skin& skin, const SkinPart& part) {
    for (std::size_t t = part.first_index; t < part.first_index + part.index_count; ++t) {
        text.put('f');
        for (const std::int32_t v : skin.triangle[t]) {
            char digits[12];
            const std::string_view number(
                digits, std::size_t(std::to_chars(digits, digits + 12, std::int64_t(v) + 1).ptr - digits));
            for (const char before : {' ', '/', '/'}) {
                text.put(before);
                for (const char c : number) text.put(c);
            }
        }
        text.end_line();
    }
}

} // namespace

void write_obj(Output& output, const Skin& skin, const std::vector<Vec3>& position, const std::vector<Vec3>& normal,
               const std::string& mtl) {
    assert(position.size() == skin.position.size() && normal.size() == skin.position.size());
    Text text(output);
    text.add("mtllib ");
    text.add(mtl);
    text.end_line();
    if (floats_suffice(position))
        add_positions<float>(text, position);
    else
        add_positions<double>(text, position);
    for (const auto& [u, v] : skin.texture) {
        text.add("vt ");
        text.add_number(u);
        text.put(' ');
        text.add_number(v);
        text.end_line();
    }
    for (const Vec3& n : normal) {
        text.put('v'), text.put('n');
        for (int k = 0; k < 3; ++k) {
            text.put(' ');
            text.add_unit(n[k]);
        }
        text.end_line();
    }
    for (const SkinPart& part : skin.part) {
        text.add("g ");
        text.add(part.name);
        text.add("\nusemtl ");
        text.add(part.name);
        text.end_line();
        add_faces(text, skin, part);
    }
    text.hand_on();
}

void write_mtl(Output& output, const Skin& skin) {
    for (const SkinPart& part : skin.part) {
        Text text(output);
        text.add("newmtl ");
        text.add(part.name);
        text.add("\nKd");
        for (const double component : part.color) {
            text.put(' ');
            text.add_number(component);
        }
        text.add("\nKs 0 0 0\nillum 1\n\n");
        text.hand_on();
    }
}

namespace {

// The pattern's pieces: folder/prefix, width of the number, suffix.
struct Pattern {
    std::string prefix, suffix;
    int width = 0;
    std::string wrong;
};

Pattern parse(const std::string& pattern) {
    Pattern parts;
    const std::size_t slash = pattern.find_last_of('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t percent = pattern.find('%');
    auto wrong = [&](const std::string& what) {
        parts.wrong = what + ", expected a name like oak_%04d.obj";
        return parts;
    };
    if (percent == std::string::npos) return wrong("has no %d for the frame's number");
    if (percent < name) return wrong("has a % in its folder");
    if (percent == name) return wrong("has nothing before the number in the file's name (programs look for a prefix)");
    std::size_t end = percent + 1;
    if (end < pattern.size() && pattern[end] == '0') {
        const char* const last = pattern.data() + pattern.size();
        const auto [stop, error] = std::from_chars(pattern.data() + end + 1, last, parts.width);
        if (error != std::errc() || parts.width < 1 || parts.width > 18)
            return wrong("has a width that is not 1 to 18 after %0");
        end = std::size_t(stop - pattern.data());
    }
    if (end >= pattern.size() || pattern[end] != 'd') return wrong("has a % that is not %d or %0Nd");
    if (pattern.find('%', end) != std::string::npos) return wrong("has more than one %");
    parts.prefix = pattern.substr(0, percent);
    parts.suffix = pattern.substr(end + 1);
    return parts;
}

} // namespace

std::string valid_sequence(const std::string& pattern) {
    return parse(pattern).wrong;
}

std::string sequence_name(const std::string& pattern, std::int64_t frame) {
    const Pattern parts = parse(pattern);
    assert(parts.wrong.empty() && frame >= 0);
    const std::string number = std::to_string(frame);
    const std::size_t width = std::size_t(parts.width);
    return parts.prefix + std::string(width > number.size() ? width - number.size() : 0, '0') + number + parts.suffix;
}

std::string sequence_mtl(const std::string& pattern) {
    const std::string prefix = parse(pattern).prefix;
    const std::size_t slash = prefix.find_last_of('/');
    const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t last = prefix.find_last_not_of("_-. ");
    const bool only_marks = last == std::string::npos || last < name;
    return (only_marks ? prefix : prefix.substr(0, last + 1)) + ".mtl";
}

} // namespace bough
