// Documents drawn several times and put together: each index that one list holds of another still names what it named, by the names that things have.
#include "formats/models/joined_gltf.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

using DocumentJson = nlohmann::ordered_json;

// A document of everything that has an index, each thing named after `tag`.
GltfDocument named_document(const std::string& tag) {
    GltfDocument document;
    document.binary = tag + std::string(5, '.'); // whose end is no multiple of 4
    document.json = DocumentJson::parse(R"({
        "asset": {"version": "2.0", "copyright": "TAG's"}, "extras": {"of": "TAG"}, "scene": 1,
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants", "EXT_texture_webp", "KHR_materials_clearcoat", "EXT_meshopt_compression"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"name": "TAG lamp"}]}, "KHR_materials_variants": {"variants": [{"name": "TAG autumn"}]}},
        "scenes": [{"nodes": [0]}, {"nodes": [1, 2]}],
        "nodes": [{"name": "TAG unused"}, {"name": "TAG bone", "children": [3]}, {"name": "TAG skinned", "mesh": 0, "skin": 0},
                  {"name": "TAG lit", "camera": 0, "mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}, "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}],
        "cameras": [{"name": "TAG camera"}],
        "skins": [{"name": "TAG skin", "joints": [1, 3], "skeleton": 1, "inverseBindMatrices": 1}],
        "meshes": [{"name": "TAG mesh", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "targets": [{"POSITION": 1}], "material": 0,
                    "extensions": {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]}]}}}]}],
        "materials": [{"name": "TAG material", "normalTexture": {"index": 0},
                       "extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 0}}}}],
        "textures": [{"name": "TAG texture", "source": 0, "sampler": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}],
        "images": [{"name": "TAG image", "bufferView": 1}], "samplers": [{"name": "TAG sampler"}],
        "animations": [{"name": "TAG wave", "channels": [{"sampler": 0, "target": {"node": 3, "path": "rotation"}}], "samplers": [{"input": 0, "output": 1}]}],
        "accessors": [{"name": "TAG first", "bufferView": 0}, {"name": "TAG second", "sparse": {"indices": {"bufferView": 0}, "values": {"bufferView": 1}}}],
        "bufferViews": [{"name": "TAG view", "buffer": 0, "byteLength": 1},
                        {"name": "TAG packed", "buffer": 1, "byteOffset": 0, "byteLength": 9, "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteOffset": 0, "byteLength": 1}}}],
        "buffers": [{"byteLength": 8}, {"name": "TAG fallback", "byteLength": 9}]})");
    std::string text = document.json.dump();
    for (std::size_t at = 0; (at = text.find("TAG", at)) != std::string::npos;) text.replace(at, 3, tag);
    document.json = DocumentJson::parse(text);
    return document;
}

std::string name_of(const GltfDocument& document, const char* list, const DocumentJson& index) {
    return document.json.at(list).at(index.get<std::size_t>()).at("name").get<std::string>();
}

// What the things of that tag name of each other, where each is drawn twice.
void check_references(const GltfDocument& d, const std::string& tag) {
    const DocumentJson& json = d.json;
    std::size_t lit = 0, skinned = 0;
    for (const DocumentJson& node : json["nodes"]) {
        if (node["name"] == tag + " bone") CHECK(name_of(d, "nodes", node["children"][0]) == tag + " lit");
        if (node["name"] == tag + " skinned") {
            ++skinned;
            CHECK(name_of(d, "meshes", node["mesh"]) == tag + " mesh");
            CHECK(name_of(d, "skins", node["skin"]) == tag + " skin");
        }
        if (node["name"] != tag + " lit") continue;
        ++lit;
        CHECK(name_of(d, "cameras", node["camera"]) == tag + " camera");
        const DocumentJson& more = node["extensions"];
        CHECK(name_of(d, "accessors", more["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"]) == tag + " first");
        const auto lamp = more["KHR_lights_punctual"]["light"].get<std::size_t>();
        CHECK(json["extensions"]["KHR_lights_punctual"]["lights"].at(lamp)["name"] == tag + " lamp");
    }
    CHECK(lit == 2);
    CHECK(skinned == 2);
    for (const DocumentJson& skin : json["skins"])
        if (skin["name"] == tag + " skin") {
            CHECK(name_of(d, "nodes", skin["joints"][1]) == tag + " lit");
            CHECK(skin["skeleton"] == skin["joints"][0]);
            CHECK(name_of(d, "accessors", skin["inverseBindMatrices"]) == tag + " second");
        }
    for (const DocumentJson& mesh : json["meshes"]) {
        if (mesh["name"] != tag + " mesh") continue;
        const DocumentJson &primitive = mesh["primitives"][0],
                           &mapping = primitive["extensions"]["KHR_materials_variants"]["mappings"][0];
        CHECK(name_of(d, "accessors", primitive["attributes"]["POSITION"]) == tag + " first");
        CHECK(name_of(d, "accessors", primitive["indices"]) == tag + " second");
        CHECK(name_of(d, "accessors", primitive["targets"][0]["POSITION"]) == tag + " second");
        CHECK(name_of(d, "materials", primitive["material"]) == tag + " material");
        CHECK(name_of(d, "materials", mapping["material"]) == tag + " material");
        const auto variant = mapping["variants"][0].get<std::size_t>();
        CHECK(json["extensions"]["KHR_materials_variants"]["variants"].at(variant)["name"] == tag + " autumn");
    }
    for (const DocumentJson& material : json["materials"]) {
        if (material["name"] != tag + " material") continue;
        CHECK(name_of(d, "textures", material["normalTexture"]["index"]) == tag + " texture");
        const DocumentJson& coat = material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"];
        CHECK(name_of(d, "textures", coat["index"]) == tag + " texture");
    }
    for (const DocumentJson& texture : json["textures"]) {
        if (texture["name"] != tag + " texture") continue;
        CHECK(name_of(d, "images", texture["source"]) == tag + " image");
        CHECK(name_of(d, "images", texture["extensions"]["EXT_texture_webp"]["source"]) == tag + " image");
        CHECK(name_of(d, "samplers", texture["sampler"]) == tag + " sampler");
    }
    for (const DocumentJson& image : json["images"])
        if (image["name"] == tag + " image") CHECK(name_of(d, "bufferViews", image["bufferView"]) == tag + " packed");
    for (const DocumentJson& accessor : json["accessors"]) {
        if (accessor["name"] == tag + " first")
            CHECK(name_of(d, "bufferViews", accessor["bufferView"]) == tag + " view");
        if (accessor["name"] != tag + " second") continue;
        CHECK(name_of(d, "bufferViews", accessor["sparse"]["indices"]["bufferView"]) == tag + " view");
        CHECK(name_of(d, "bufferViews", accessor["sparse"]["values"]["bufferView"]) == tag + " packed");
    }
    for (const DocumentJson& view : json["bufferViews"]) {
        const auto bytes_at = [&](const DocumentJson& of) {
            return d.binary.substr(of.value("byteOffset", std::size_t(0)), tag.size());
        };
        if (view["name"] == tag + " view") CHECK(bytes_at(view) == tag);
        if (view["name"] != tag + " packed") continue;
        CHECK(bytes_at(view["extensions"]["EXT_meshopt_compression"]) == tag);
        CHECK(json["buffers"].at(view["buffer"].get<std::size_t>())["name"] == tag + " fallback");
    }
    for (const DocumentJson& animation : json["animations"]) {
        if (animation["name"] != tag + " wave") continue;
        CHECK(name_of(d, "nodes", animation["channels"][0]["target"]["node"]) == tag + " lit");
        CHECK(name_of(d, "accessors", animation["samplers"][0]["input"]) == tag + " first");
        CHECK(name_of(d, "accessors", animation["samplers"][0]["output"]) == tag + " second");
    }
}

} // namespace

TEST_CASE("documents that are drawn twice each and put together name what they named") {
    GltfDocument all = empty_gltf("bough", "");
    for (const std::string tag : {"oak", "ash"}) {
        GltfDocument one = named_document(tag);
        draw_at(one, {{tag + " here", Vec3::Zero(), 0}, {tag + " there", Vec3(1, 2, 3), 1}});
        join(all, std::move(one), tag);
    }
    check_references(all, "oak");
    check_references(all, "ash");
    // A skinned mesh at the top stays there; the rest hangs on the node that places it; what the scene does not show is not shown.
    const DocumentJson& json = all.json;
    REQUIRE(json["scenes"].size() == 1);
    std::vector<std::string> top;
    for (const DocumentJson& node : json["scenes"][0]["nodes"]) top.push_back(name_of(all, "nodes", node));
    CHECK(top == std::vector<std::string>{"oak here", "oak skinned", "oak there", "oak skinned", "ash here",
                                          "ash skinned", "ash there", "ash skinned"});
    CHECK(json["meshes"].size() == 2);
    CHECK(json["animations"].size() == 4);
    CHECK(json["asset"]["copyright"] == "oak's; ash's");
    CHECK(json["extras"]["ash"]["of"] == "ash");
    CHECK(json["extensionsUsed"].size() == 5);
    for (const DocumentJson& node : json["nodes"])
        if (node["name"] == "ash there") {
            CHECK(node["translation"] == DocumentJson::array({1.0, 2.0, 3.0}));
            CHECK(node["rotation"][1].get<double>() == Approx(std::sin(0.5)));
            CHECK(name_of(all, "nodes", node["children"][0]) == "ash bone");
        }
}

TEST_CASE("an extension that may name what is moved is refused by its name") {
    GltfDocument all = empty_gltf("bough", ""), one = named_document("oak");
    one.json["extensionsUsed"].push_back("ACME_roots");
    CHECK_THROWS_WITH(join(all, std::move(one), "oak.glb"),
                      Catch::Matchers::Contains("oak.glb") && Catch::Matchers::Contains("\"ACME_roots\""));
}
