#include "usda.h"
#include "float_range.h"
#include "usda_parts.h"
#include <algorithm>
#include <cassert>

namespace bough {

std::string PrimNames::add(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_', digit = c >= '0' && c <= '9';
        if (plain.empty() && digit) plain = "_";
        plain += letter || digit ? c : '_';
    }
    if (plain.empty()) plain = "_";
    std::string made = plain;
    for (int k = 2; std::find(taken_.begin(), taken_.end(), made) != taken_.end(); ++k)
        made = plain + "_" + std::to_string(k);
    taken_.push_back(made);
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

// Each joint's path: its parents' names and its own.
std::vector<std::string> joint_paths(const JointGroups& groups) {
    std::vector<std::string> path(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups.parent[g] >= 0) path[g] = path[std::size_t(groups.parent[g])] + "/";
        path[g] += "body_" + std::to_string(groups.first[g]);
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

} // namespace

UsdaWriter::UsdaWriter(Output& output, const Skin& skin, const OwnMesh* own, const std::vector<OwnLook>& look,
                       const Tree& tree, const JointGroups& groups, const UsdaOptions& options)
    : output_(output), skin_(skin), own_(own), look_(look), tree_(tree), groups_(groups), options_(options),
      drawn_(drawn_frames(tree, groups)) {
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups.parent[g] < 0) root_.push_back(g);
}

void UsdaWriter::write(const MotionFrame& frame) {
    assert(frame.rotation.size() == tree_.size_bodies());
    const std::size_t joints = groups_.size();
    for (std::size_t g = 0; g < joints; ++g) {
        const Quat& world = frame.rotation[std::size_t(groups_.lead[g])];
        const std::int32_t p = groups_.parent[g];
        const Quat local =
            p < 0 ? world : Quat(frame.rotation[std::size_t(groups_.lead[std::size_t(p)])].conjugate() * world);
        Eigen::Vector4f q = local.normalized().coeffs().cast<float>();
        // Less than a half turn from the frame before as 4-vectors, for programs that blend the numbers.
        if (frames_ > 0 && q.dot(rotation_[rotation_.size() - joints]) < 0) q = -q;
        rotation_.push_back(q);
    }
    for (const std::size_t g : root_) {
        const Vec3 &is = frame.position[std::size_t(groups_.first[g])], &drawn = drawn_.x_w[g];
        place_.push_back(is);
        roots_move_ |= !((is - drawn).norm() <= 1e-6 * (1 + drawn.norm()));
        roots_move_ |= frames_ > 0 && is != place_[place_.size() - 1 - root_.size()];
    }
    if (frames_ < 2) {
        Output counted(nullptr, 0, ""); // counts alone
        Text text(counted);
        add_rotations(text, frames_);
        text.hand_on();
        (frames_ == 0 ? first_bytes_ : second_bytes_) = counted.bytes();
    }
    ++frames_;
}

void UsdaWriter::add_rotations(Text& text, std::size_t frame) const {
    const std::size_t joints = groups_.size();
    usda_array(
        text, in_motion + 1, std::to_string(frame) + ": ", joints,
        [&](Text& to, std::size_t g) {
            const Eigen::Vector4f& q = rotation_[frame * joints + g];
            usda_tuple(to, Eigen::Vector4f(q[3], q[0], q[1], q[2]));
        },
        ",");
}

void UsdaWriter::finish() {
    const Vec3 origin = floats_suffice(skin_.position) ? Vec3(Vec3::Zero()) : drawn_.x_w[0];
    const std::size_t joints = groups_.size();
    PrimNames top, parts;
    const std::string name = top.add(tree_.name.empty() ? "tree" : tree_.name), root = "/" + name;
    for (const char* taken : {"skeleton", "materials"}) parts.add(taken);
    std::vector<std::string> part;
    for (const SkinPart& of : skin_.part) part.push_back(parts.add(of.name));

    Text text(output_);
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
    usda_line(text, 0, "{");
    if (!origin.isZero(0)) {
        text.add("    double3 xformOp:translate = ");
        usda_tuple(text, origin);
        text.end_line();
        usda_line(text, in_root, "uniform token[] xformOpOrder = [\"xformOp:translate\"]");
    }

    usda_line(text, in_root, "def Skeleton \"skeleton\" (");
    usda_line(text, in_skeleton, "prepend apiSchemas = [\"SkelBindingAPI\"]");
    usda_line(text, in_root, ")");
    usda_line(text, in_root, "{");
    const std::vector<std::string> path = joint_paths(groups_);
    const auto add_path = [&path](Text& to, std::size_t g) {
        to.put('"');
        to.add(path[g]);
        to.put('"');
    };
    const auto in_parent = [&](std::size_t g) {
        return groups_.parent[g] < 0 ? Vec3(drawn_.position[g] - origin) : drawn_.position[g];
    };
    usda_array(text, in_skeleton, "uniform token[] joints = ", joints, add_path);
    usda_array(text, in_skeleton, "uniform matrix4d[] bindTransforms = ", joints,
               [&](Text& to, std::size_t g) { add_matrix(to, drawn_.R_wg[g], drawn_.x_w[g] - origin); });
    usda_array(text, in_skeleton, "uniform matrix4d[] restTransforms = ", joints,
               [&](Text& to, std::size_t g) { add_matrix(to, drawn_.rotation[g].toRotationMatrix(), in_parent(g)); });
    if (frames_ > 0) {
        usda_line(text, in_skeleton, "rel skel:animationSource = <" + root + "/skeleton/motion>");
        text.end_line();
        usda_line(text, in_skeleton, "def SkelAnimation \"motion\"");
        usda_line(text, in_skeleton, "{");
        usda_array(text, in_motion, "uniform token[] joints = ", joints, add_path);
        const auto samples = [&](const char* head, auto add) {
            usda_line(text, in_motion, head);
            for (std::size_t f = 0; f < frames_; ++f)
                usda_array(
                    text, in_motion + 1, std::to_string(f) + ": ", joints,
                    [&](Text& to, std::size_t g) { add(to, f, g); }, ",");
            usda_line(text, in_motion, "}");
        };
        usda_line(text, in_motion, "quatf[] rotations.timeSamples = {");
        for (std::size_t f = 0; f < frames_; ++f) add_rotations(text, f);
        usda_line(text, in_motion, "}");
        if (roots_move_) {
            std::vector<std::size_t> number_of(joints, 0); // of the roots
            for (std::size_t k = 0; k < root_.size(); ++k) number_of[root_[k]] = k;
            samples("float3[] translations.timeSamples = {", [&](Text& to, std::size_t f, std::size_t g) {
                const Vec3 p =
                    groups_.parent[g] < 0 ? Vec3(place_[f * root_.size() + number_of[g]] - origin) : drawn_.position[g];
                usda_tuple(to, Eigen::Vector3f(p.cast<float>()));
            });
        } else {
            usda_array(text, in_motion, "float3[] translations = ", joints,
                       [&](Text& to, std::size_t g) { usda_tuple(to, Eigen::Vector3f(in_parent(g).cast<float>())); });
        }
        usda_array(text, in_motion, "half3[] scales = ", joints, [](Text& to, std::size_t) { to.add("(1, 1, 1)"); });
        usda_line(text, in_skeleton, "}");
    }
    usda_line(text, in_root, "}");
    usda_meshes(text, root, part, skin_, own_, look_, groups_, origin);
    usda_materials(text, root, part, look_);
    usda_line(text, 0, "}");
    text.hand_on();
}

} // namespace bough
