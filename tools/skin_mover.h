// skin_mover.h: a skin as a frame of a motion has it: moved by its bodies, the leaves of its clumps rustling, or by a model's own bones.
#pragma once
#include "formats/models/driven_mesh.h"
#include "lib/growth/rustle.h"
#include "lib/model/motion.h"
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace bough {

// Puts the vertices of a skin where a frame has them.
using Mover = std::function<void(const MotionFrame&, std::vector<Vec3>& position, std::vector<Vec3>& normal)>;

class SkinMover {
public:
    // Keeps a reference to the skin. rustle: none where nothing rustles.
    SkinMover(const Skin& skin, const Tree& tree, std::unique_ptr<Rustle> rustle)
        : deformer_(skin, tree), rustle_(std::move(rustle)) {}
    void move(const MotionFrame& frame, std::vector<Vec3>& position, std::vector<Vec3>& normal) {
        rotation_.resize(frame.rotation.size());
        for (std::size_t i = 0; i < rotation_.size(); ++i) rotation_[i] = frame.rotation[i].toRotationMatrix();
        deformer_.deform(rotation_, frame.position, position, normal);
        if (!rustle_) return;
        rustle_->go_to(frame.frame);
        rustle_->turn(position, normal);
    }

private:
    SkinDeformer deformer_;
    std::unique_ptr<Rustle> rustle_;
    std::vector<Mat3> rotation_;
};

// Of a skin, which must outlive it. rustle: null where nothing rustles.
inline Mover mover_of(const Skin& skin, const Tree& tree, std::unique_ptr<Rustle> rustle) {
    const auto mover = std::make_shared<SkinMover>(skin, tree, std::move(rustle));
    return [mover](const MotionFrame& frame, std::vector<Vec3>& position, std::vector<Vec3>& normal) {
        mover->move(frame, position, normal);
    };
}

// A mesh of a run, and what moves it.
struct MovedMesh {
    Skin skin;                  // drawn; its joints are bodies
    std::optional<OwnMesh> own; // what it was made of, or its look alone
    // What moves a skin of some of its vertices, rising, all where none are named. The skin outlives it. Once.
    std::function<Mover(const Skin&, std::span<const std::int32_t> vertex)> mover;
};

// By bodies. rustle: null where nothing rustles. Keeps a reference to the tree.
inline MovedMesh moved(Skin skin, std::optional<OwnMesh> own, const Tree& tree,
                       std::function<std::unique_ptr<Rustle>(const Skin&, bool together)> rustle) {
    return {std::move(skin), std::move(own),
            [&tree, rustle = std::move(rustle)](const Skin& kept, std::span<const std::int32_t>) {
                return mover_of(kept, tree, rustle(kept, false));
            }};
}

// Of all vertices of a model's own mesh.
inline Mover mover_of(std::shared_ptr<DrivenMesh> mesh) {
    return [mesh](const MotionFrame& frame, std::vector<Vec3>& position, std::vector<Vec3>& normal) {
        mesh->go_to(frame);
        position.resize(mesh->vertices());
        normal.resize(mesh->vertices());
        mesh->positions(0, position);
        mesh->normals(0, normal);
    };
}

// By a model's own bones.
inline MovedMesh moved(DrivenMesh driven) {
    const auto mesh = std::make_shared<DrivenMesh>(std::move(driven));
    return {mesh->skin_of_bodies(), mesh->look(), [mesh](const Skin& kept, std::span<const std::int32_t> vertex) {
                if (!vertex.empty()) mesh->keep(vertex, kept.position);
                return mover_of(mesh);
            }};
}

} // namespace bough
