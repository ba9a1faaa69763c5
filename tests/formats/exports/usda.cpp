// USD text read back by a small reader of its own grammar: a prim's attributes as text, numbers in order. (Others read it in tests/clients.)
#include "formats/exports/usda.h"
#include "formats/exports/gltf_parts.h"
#include "lib/model/append.h"
#include "tests/support/random_documents.h"
#include "tests/support/skin_checks.h"
#include <cctype>

using namespace bough;
using namespace bough::test;
using namespace skin_checks;

namespace {

using Mat4 = Eigen::Matrix4d;

// Attributes by "/path/of/prim.name"; brackets must close.
std::map<std::string, std::string> parse(const std::string& text) {
    std::map<std::string, std::string> found;
    std::vector<std::string> path;
    std::string pending;
    bool samples = false;
    std::istringstream lines(text);
    std::string line;
    REQUIRE(std::getline(lines, line));
    REQUIRE(line == "#usda 1.0");
    const auto joined = [&path] {
        std::string all;
        for (const std::string& name : path) all += "/" + name;
        return all;
    };
    while (std::getline(lines, line)) {
        line.erase(0, line.find_first_not_of(' ') == std::string::npos ? line.size() : line.find_first_not_of(' '));
        if (line.starts_with("def ")) {
            const std::size_t open = line.find('"');
            pending = line.substr(open + 1, line.find('"', open + 1) - open - 1);
            found[joined() + "/" + pending] = line.substr(4, open - 5);
        } else if (line == "{") {
            path.push_back(pending);
        } else if (line == "}") {
            if (samples || path.empty())
                samples = false;
            else
                path.pop_back();
        } else if (const std::size_t equals = line.find(" = "); equals != std::string::npos) {
            const std::string head = line.substr(0, equals), name = head.substr(head.rfind(' ') + 1);
            std::string value = line.substr(equals + 3);
            if (value == "{") samples = true;
            if (value.ends_with(" (")) value.resize(value.size() - 2);
            found[joined() + "." + name] = value;
        } else if (const std::size_t colon = line.find(": "); samples && colon != std::string::npos) {
            found[joined() + "@" + line.substr(0, colon) +
                  (found.contains(joined() + ".translations.timeSamples") ? "t" : "")] = line.substr(colon + 2);
        }
    }
    CHECK(path.empty());
    return found;
}

std::vector<double> numbers(const std::string& text) {
    std::vector<double> list;
    for (const char* at = text.c_str(); *at;) {
        char* end = nullptr;
        const double value = std::isdigit(static_cast<unsigned char>(*at)) || *at == '-' ? std::strtod(at, &end) : 0;
        if (end && end != at) list.push_back(value);
        at = end && end != at ? end : at + 1;
    }
    return list;
}

std::vector<std::string> strings(const std::string& text) {
    std::vector<std::string> list;
    for (std::size_t open = text.find('"'); open != std::string::npos;) {
        const std::size_t close = text.find('"', open + 1);
        list.push_back(text.substr(open + 1, close - open - 1));
        open = text.find('"', close + 1);
    }
    return list;
}

std::vector<Mat4> matrices(const std::string& text) {
    const std::vector<double> n = numbers(text);
    std::vector<Mat4> list;
    for (std::size_t k = 0; k + 16 <= n.size(); k += 16)
        list.push_back(Eigen::Map<const Mat4>(n.data() + k)); // rows are columns
    return list;
}

struct WrittenUsda {
    Tree tree;
    Skin skin;
    std::map<std::string, std::string> at;
    std::string root;
};

MotionFrame as_frame(const skin_checks::SkinPose& pose, std::size_t number, const Vec3& moved = Vec3::Zero()) {
    MotionFrame frame;
    frame.frame = std::int64_t(number);
    for (const Vec3& x : pose.x_w) frame.position.push_back(x + moved);
    for (const Mat3& R : pose.R_wb) frame.rotation.emplace_back(R);
    return frame;
}

WrittenUsda written_usda(const Tree& tree, const std::vector<skin_checks::SkinPose>& poses,
                         const Vec3& step = Vec3::Zero()) {
    WrittenUsda w{tree, build_skin(tree, {}), {}, "/" + tree.name};
    const JointGroups groups = merge_joints(tree, 100000);
    std::vector<OwnLook> look;
    for (const SkinPart& part : w.skin.part) look.push_back(look_of(gltf_material(part.name, part.color)));
    UsdaOptions options;
    options.fps = 24;
    options.generator = "bough \"1\"";
    w.at = parse(test::written([&](Output& output) {
        Rig rig = rig_of(w.skin, nullptr, w.tree, groups);
        const std::optional<Vec3> root = join_roots(rig);
        CHECK(std::count(rig.joints.parent.begin(), rig.joints.parent.end(), -1) == 1);
        UsdaWriter writer(output, w.tree.name, rig, look, options);
        for (std::size_t f = 0; f < poses.size(); ++f) {
            RigPose pose = pose_of(as_frame(poses[f], f, double(f) * step), groups);
            if (root) join_roots(pose, *root);
            writer.write(pose);
        }
        writer.finish();
    }));
    return w;
}

// Linear blend skinning as OpenUSD describes it: of a mesh's points at a frame, -1: at rest.
std::vector<Vec3> skinned(const WrittenUsda& w, const std::string& mesh, int frame) {
    const auto& at = w.at;
    const std::string skeleton = w.root + "/skeleton", motion = skeleton + "/motion";
    const std::vector<std::string> joint = strings(at.at(skeleton + ".joints"));
    const std::vector<Mat4> bind = matrices(at.at(skeleton + ".bindTransforms")),
                            rest = matrices(at.at(skeleton + ".restTransforms"));
    REQUIRE(bind.size() == joint.size());
    REQUIRE(rest.size() == joint.size());
    std::vector<double> q, t;
    if (frame >= 0) {
        CHECK(strings(at.at(motion + ".joints")) == joint);
        q = numbers(at.at(motion + "@" + std::to_string(frame)));
        const bool moves = at.contains(motion + ".translations.timeSamples");
        t = numbers(moves ? at.at(motion + "@" + std::to_string(frame) + "t") : at.at(motion + ".translations"));
        REQUIRE(q.size() == 4 * joint.size());
        REQUIRE(t.size() == 3 * joint.size());
        CHECK(numbers(at.at(motion + ".scales")) == std::vector<double>(3 * joint.size(), 1));
    }
    std::map<std::string, std::size_t> number;
    std::vector<Mat4> world(joint.size());
    for (std::size_t j = 0; j < joint.size(); ++j) {
        Mat4 local = rest[j];
        if (frame >= 0) {
            local.setIdentity();
            local.topLeftCorner<3, 3>() =
                Eigen::Quaterniond(q[4 * j], q[4 * j + 1], q[4 * j + 2], q[4 * j + 3]).toRotationMatrix();
            local.topRightCorner<3, 1>() = Vec3(t[3 * j], t[3 * j + 1], t[3 * j + 2]);
        }
        const std::size_t slash = joint[j].rfind('/');
        world[j] = slash == std::string::npos ? local : Mat4(world[number.at(joint[j].substr(0, slash))] * local);
        number[joint[j]] = j;
        if (frame < 0) CHECK((world[j] - bind[j]).norm() < 1e-9);
    }
    const std::string prim = w.root + "/" + mesh;
    const std::vector<double> points = numbers(at.at(prim + ".points")),
                              index = numbers(at.at(prim + ".primvars:skel:jointIndices")),
                              weight = numbers(at.at(prim + ".primvars:skel:jointWeights"));
    const std::size_t count = points.size() / 3, width = index.size() / count;
    REQUIRE(index.size() == width * count);
    REQUIRE(weight.size() == index.size());
    std::vector<Vec3> found;
    for (std::size_t v = 0; v < count; ++v) {
        const Eigen::Vector4d p(points[3 * v], points[3 * v + 1], points[3 * v + 2], 1);
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (std::size_t k = width * v; k < width * (v + 1); ++k)
            sum += weight[k] * (world[std::size_t(index[k])] * bind[std::size_t(index[k])].inverse() * p);
        found.push_back(sum.head<3>());
    }
    return found;
}

// All meshes, one after another, beside what the deformer gives.
double off(const WrittenUsda& w, int frame, const std::vector<Vec3>& wanted) {
    std::vector<Vec3> found;
    for (const SkinPart& part : w.skin.part)
        for (const Vec3& p : skinned(w, part.name, frame)) found.push_back(p);
    REQUIRE(found.size() == wanted.size());
    double most = 0;
    for (std::size_t v = 0; v < found.size(); ++v) most = std::max(most, (found[v] - wanted[v]).norm());
    return most;
}

} // namespace

TEST_CASE("joints, weights and time samples move the meshes as the deformer does") {
    Tree two; // of two roots
    append(two, make_tree::branched(), Vec3(1, 0, 2), 0.3);
    append(two, make_tree::branched(), Vec3(-4, 0, 0), -1);
    two.name = "two";
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(150, 3), two}) {
        std::vector<skin_checks::SkinPose> poses;
        for (unsigned f = 0; f < 4; ++f) poses.push_back(bent(tree, 0.2 * f, f));
        for (const Vec3& step : {Vec3(0, 0, 0), Vec3(0.1, 0, -0.2)}) {
            const WrittenUsda w = written_usda(tree, poses, step);
            CHECK(w.at.contains(w.root + "/skeleton/motion.translations.timeSamples") == !step.isZero());
            CHECK(off(w, -1, w.skin.position) < 1e-5);
            for (std::size_t f = 0; f < poses.size(); ++f) {
                std::vector<Vec3> position, normal;
                std::vector<Vec3> place = poses[f].x_w;
                for (Vec3& p : place) p += double(f) * step;
                SkinDeformer(w.skin, tree).deform(poses[f].R_wb, place, position, normal);
                CHECK(off(w, int(f), position) < 1e-5);
            }
        }
    }
}

TEST_CASE("what a reader looks for first: units, axes, times, the root, types of prims, faces, materials") {
    const Tree tree = make_tree::branched();
    const WrittenUsda w = written_usda(tree, {bent(tree, 0, 1), bent(tree, 0.1, 1)});
    const auto& at = w.at;
    for (const auto& [name, value] : std::map<std::string, std::string>{{".metersPerUnit", "1"},
                                                                        {".upAxis", "\"Y\""},
                                                                        {".defaultPrim", "\"branched\""},
                                                                        {".startTimeCode", "0"},
                                                                        {".endTimeCode", "1"},
                                                                        {".timeCodesPerSecond", "24"},
                                                                        {".framesPerSecond", "24"},
                                                                        {".creator", "\"bough \\\"1\\\"\""}})
        CHECK(at.at(name) == value);
    CHECK(at.at("/branched") == "SkelRoot");
    CHECK(at.at("/branched/skeleton") == "Skeleton");
    CHECK(at.at("/branched/skeleton/motion") == "SkelAnimation");
    std::size_t triangle = 0;
    for (const SkinPart& part : w.skin.part) {
        const std::string prim = "/branched/" + part.name, material = "/branched/materials/" + part.name;
        CHECK(at.at(prim) == "Mesh");
        CHECK(at.at(prim + ".material:binding") == "<" + material + ">");
        CHECK(at.at(prim + ".skel:skeleton") == "</branched/skeleton>");
        CHECK(numbers(at.at(prim + ".faceVertexCounts")) == std::vector<double>(part.index_count, 3));
        const std::vector<double> index = numbers(at.at(prim + ".faceVertexIndices"));
        const std::int32_t first = vertices_of(w.skin, part).first;
        for (std::size_t k = 0; k < index.size(); ++k)
            CHECK(std::int32_t(index[k]) + first == w.skin.triangle[triangle + k / 3][k % 3]);
        triangle += part.index_count;
        const std::vector<double> uv = numbers(at.at(prim + ".primvars:st"));
        for (std::size_t k = 0; k < uv.size(); ++k)
            CHECK(uv[k] == Approx(double(w.skin.texture[std::size_t(first) + k / 2][k % 2])).margin(1e-6));
        CHECK(at.at(material) == "Material");
        CHECK(at.at(material + "/surface.info:id") == "\"UsdPreviewSurface\"");
        CHECK(numbers(at.at(material + "/surface.inputs:diffuseColor")).size() == 3);
        CHECK(at.contains(prim + ".doubleSided") == (part.name == "leaf"));
    }
}

TEST_CASE("without frames there is no animation; far from the origin the root is moved") {
    Tree tree = make_tree::branched();
    CHECK_FALSE(written_usda(tree, {}).at.contains("/branched/skeleton/motion"));
    tree.joint_position[0] += Vec3(1e6, 0, 0);
    const WrittenUsda w = written_usda(tree, {bent(tree, 0, 1)});
    const std::vector<double> moved = numbers(w.at.at("/branched.xformOp:translate"));
    std::vector<Vec3> near = w.skin.position;
    for (Vec3& p : near) p -= Vec3(moved[0], moved[1], moved[2]);
    CHECK(off(w, 0, near) < 1e-5);
}
