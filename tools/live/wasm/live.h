// live.h: what the page calls beside bough_c.h's own functions: the same calls with plain numbers in place of structs, and what a page needs and a
// program in C does not: other programs' files, meshes, poses as a texture, an animated .glb.
//
// As in bough_c.h nothing is thrown. A call that gives a handle gives NULL where it failed, one that gives a bough_result says so by it, and
// bough_error() says why. Strings that are given out stay until the next call that gives one.
#pragma once
#include "formats/c/bough_c.h"
#include "formats/c/handle.h"
#include "formats/models/speedtree_model.h"
#include "lib/growth/skin.h"
#include "lib/simulation/simulation.h"
#include <emscripten/emscripten.h>
#include <optional>

#define LIVE extern "C" EMSCRIPTEN_KEEPALIVE

namespace bough::live {

// A SpeedTree file's own mesh, not yet bound to a tree.
struct ModelObject final : c::Object {
    static constexpr const char* name = "model";
    const char* kind() const override { return name; }
    SpeedtreeModel model;
};

// What is drawn of a scene: a skin about the trees' drawn pose, and how far the bodies are from it, in the step before and in the last one.
struct MeshObject final : c::Object {
    static constexpr const char* name = "mesh";
    const char* kind() const override { return name; }
    std::shared_ptr<const Tree> drawn;    // the trees joined, as drawn
    std::optional<OwnMesh> own;           // which came with the tree
    Skin skin;                            // of that, or made
    std::vector<Eigen::Quaternionf> back; // body from world, drawn
    std::vector<Eigen::Vector3f> joint;   // [m] own joints, drawn
    struct Offset {
        Eigen::Vector4f place, turn; // [m], 0; x y z w: world now from world drawn
    };
    std::vector<Offset> before, now;
};

// A handle, or NULL where `make` threw.
template <class Make> void* handle_of(Make&& make) noexcept {
    void* handle = nullptr;
    c::call([&] { handle = c::give(make()); });
    return handle;
}

// A text that the page reads before it calls again.
const char* given_out(std::string text);

// The whole scene with its trees, as a run takes it. Throws WrongCall where a place has none.
Scene scene_of(const bough_scene*);

} // namespace bough::live
