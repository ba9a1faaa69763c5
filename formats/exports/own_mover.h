// own_mover.h: where the vertices of a mesh that came with the tree are in a frame, some at a time: a cache of a large mesh needs no skin of it.
//
// A vertex of the mesh, drawn at p, is at   sum_b weight_b (x_b + R_b R_b0^T (p - x_b0)),   b its bodies, 0 the drawn pose: what SkinDeformer
// (skin.h) makes of skin_of(mesh), bit by bit, in its order.
// Cost     O(bodies) a frame and O(1) a vertex, on all threads; 24 bytes for each placed shape beside the mesh.
#pragma once
#include "lib/model/motion.h"
#include "lib/model/tree.h"
#include "own_mesh.h"
#include <span>

namespace bough {

class OwnMover {
public:
    // Keeps a reference to the mesh.
    OwnMover(const OwnMesh&, const Tree&);
    std::size_t vertices() const { return vertices_; }
    // The frame that positions() is of.
    void go_to(const MotionFrame&);
    // [m] Of the vertices from `first` on, as many as `to` holds.
    void positions(std::size_t first, std::span<Vec3> to) const;

private:
    // The vertices of one surface: standing, or placed.
    struct Run {
        std::size_t first;
        const OwnPart* part;
        const OwnPlace* place; // null: the part's standing surface
    };
    const OwnSurface& surface_of(const Run& run) const {
        return run.place ? mesh_.shape[std::size_t(run.place->shape)] : run.part->standing;
    }
    Vec3 moved(std::int32_t body, const Vec3& drawn) const {
        const auto b = std::size_t(body);
        return x_w_[b] + turn_[b] * (drawn - drawn_x_w_[b]);
    }
    void fill(std::size_t first, std::span<Vec3> to) const;

    const OwnMesh& mesh_;
    std::vector<Run> runs_; // in the order of the vertices
    std::size_t vertices_ = 0;
    std::vector<Mat3> drawn_R_bw_, turn_; // turn: world now from world drawn
    std::vector<Vec3> drawn_x_w_, x_w_;
};

} // namespace bough
