#include "formats/documents/document_parts.h"
#include "usda_parts.h"

namespace bough {
namespace {

std::string decimal(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::string triple(const Vec3& c) {
    return "(" + decimal(c.x()) + ", " + decimal(c.y()) + ", " + decimal(c.z());
}

// As USD quotes one: by three @ where it has one itself.
std::string asset_path(std::string path) {
    if (path.find('@') == std::string::npos) return "@" + path + "@";
    const std::string quote = "@@@";
    for (std::size_t at = 0; (at = path.find(quote, at)) != std::string::npos; at += 1 + quote.size())
        path.insert(at, "\\");
    return quote + path + quote;
}

class Material {
public:
    Material(Text& text, const std::string& path) : text_(text), path_(path) {}

    void write(const OwnLook& look) {
        line("token outputs:surface.connect = <" + path_ + "/surface.outputs:surface>");
        text_.end_line();
        begin("surface", "UsdPreviewSurface");
        if (look.color_map.empty())
            input("color3f inputs:diffuseColor = " + triple(look.color) + ")");
        else
            from("color3f", "diffuseColor", "color", "rgb");
        if (look.roughness_map.empty()) {
            input("float inputs:metallic = " + decimal(look.metallic));
            input("float inputs:roughness = " + decimal(look.roughness));
        } else { // glTF's image: metallic is blue, roughness green
            from("float", "metallic", "roughness", "b");
            from("float", "roughness", "roughness", "g");
        }
        if (look.cut) {
            from("float", "opacity", "color", "a");
            input("float inputs:opacityThreshold = " + decimal(look.cutoff));
        }
        if (!look.normal_map.empty()) from("normal3f", "normal", "normal", "rgb");
        if (!look.occlusion_map.empty()) from("float", "occlusion", "occlusion", "r");
        input("token outputs:surface");
        line("}");
        if ((look.color_map + look.normal_map + look.roughness_map + look.occlusion_map).empty()) return;
        begin("uv", "UsdPrimvarReader_float2");
        input("string inputs:varname = \"st\"");
        input("float2 outputs:result");
        line("}");
        image("color", look.color_map, "sRGB", "inputs:scale = " + triple(look.color) + ", 1)",
              look.cut ? "rgb a" : "rgb");
        image("normal", look.normal_map, "raw", "inputs:scale = (2, 2, 2, 1)\nfloat4 inputs:bias = (-1, -1, -1, 0)",
              "rgb");
        image("roughness", look.roughness_map, "raw",
              "inputs:scale = (1, " + decimal(look.roughness) + ", " + decimal(look.metallic) + ", 1)", "g b");
        image("occlusion", look.occlusion_map, "raw", "inputs:scale = (1, 1, 1, 1)", "r");
    }

private:
    static constexpr int in_material = 3;
    void line(const std::string& what) { usda_line(text_, in_material, what); }
    void input(const std::string& what) { usda_line(text_, in_material + 1, what); }
    void begin(const std::string& name, const std::string& id) {
        line("def Shader \"" + name + "\"");
        line("{");
        input("uniform token info:id = \"" + id + "\"");
    }
    void from(const char* type, const char* what, const char* shader, const char* output) {
        input(std::string(type) + " inputs:" + what + ".connect = <" + path_ + "/" + shader + ".outputs:" + output +
              ">");
    }
    // outputs: "rgb a". Bark is tiled.
    void image(const char* name, const std::string& file, const char* space, const std::string& scale,
               std::string outputs) {
        if (file.empty()) return;
        begin(name, "UsdUVTexture");
        input("asset inputs:file = " + asset_path("./" + file));
        input(std::string("token inputs:sourceColorSpace = \"") + space + "\"");
        input("float2 inputs:st.connect = <" + path_ + "/uv.outputs:result>");
        input("token inputs:wrapS = \"repeat\"");
        input("token inputs:wrapT = \"repeat\"");
        std::string all = "float4 " + scale;
        for (std::size_t at; (at = all.find('\n')) != std::string::npos; all = all.substr(at + 1))
            input(all.substr(0, at));
        input(all);
        outputs += ' ';
        for (std::size_t at; (at = outputs.find(' ')) != std::string::npos; outputs = outputs.substr(at + 1))
            input((at == 3 ? "float3 outputs:" : "float outputs:") + outputs.substr(0, at));
        line("}");
    }

    Text& text_;
    const std::string path_;
};

} // namespace

void usda_materials(Text& text, const std::string& root, const std::vector<std::string>& name,
                    const std::vector<OwnLook>& look) {
    text.end_line();
    usda_line(text, 1, "def Scope \"materials\"");
    usda_line(text, 1, "{");
    for (std::size_t m = 0; m < name.size(); ++m) {
        usda_line(text, 2, "def Material \"" + name[m] + "\"");
        usda_line(text, 2, "{");
        Material(text, root + "/materials/" + name[m]).write(look[m]);
        usda_line(text, 2, "}");
    }
    usda_line(text, 1, "}");
}

} // namespace bough
