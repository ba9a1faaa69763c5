// skin_mover.h: a skin as a frame of a motion has it: moved by its bodies, the leaves of its clumps rustling.
#pragma once
#include "lib/growth/rustle.h"
#include "lib/model/motion.h"
#include <memory>

namespace bough {

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

} // namespace bough
