#include "usda.h"
#include "float_range.h"
#include "usda_parts.h"
#include <cassert>

namespace bough {

std::string prim_name(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_', digit = c >= '0' && c <= '9';
        if (plain.empty() && digit) plain = "_";
        plain += letter || digit ? c : '_';
    }
    return plain.empty() ? "_" : plain;
}

std::string FreeNames::add(const std::string& name) {
    std::string made = name;
    for (int& k = next_.try_emplace(name, 2).first->second; !taken_.insert(made).second; ++k)
        made = name + "_" + std::to_string(k);
    return made;
}

std::string usda_string(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '\n') {
            quoted += "\\n";
            continue;
        }
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return quoted + "\"";
}

namespace {

constexpr int in_root = 1, in_skeleton = 2, in_motion = 3;

// Each joint's path: its parents' names and its own, which no other has, as programs exist that look for it alone.
std::vector<std::string> joint_paths(const RigJoints& joints, FreeNames& taken) {
    std::vector<std::string> path(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const std::int32_t p = joints.parent[j];
        path[j] = (p < 0 ? "" : path[std::size_t(p)] + "/") + taken.add(prim_name(joints.name[j]));
    }
    return path;
}

// USD's vectors are rows: a matrix is the transposed of ours.
void add_matrix(Text& text, const Mat3& R, const Vec3& t) {
    text.add("( ");
    for (int row = 0; row < 3; ++row) {
        usda_tuple(text, Eigen::Vector4d(R(0, row), R(1, row), R(2, row), 0));
        text.add(", ");
    }
    usda_tuple(text, Eigen::Vector4d(t.x(), t.y(), t.z(), 1));
    text.add(" )");
}

// In its parent's frame.
Quat rotation_of(const RigJoints& joints, const RigPose& pose, std::size_t joint) {
    const std::int32_t p = joints.parent[joint];
    return p < 0 ? pose.rotation[joint] : Quat(pose.rotation[std::size_t(p)].conjugate() * pose.rotation[joint]);
}

} // namespace

UsdaWriter::UsdaWriter(Output& output, const std::string& name, const Rig& rig, const std::vector<OwnLook>& look,
                       const UsdaOptions& options)
    : output_(output), name_(prim_name(name.empty() ? "tree" : name)), rig_(rig), look_(look), options_(options),
      origin_(floats_suffice(rig.mesh.skin.position) ? Vec3(Vec3::Zero()) : rig.joints.drawn.place[0]) {
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        drawn_.push_back(place_of(rig.joints.drawn, j));
        traveller_.push_back(rig.joints.travels[j] ? std::int32_t(travellers_++) : -1);
    }
}

// In its parent's frame; a root's from the origin.
Vec3 UsdaWriter::place_of(const RigPose& pose, std::size_t joint) const {
    const std::int32_t p = rig_.joints.parent[joint];
    if (p < 0) return pose.place[joint] - origin_;
    return pose.rotation[std::size_t(p)].conjugate() * (pose.place[joint] - pose.place[std::size_t(p)]);
}

void UsdaWriter::write(const RigPose& pose) {
    const std::size_t joints = rig_.joints.size();
    assert(pose.rotation.size() == joints);
    for (std::size_t j = 0; j < joints; ++j) {
        Eigen::Vector4f q = rotation_of(rig_.joints, pose, j).normalized().coeffs().cast<float>();
        // Less than a half turn from the frame before as 4-vectors, for programs that blend the numbers.
        if (frames_ > 0 && q.dot(rotation_[rotation_.size() - joints]) < 0) q = -q;
        rotation_.push_back(q);
        if (traveller_[j] < 0) continue;
        const Vec3 place = place_of(pose, j);
        place_.push_back(place.cast<float>());
        const double from_world = rig_.joints.parent[j] < 0 ? pose.place[j].norm() : place.norm();
        moves_ |= !((place - drawn_[j]).norm() <= 1e-6 * (1 + from_world));
    }
    if (frames_ < 2) {
        Output counted(nullptr, 0, ""); // counts alone
        Text text(counted);
        add_rotations(text, frames_);
        if (moves_) add_places(text, frames_);
        text.hand_on();
        (frames_ == 0 ? first_bytes_ : second_bytes_) = counted.bytes();
    }
    ++frames_;
}

void UsdaWriter::add_rotations(Text& text, std::size_t frame) const {
    const std::size_t joints = rig_.joints.size();
    usda_array(
        text, in_motion + 1, std::to_string(frame) + ": ", joints,
        [&](Text& to, std::size_t j) {
            const Eigen::Vector4f& q = rotation_[frame * joints + j];
            usda_tuple(to, Eigen::Vector4f(q[3], q[0], q[1], q[2]));
        },
        ",");
}

void UsdaWriter::add_places(Text& text, std::size_t frame) const {
    usda_array(
        text, in_motion + 1, std::to_string(frame) + ": ", rig_.joints.size(),
        [&](Text& to, std::size_t j) {
            const std::int32_t t = traveller_[j];
            usda_tuple(to,
                       t < 0 ? Eigen::Vector3f(drawn_[j].cast<float>()) : place_[frame * travellers_ + std::size_t(t)]);
        },
        ",");
}

void UsdaWriter::add_head(Text& text, const std::string& name) const {
    usda_line(text, 0, "#usda 1.0");
    usda_line(text, 0, "(");
    usda_line(text, 1, "customLayerData = {");
    usda_line(text, 2, "string creator = " + usda_string(options_.generator));
    if (!options_.source.empty()) usda_line(text, 2, "string source = " + usda_string(options_.source));
    usda_line(text, 1, "}");
    usda_line(text, 1, "defaultPrim = \"" + name + "\"");
    const auto number = [&text](const char* what, double value) {
        text.add(what);
        text.add_number(value);
        text.end_line();
    };
    number("    endTimeCode = ", double(std::max<std::size_t>(frames_, 1) - 1));
    number("    framesPerSecond = ", options_.fps);
    usda_line(text, 1, "metersPerUnit = 1");
    usda_line(text, 1, "startTimeCode = 0");
    number("    timeCodesPerSecond = ", options_.fps);
    usda_line(text, 1, "upAxis = \"Y\"");
    usda_line(text, 0, ")");
    text.end_line();
    usda_line(text, 0, "def SkelRoot \"" + name + "\" (");
    usda_line(text, 1, "kind = \"component\"");
    usda_line(text, 0, ")");
}

void UsdaWriter::add_skeleton(Text& text, const std::string& root, const std::vector<std::string>& path) const {
    const RigJoints& joints = rig_.joints;
    usda_line(text, in_root, "def Skeleton \"skeleton\" (");
    usda_line(text, in_skeleton, "prepend apiSchemas = [\"SkelBindingAPI\"]");
    usda_line(text, in_root, ")");
    usda_line(text, in_root, "{");
    usda_array(text, in_skeleton, "uniform token[] joints = ", joints.size(),
               [&path](Text& to, std::size_t j) { to.add('"' + path[j] + '"'); });
    usda_array(text, in_skeleton, "uniform matrix4d[] bindTransforms = ", joints.size(), [&](Text& to, std::size_t j) {
        add_matrix(to, joints.bind[j].linear(), joints.bind[j].translation() - origin_);
    });
    usda_array(text, in_skeleton, "uniform matrix4d[] restTransforms = ", joints.size(), [&](Text& to, std::size_t j) {
        add_matrix(to, rotation_of(joints, joints.drawn, j).toRotationMatrix(), drawn_[j]);
    });
    if (frames_ > 0) {
        usda_line(text, in_skeleton, "rel skel:animationSource = <" + root + "/skeleton/motion>");
        text.end_line();
        add_motion(text, path);
    }
    usda_line(text, in_root, "}");
}

void UsdaWriter::add_motion(Text& text, const std::vector<std::string>& path) const {
    const std::size_t joints = path.size();
    usda_line(text, in_skeleton, "def SkelAnimation \"motion\"");
    usda_line(text, in_skeleton, "{");
    usda_array(text, in_motion, "uniform token[] joints = ", joints,
               [&path](Text& to, std::size_t j) { to.add('"' + path[j] + '"'); });
    usda_line(text, in_motion, "quatf[] rotations.timeSamples = {");
    for (std::size_t f = 0; f < frames_; ++f) add_rotations(text, f);
    usda_line(text, in_motion, "}");
    if (moves_) {
        usda_line(text, in_motion, "float3[] translations.timeSamples = {");
        for (std::size_t f = 0; f < frames_; ++f) add_places(text, f);
        usda_line(text, in_motion, "}");
    } else {
        usda_array(text, in_motion, "float3[] translations = ", joints,
                   [&](Text& to, std::size_t j) { usda_tuple(to, Eigen::Vector3f(drawn_[j].cast<float>())); });
    }
    usda_array(text, in_motion, "half3[] scales = ", joints, [](Text& to, std::size_t) { to.add("(1, 1, 1)"); });
    usda_line(text, in_skeleton, "}");
}

void UsdaWriter::finish() {
    const std::string root = "/" + name_;
    FreeNames names; // of joints, then of meshes, so that no mesh is called as a joint
    for (const char* taken : {"skeleton", "materials"}) names.add(taken);
    const std::vector<std::string> path = joint_paths(rig_.joints, names);
    std::vector<std::string> part;
    for (const SkinPart& of : rig_.mesh.skin.part) part.push_back(names.add(prim_name(of.name)));

    Text text(output_);
    add_head(text, name_);
    usda_line(text, 0, "{");
    if (!origin_.isZero(0)) {
        text.add("    double3 xformOp:translate = ");
        usda_tuple(text, origin_);
        text.end_line();
        usda_line(text, in_root, "uniform token[] xformOpOrder = [\"xformOp:translate\"]");
    }
    add_skeleton(text, root, path);
    usda_meshes(text, root, part, rig_.mesh, look_, origin_);
    usda_materials(text, root, part, look_);
    usda_line(text, 0, "}");
    text.hand_on();
}

} // namespace bough
