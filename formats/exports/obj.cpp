#include "obj.h"
#include "float_range.h"
#include "formats/text.h"

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

void write_mtl(Output& output, const Skin& skin, const std::vector<MtlMaps>& maps) {
    for (std::size_t k = 0; k < skin.part.size(); ++k) {
        const SkinPart& part = skin.part[k];
        const MtlMaps images = maps.empty() ? MtlMaps{} : maps.at(k);
        Text text(output);
        text.add("newmtl ");
        text.add(part.name);
        text.add("\nKd");
        for (const double component : part.color) {
            text.put(' ');
            text.add_number(images.color.empty() ? component : 1.0);
        }
        text.add("\nKs 0 0 0\nillum 1\n");
        if (!images.color.empty()) text.add("map_Kd " + images.color + "\n");
        if (images.cut) text.add("map_d -imfchan m " + images.color + "\n");
        if (!images.normal.empty()) text.add("norm " + images.normal + "\nmap_Bump " + images.normal + "\n");
        text.put('\n');
        text.hand_on();
    }
}

} // namespace bough
