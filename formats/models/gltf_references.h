// gltf_references.h: the places of a glTF document that name others of its lists by their index (private to this folder, and to tools' meshes).
#pragma once
#include "gltf_document.h"

namespace bough::gltf_references {

using Json = nlohmann::ordered_json;

// An extension of the document that may name arrays in a way that is not followed here, "": none.
std::string unknown_extension(const Json&);

template <class Use> void each_of(Json& json, const char* list, Use&& use) {
    if (!json.contains(list)) return;
    for (Json& item : json[list]) use(item);
}

inline Json* extension(Json& of, const char* name) {
    return of.contains("extensions") && of["extensions"].contains(name) ? &of["extensions"][name] : nullptr;
}

// use(number) for each place that holds the index of an accessor.
template <class Use> void each_accessor_index(Json& json, Use&& use) {
    const auto each_value = [&](Json& object) {
        for (Json& index : object) use(index);
    };
    each_of(json, "meshes", [&](Json& mesh) {
        each_of(mesh, "primitives", [&](Json& primitive) {
            each_value(primitive.at("attributes"));
            if (primitive.contains("indices")) use(primitive["indices"]);
            each_of(primitive, "targets", each_value);
        });
    });
    each_of(json, "skins", [&](Json& skin) {
        if (skin.contains("inverseBindMatrices")) use(skin["inverseBindMatrices"]);
    });
    each_of(json, "animations", [&](Json& animation) {
        each_of(animation, "samplers", [&](Json& sampler) {
            use(sampler.at("input"));
            use(sampler.at("output"));
        });
    });
    each_of(json, "nodes", [&](Json& node) {
        if (Json* instances = extension(node, "EXT_mesh_gpu_instancing")) each_value(instances->at("attributes"));
    });
}

// ... of a view.
template <class Use> void each_view_index(Json& json, Use&& use) {
    const auto of = [&](Json& object) {
        if (object.contains("bufferView")) use(object["bufferView"]);
    };
    each_of(json, "accessors", [&](Json& accessor) {
        of(accessor);
        if (!accessor.contains("sparse")) return;
        of(accessor["sparse"].at("indices"));
        of(accessor["sparse"].at("values"));
    });
    each_of(json, "images", of);
    each_of(json, "meshes", [&](Json& mesh) {
        each_of(mesh, "primitives", [&](Json& primitive) {
            if (Json* draco = extension(primitive, "KHR_draco_mesh_compression")) of(*draco);
        });
    });
}

// use(number) for each place of a material that holds the index of a texture.
template <class Use> void each_texture_index(Json& material, Use&& use) {
    for (auto& [key, value] : material.items()) {
        if (!value.is_object() || key == "extras") continue;
        if (key.ends_with("Texture") && value.contains("index")) use(value["index"]);
        each_texture_index(value, use);
    }
}

// use(object) for each object that names bytes of buffer 0.
template <class Use> void each_place(Json& json, Use&& use) {
    const auto of = [&](Json& object) {
        if (whole_number(object, "buffer", "a view") == 0) use(object);
    };
    each_of(json, "bufferViews", [&](Json& view) {
        of(view);
        if (Json* packed = extension(view, "EXT_meshopt_compression")) of(*packed);
    });
}

} // namespace bough::gltf_references
