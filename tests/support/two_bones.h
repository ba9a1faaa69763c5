// two_bones.h: a skinned model of two bones as a .gltf, what its file must come to, and poses of the tree that moves it.
#pragma once
#include "formats/models/driven_mesh.h"
#include "formats/models/gltf_document.h"
#include "import_support.h"
#include "lib/growth/segment.h"
#include "lib/model/append.h"
#include "lib/model/drawn_pose.h"
#include "lib/model/wood.h"
#include <filesystem>
#include <unistd.h>

namespace bough::test::two_bones {

using GltfJson = nlohmann::json;

// A .gltf with its buffer in a file beside it, both of which go with this.
class GltfFile {
public:
    GltfFile() {
        static int made = 0;
        folder_ = std::filesystem::temp_directory_path() /
                  ("bough_mesh_" + std::to_string(::getpid()) + "_" + std::to_string(++made));
        std::filesystem::create_directories(folder_);
        json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", GltfJson::array()}}}}};
    }
    ~GltfFile() { std::filesystem::remove_all(folder_); }

    // The accessor of an array; a row each.
    template <class Number>
    std::size_t add(const std::vector<Number>& numbers, const char* type, int component, bool normalized = false) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        const std::size_t first = bytes_.size(), width = type == std::string("SCALAR") ? 1
                                                         : type == std::string("VEC2") ? 2
                                                         : type == std::string("VEC3") ? 3
                                                         : type == std::string("VEC4") ? 4
                                                                                       : 16;
        bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", first}, {"byteLength", bytes_.size() - first}});
        GltfJson accessor{{"bufferView", json["bufferViews"].size() - 1},
                          {"componentType", component},
                          {"count", numbers.size() / width},
                          {"type", type}};
        if (normalized) accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return json["accessors"].size() - 1;
    }
    std::size_t floats(const std::vector<Vec3>& rows) {
        std::vector<float> numbers;
        for (const Vec3& row : rows)
            for (int k = 0; k < 3; ++k) numbers.push_back(float(row[k]));
        return add(numbers, "VEC3", 5126);
    }
    std::string saved() {
        json["buffers"] = {{{"uri", "arrays.bin"}, {"byteLength", bytes_.size()}}};
        std::ofstream(folder_ / "arrays.bin", std::ios::binary) << bytes_;
        std::ofstream(folder_ / "model.gltf") << json.dump();
        return folder_ / "model.gltf";
    }

    GltfJson json;

private:
    std::filesystem::path folder_;
    std::string bytes_;
};

inline Mat3 around_z(double angle) {
    return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

inline const Vec3 upper_joint(0, 1, 0), pot_place(1, 0, 0), twig_place(0.2, 0.5, 0);
constexpr double mesh_size = 2; // the tube's mesh is drawn at half its size, and the bind matrices double it
inline const Vec3 mesh_offset(0.5, 0.25, -0.125); // and beside it
inline const Vec3 twig_scale(2, 1, 1), mirror(-1, 1, 1);

// A tube about two bones, 0 to 1 and 1 to 2 m high, bent by halves in the middle; a leaf on a node that hangs on the upper bone, scaled
// unequally; a mirrored one; and a pot that no bone moves.
struct TwoBones {
    GltfFile file;
    std::vector<Vec3> tube, tube_normal;
    std::vector<double> upper; // share of the upper bone
    const std::vector<Vec3> leaf = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
    const Vec3 leaf_normal = Vec3(1, 1, 0).normalized();

    TwoBones() {
        GltfJson& json = file.json;
        json["nodes"] = {{{"name", "trunk"}, {"children", {1}}},
                         {{"name", "upper"}, {"translation", {0, 1, 0}}, {"children", {2, 5}}},
                         {{"name", "upper_end"}, {"translation", {0, 1, 0}}},
                         {{"name", "bark"}, {"mesh", 0}, {"skin", 0}, {"translation", {7, 8, 9}}}, // means nothing
                         {{"name", "pot"}, {"mesh", 1}, {"translation", {1, 0, 0}}},
                         {{"name", "twig"}, {"mesh", 1}, {"translation", {0.2, 0.5, 0}}, {"scale", {2, 1, 1}}},
                         {{"name", "mirror"}, {"mesh", 1}, {"translation", {1, 0, 0}}, {"scale", {-1, 1, 1}}}};
        json["scenes"][0]["nodes"] = {0, 3, 4, 6};
        std::vector<Vec3> drawn;
        std::vector<std::uint16_t> joints[2];
        std::vector<std::uint8_t> first;
        std::vector<float> second, uv;
        const double y[] = {0, 0.5, 1, 1.5, 2}, of_upper[] = {0, 0, 0.5, 1, 1};
        for (int r = 0; r < 5; ++r)
            for (int k = 0; k < 4; ++k) {
                const double a = k * double(EIGEN_PI) / 2;
                tube_normal.push_back({std::round(std::cos(a)), 0, std::round(std::sin(a))});
                tube.push_back(Vec3(0, y[r], 0) + 0.1 * tube_normal.back());
                drawn.push_back((tube.back() - mesh_offset) / mesh_size);
                upper.push_back(of_upper[r]);
                // The skin's joints are upper, trunk. Weights of the middle ring add up to a half alone, and lie in two sets; joint 9 is none,
                // and has no weight.
                joints[0].insert(joints[0].end(), {1, 9, 9, 9});
                joints[1].insert(joints[1].end(), {9, 9, 0, 9});
                const bool half = r == 2;
                first.insert(first.end(), {std::uint8_t(half ? 51 : of_upper[r] > 0 ? 0 : 255), 0, 0, 0});
                second.insert(second.end(), {0, 0, half ? 0.2f : float(of_upper[r]), 0});
                uv.insert(uv.end(), {float(k) / 4, float(r) / 4});
            }
        std::vector<std::uint16_t> index;
        for (std::uint16_t r = 0; r < 4; ++r)
            for (std::uint16_t k = 0; k < 4; ++k) {
                const std::uint16_t a = std::uint16_t(4 * r + k), b = std::uint16_t(4 * r + (k + 1) % 4);
                for (const int c : {int(a), a + 4, int(b), int(b), a + 4, b + 4}) index.push_back(std::uint16_t(c));
            }
        GltfJson bark{{"POSITION", file.floats(drawn)},
                      {"NORMAL", file.floats(tube_normal)},
                      {"TEXCOORD_1", file.add(uv, "VEC2", 5126)},
                      {"JOINTS_0", file.add(joints[0], "VEC4", 5123)},
                      {"WEIGHTS_0", file.add(first, "VEC4", 5121, true)},
                      {"JOINTS_1", file.add(joints[1], "VEC4", 5123)},
                      {"WEIGHTS_1", file.add(second, "VEC4", 5126)}};
        json["meshes"].push_back(
            {{"primitives", {{{"attributes", bark}, {"indices", file.add(index, "SCALAR", 5123)}, {"material", 1}}}}});
        GltfJson of_leaf{{"POSITION", file.floats(leaf)},
                         {"NORMAL", file.floats({leaf_normal, leaf_normal, leaf_normal})}};
        json["meshes"].push_back({{"primitives", {{{"attributes", of_leaf}, {"material", 0}}}}});
        // Column by column: from the mesh's axes into those of the joint, which is drawn at (0, 1, 0) or at the origin.
        std::vector<float> bind;
        for (const double down : {1.0, 0.0}) {
            Eigen::Affine3d B =
                Eigen::Translation3d(0, -down, 0) * Eigen::Translation3d(mesh_offset) * Eigen::Scaling(mesh_size);
            for (int k = 0; k < 16; ++k) bind.push_back(float(B.matrix()(k % 4, k / 4)));
        }
        json["skins"] = {{{"joints", {1, 0}}, {"inverseBindMatrices", file.add(bind, "MAT4", 5126)}}};
        json["materials"] = {{{"name", "leaf"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}}}},
                             {{"name", "old bark"}}};
    }

    Tree tree() {
        ImportOptions options;
        const std::string path = file.saved();
        options.folder = std::filesystem::path(path).parent_path();
        SegmentOptions cut;
        cut.segment_length = 0;
        return segment(imported(content_of(path), path, options).splines, wood_presets().front(), cut);
    }
};

// The tree put elsewhere, turned, and the model's mesh that it moves.
struct Placed {
    const Vec3 foot{5, 1, -2};
    const double yaw = 0.9;
    const Mat3 turned = Eigen::AngleAxisd(yaw, Vec3::UnitY()).toRotationMatrix();
    Tree tree;
    std::vector<std::string> lines; // what was noted
    std::optional<DrivenMesh> mesh;

    Placed(TwoBones& model, const Tree& alone) {
        append(tree, alone, foot, yaw);
        ImportNotes notes;
        mesh.emplace(read_user_model(model.file.saved(), notes), tree, DrivenPlace{foot, yaw}, lines);
    }
};

// All turned by Q about the tree's foot, and before that all above 1 m about the joint there by R; seen from a world in which the tree is
// placed.
inline MotionFrame bent_frame(const Tree& tree, const Mat3& R, const Mat3& Q, const Mat3& placed, const Vec3& foot) {
    const DrawnPose drawn = drawn_pose(tree);
    MotionFrame frame;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 local = placed.transpose() * (drawn.x_w[i] - foot);
        const bool above = local.y() > 1 - 1e-6;
        frame.rotation.emplace_back(placed * Q * (above ? R : Mat3(Mat3::Identity())) * placed.transpose() *
                                    drawn.R_wb[i]);
        const Vec3 bent = above ? Vec3(upper_joint + R * (local - upper_joint)) : local;
        frame.position.push_back(foot + placed * (Q * bent));
    }
    return frame;
}

} // namespace bough::test::two_bones
