#include "driven_mesh.h"
#include "formats/plain_text.h"
#include "lib/base/parallel.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {
namespace {

// take(vertex, its place in `to`) for each, on all threads.
template <class Take> void each(std::size_t first, std::span<Vec3> to, Take&& take) {
    constexpr double vertex_ns = 50;
    parallel_for(to.size(), vertex_ns, [&](std::size_t k) { to[k] = take(first + k); });
}

// |A| A^-T, which exists where A has no inverse.
Mat3 cofactors(const Mat3& A) {
    Mat3 C;
    C.col(0) = A.col(1).cross(A.col(2));
    C.col(1) = A.col(2).cross(A.col(0));
    C.col(2) = A.col(0).cross(A.col(1));
    return C;
}

} // namespace

DrivenMesh::DrivenMesh(const UserModel& model, const Tree& tree, const DrivenPlace& place,
                       std::vector<std::string>& notes)
    : name_(model.name), bones_(model, tree, place, notes), surface_(surface_of(*model.document, model.name, notes)) {
    find_ways();
    turn_mirrored();
    check_range();
}

DrivenMesh::DrivenMesh(const DrivenMesh& drawn, const UserModel& model, const Tree& tree, const DrivenPlace& place,
                       std::vector<std::string>& notes)
    : name_(model.name), bones_(model, tree, place, notes), surface_(drawn.surface_) { // mirrored alike
    surface_.look.image.clear();
    find_ways();
    check_range();
}

void DrivenMesh::find_ways() {
    const GltfNodes& nodes = bones_.nodes();
    for (const DrivenSurface::Matrix& matrix : surface_.matrix) {
        const std::int32_t bone = bones_.bone_over(matrix.node);
        Eigen::Affine3d below = matrix.bind;
        if (bone < 0) {
            below = bones_.world_from_file() * nodes.world[std::size_t(matrix.node)] * matrix.bind;
        } else { // not by the bone's inverse: it may be scaled to nothing
            for (std::int32_t n = matrix.node; n != bones_.bone()[std::size_t(bone)].node;
                 n = nodes.parent[std::size_t(n)])
                below = nodes.local[std::size_t(n)] * below;
        }
        way_.push_back({bone, below});
        moved_.push_back(bones_.world_from_file() * nodes.world[std::size_t(matrix.node)] * matrix.bind);
    }
}

// A mirrored triangle is seen from its other side: its corners change places.
void DrivenMesh::turn_mirrored() {
    for (std::array<std::int32_t, 3>& corner : surface_.triangle)
        if (blended(std::size_t(corner[0])).linear().determinant() < 0) std::swap(corner[1], corner[2]);
}

void DrivenMesh::check_range() const {
    for (std::size_t v = 0; v < vertices(); ++v) {
        const Vec3 at = blended(v) * surface_.position[v].cast<double>();
        if (!(at.array().abs() < double(std::numeric_limits<float>::max())).all()) // maxCoeff() may pass NaN over
            throw InputError(name_, "vertex " + std::to_string(v) + " of its mesh is drawn beyond any float, at " +
                                        shown(at.x()) + ", " + shown(at.y()) + ", " + shown(at.z()));
    }
}

void DrivenMesh::go_to(const MotionFrame& frame) {
    bones_.poses(frame, pose_);
    for (DrivenBones::Pose& pose : pose_) pose.world = bones_.world_from_file() * pose.world;
    for (std::size_t k = 0; k < way_.size(); ++k)
        moved_[k] = way_[k].bone < 0 ? way_[k].from_bone : pose_[std::size_t(way_[k].bone)].world * way_[k].from_bone;
}

Eigen::Affine3d DrivenMesh::blended(std::size_t vertex) const {
    Eigen::Affine3d M;
    M.matrix().setZero();
    double sum = 0;
    for (std::size_t s = surface_.first_share[vertex]; s < surface_.first_share[vertex + 1]; ++s) {
        const DrivenSurface::Share& share = surface_.share[s];
        M.affine() += double(share.weight) * moved_[std::size_t(share.matrix)].affine();
        sum += double(share.weight);
    }
    M.affine() /= sum;
    M.makeAffine();
    return M;
}

void DrivenMesh::positions(std::size_t first, std::span<Vec3> to) const {
    each(first, to, [&](std::size_t v) -> Vec3 { return blended(v) * surface_.position[v].cast<double>(); });
}

void DrivenMesh::normals(std::size_t first, std::span<Vec3> to) const {
    each(first, to, [&](std::size_t v) -> Vec3 {
        const Mat3 A = blended(v).linear(), C = cofactors(A);
        const Vec3 n = C * surface_.normal[v].cast<double>();
        const double length = (C.col(0).dot(A.col(0)) < 0 ? -1 : 1) * n.norm();
        return length != 0 && std::isfinite(length) ? Vec3(n / length) : Vec3(Vec3::UnitY());
    });
}

// The body of its largest share.
std::int32_t DrivenMesh::body_of(std::size_t vertex) const {
    const auto share = surface_.share.begin();
    const auto most = std::max_element(share + std::ptrdiff_t(surface_.first_share[vertex]),
                                       share + std::ptrdiff_t(surface_.first_share[vertex + 1]),
                                       [](const auto& a, const auto& b) { return a.weight < b.weight; });
    const std::int32_t bone = way_[std::size_t(most->matrix)].bone;
    return bone < 0 ? 0 : std::max(0, bones_.bone()[std::size_t(bone)].turn);
}

// Where a vertex has to be in the mesh's axes to be drawn there; as it is where it is drawn there already, and where its bones leave no such place.
Eigen::Vector3f DrivenMesh::place_for(std::size_t vertex, const Vec3& drawn) const {
    const Eigen::Affine3d M = blended(vertex);
    const Eigen::Vector3f& now = surface_.position[vertex];
    const double moved = (M * now.cast<double>() - drawn).norm();
    if (moved == 0) return now;
    const Eigen::Vector3f place = (M.inverse() * drawn).cast<float>();
    const double left = (M * place.cast<double>() - drawn).norm();
    return place.allFinite() && left < 0.01 * moved ? place : now; // NaN is not less
}

void DrivenMesh::keep(std::span<const std::int32_t> vertex, std::span<const Vec3> drawn) {
    DrivenSurface kept;
    for (std::size_t k = 0; k < vertex.size(); ++k) {
        const auto v = std::size_t(vertex[k]);
        kept.position.push_back(place_for(v, drawn[k]));
        kept.normal.push_back(surface_.normal[v]);
        kept.uv.push_back(surface_.uv[v]);
        kept.share.insert(kept.share.end(), surface_.share.begin() + std::ptrdiff_t(surface_.first_share[v]),
                          surface_.share.begin() + std::ptrdiff_t(surface_.first_share[v + 1]));
        kept.first_share.push_back(kept.share.size());
    }
    surface_.position = std::move(kept.position);
    surface_.normal = std::move(kept.normal);
    surface_.uv = std::move(kept.uv);
    surface_.share = std::move(kept.share);
    surface_.first_share = std::move(kept.first_share);
    surface_.triangle.clear();
}

Skin DrivenMesh::skin() const {
    Skin skin;
    skin.position.resize(vertices());
    skin.normal.resize(vertices());
    positions(0, skin.position);
    normals(0, skin.normal);
    skin.texture = surface_.uv;
    skin.triangle = surface_.triangle;
    skin.part = surface_.part;
    return skin;
}

Skin DrivenMesh::skin_of_bodies() const {
    Skin made = skin();
    made.joint.resize(vertices());
    made.weight.assign(vertices(), {1, 0, 0, 0});
    for (std::size_t v = 0; v < vertices(); ++v) made.joint[v].fill(body_of(v));
    return made;
}

} // namespace bough
