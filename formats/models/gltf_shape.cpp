#include "gltf_shape.h"
#include "formats/error.h"
#include <nlohmann/json.hpp>
#include <string_view>

namespace bough {
namespace {
namespace gltf_shape { // its names are short ones, and a folder's sources may be compiled together

using Json = nlohmann::ordered_json;

enum class Is { number, truth, text, object, numbers, texts, objects };

struct Value {
    std::string_view in, key; // in: the objects that have it: a list's each by '*'
    Is kind;
    bool required = false;
};

// Objects before what they hold.
constexpr Value values[] = {
    {"", "asset", Is::object, true},
    {"/asset", "version", Is::text, true},
    {"", "extensionsUsed", Is::texts},
    {"", "extensionsRequired", Is::texts},
    {"", "scene", Is::number},
    {"", "scenes", Is::objects},
    {"/scenes/*", "nodes", Is::numbers},
    {"", "nodes", Is::objects},
    {"/nodes/*", "name", Is::text},
    {"/nodes/*", "children", Is::numbers},
    {"/nodes/*", "mesh", Is::number},
    {"/nodes/*", "skin", Is::number},
    {"/nodes/*", "matrix", Is::numbers},
    {"/nodes/*", "translation", Is::numbers},
    {"/nodes/*", "rotation", Is::numbers},
    {"/nodes/*", "scale", Is::numbers},
    {"/nodes/*", "extensions", Is::object},
    {"", "meshes", Is::objects},
    {"/meshes/*", "name", Is::text},
    {"/meshes/*", "primitives", Is::objects, true},
    {"/meshes/*/primitives/*", "attributes", Is::object, true},
    {"/meshes/*/primitives/*", "indices", Is::number},
    {"/meshes/*/primitives/*", "material", Is::number},
    {"/meshes/*/primitives/*", "mode", Is::number},
    {"/meshes/*/primitives/*", "targets", Is::objects},
    {"/meshes/*/primitives/*", "extensions", Is::object},
    {"", "accessors", Is::objects},
    {"/accessors/*", "bufferView", Is::number},
    {"/accessors/*", "byteOffset", Is::number},
    {"/accessors/*", "componentType", Is::number, true},
    {"/accessors/*", "count", Is::number, true},
    {"/accessors/*", "type", Is::text, true},
    {"/accessors/*", "normalized", Is::truth},
    {"/accessors/*", "sparse", Is::object},
    {"", "bufferViews", Is::objects},
    {"/bufferViews/*", "buffer", Is::number, true},
    {"/bufferViews/*", "byteOffset", Is::number},
    {"/bufferViews/*", "byteLength", Is::number, true},
    {"/bufferViews/*", "byteStride", Is::number},
    {"/bufferViews/*", "extensions", Is::object},
    {"", "buffers", Is::objects},
    {"/buffers/*", "uri", Is::text},
    {"/buffers/*", "byteLength", Is::number, true},
    {"/buffers/*", "extensions", Is::object},
    {"", "images", Is::objects},
    {"/images/*", "uri", Is::text},
    {"/images/*", "mimeType", Is::text},
    {"/images/*", "bufferView", Is::number},
    {"", "samplers", Is::objects},
    {"", "textures", Is::objects},
    {"/textures/*", "source", Is::number},
    {"/textures/*", "sampler", Is::number},
    {"/textures/*", "extensions", Is::object},
    {"", "materials", Is::objects},
    {"/materials/*", "name", Is::text},
    {"/materials/*", "alphaMode", Is::text},
    {"/materials/*", "alphaCutoff", Is::number},
    {"/materials/*", "doubleSided", Is::truth},
    {"/materials/*", "pbrMetallicRoughness", Is::object},
    {"/materials/*", "extensions", Is::object},
    {"", "skins", Is::objects},
    {"/skins/*", "joints", Is::numbers, true},
    {"/skins/*", "inverseBindMatrices", Is::number},
    {"/skins/*", "skeleton", Is::number},
    {"", "animations", Is::objects},
    {"/animations/*", "name", Is::text},
    {"/animations/*", "samplers", Is::objects},
    {"/animations/*/samplers/*", "input", Is::number},
    {"/animations/*/samplers/*", "output", Is::number},
    {"/animations/*/samplers/*", "interpolation", Is::text},
    {"/animations/*", "channels", Is::objects},
    {"/animations/*/channels/*", "sampler", Is::number},
    {"/animations/*/channels/*", "target", Is::object},
};

const char* expected(Is kind) {
    switch (kind) {
    case Is::number:
        return "a number";
    case Is::truth:
        return "true or false";
    case Is::text:
        return "a text";
    case Is::object:
        return "an object";
    case Is::numbers:
        return "a list of numbers";
    case Is::texts:
        return "a list of texts";
    case Is::objects:
        break;
    }
    return "a list of objects";
}

const char* found(const Json& value) {
    return value.is_null()      ? "null"
           : value.is_boolean() ? "true or false"
           : value.is_number()  ? "a number"
           : value.is_string()  ? "a text"
           : value.is_array()   ? "a list"
                                : "an object";
}

bool is(const Json& value, Is kind) {
    switch (kind) {
    case Is::number:
        return value.is_number();
    case Is::truth:
        return value.is_boolean();
    case Is::text:
        return value.is_string();
    case Is::object:
        return value.is_object();
    default:
        return value.is_array();
    }
}

// What the entries of a list are.
Is entry_of(Is list) {
    return list == Is::numbers ? Is::number : list == Is::texts ? Is::text : Is::object;
}

class Shape {
public:
    explicit Shape(const std::string& name) : name_(name) {}

    // What `object`, which stands at `place`, has by the name that the rest of `in` leads to.
    void look(const Json& object, std::string_view in, const std::string& place, const Value& value) const {
        if (in.empty()) return look(object, place, value);
        const std::string_view step = in.substr(1, in.find('/', 1) - 1);
        in.remove_prefix(1 + step.size());
        if (step == "*") {
            for (std::size_t k = 0; k < object.size(); ++k) look(object[k], in, place + "/" + std::to_string(k), value);
        } else if (const auto there = object.find(std::string(step)); there != object.end()) {
            look(*there, in, place + "/" + std::string(step), value);
        }
    }

private:
    void look(const Json& object, const std::string& place, const Value& value) const {
        const std::string at = place + "/" + std::string(value.key);
        const auto there = object.find(std::string(value.key));
        if (there == object.end()) {
            if (value.required) wrong(at, std::string("is missing, expected ") + expected(value.kind));
            return;
        }
        if (there->is_null() && !value.required) return; // as some programs write what they do not have
        if (!is(*there, value.kind))
            wrong(at, std::string("is ") + found(*there) + ", expected " + expected(value.kind));
        if (!there->is_array()) return;
        const Is entry = entry_of(value.kind);
        for (std::size_t k = 0; k < there->size(); ++k)
            if (!is((*there)[k], entry))
                wrong(at + "/" + std::to_string(k),
                      std::string("is ") + found((*there)[k]) + ", expected " + expected(entry));
    }

    [[noreturn]] void wrong(const std::string& at, const std::string& how) const {
        throw InputError(name_, "is no glTF 2.0: " + at + ": " + how);
    }

    const std::string& name_;
};

} // namespace gltf_shape
} // namespace

void require_gltf_shape(const nlohmann::ordered_json& document, const std::string& name) {
    using namespace gltf_shape;
    if (!document.is_object())
        throw InputError(name, std::string("is no glTF 2.0: is ") + found(document) + ", expected an object");
    const Shape shape(name);
    for (const Value& value : values) shape.look(document, value.in, "", value);
}

} // namespace bough
