// driven_mesh.h: a user's own mesh, moved by the bodies of a tree, as vertices in each frame.
//
// With the matrices M_k(f) = W G_n(f) B_k of a vertex's shares (driven_surface.h), G_n(f) where its node stands in frame f (driven_bones.h) and W the
// file's axes in the world,
//     p(f) = sum_k w_k M_k(f) p / sum_k w_k,   n(f) = A^-T n / |A^-T n|,   A the linear part of sum_k w_k M_k(f).
// So it shows what a viewer shows of the .glb that DrivenModel writes. (Where a bone hangs on a node scaled unequally, G_n is exact here and only
// near there.)
// Cost     O(bones + joints) a frame, O(shares) a vertex, on all threads; 40 bytes a vertex, 8 a share, 12 a triangle.
// Errors   As DrivenBones and surface_of have them, and InputError for vertices whose drawn place is not finite or beyond a float's range.
#pragma once
#include "driven_bones.h"
#include "driven_surface.h"
#include <span>

namespace bough {

class DrivenMesh {
public:
    // Takes the model's document for itself: it is decoded, and no other has use of it. Notes: those of DrivenBones and of surface_of.
    DrivenMesh(const UserModel&, const Tree&, const DrivenPlace&, std::vector<std::string>& notes);

    // The same model where another tree moves it, which `drawn` is not: in its drawn pose, all of its vertices. The document's nodes are looked at
    // again.
    DrivenMesh(const DrivenMesh& drawn, const UserModel&, const Tree&, const DrivenPlace&,
               std::vector<std::string>& notes);

    std::size_t vertices() const { return surface_.position.size(); }
    const OwnMesh& look() const { return surface_.look; } // parts in order, without surfaces
    // Of all vertices as they are drawn: texture coordinates, triangles and parts; no joints. O(vertices).
    Skin skin() const;
    // The same with one joint a vertex: the body of its largest share, 0 where a bone has that which no body moves. O(vertices).
    Skin skin_of_bodies() const;
    // Keeps these vertices alone, in this order, drawn at these places [m], and no triangles. A vertex whose bones can take it to no such place stays
    // where it is drawn. Before the first go_to(). O(vertices).
    void keep(std::span<const std::int32_t> vertex, std::span<const Vec3> drawn);

    std::size_t bones() const { return bones_.bone().size(); }

    // The frame that positions() and normals() are of; before the first, the drawn pose.
    void go_to(const MotionFrame&);
    // In the tree's world [m]; normals are unit, outward. Of the vertices from `first` on, as many as `to` holds.
    void positions(std::size_t first, std::span<Vec3> to) const;
    void normals(std::size_t first, std::span<Vec3> to) const;

    const std::string& name() const { return name_; } // the model's, in messages
    // What it is made of (driven_rig.h).
    const DrivenBones& driven_by() const { return bones_; }
    const DrivenSurface& surface() const { return surface_; }
    std::int32_t bone_of(std::size_t matrix) const { return way_[matrix].bone; }      // -1: its node stands still
    const Eigen::Affine3d& moved(std::size_t matrix) const { return moved_[matrix]; } // M_k(f)

private:
    // Where matrix k's node stands: below a bone, or still.
    struct Way {
        std::int32_t bone; // -1: none
        Eigen::Affine3d from_bone;
    };
    Eigen::Affine3d blended(std::size_t vertex) const;
    std::int32_t body_of(std::size_t vertex) const;
    Eigen::Vector3f place_for(std::size_t vertex, const Vec3& drawn) const;
    void find_ways();
    void turn_mirrored();
    void check_range() const;

    std::string name_;
    DrivenBones bones_;
    DrivenSurface surface_;
    std::vector<Way> way_;               // of each of its matrices
    std::vector<Eigen::Affine3d> moved_; // M_k(f)
    std::vector<DrivenBones::Pose> pose_;
};

} // namespace bough
