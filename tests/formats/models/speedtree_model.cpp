// formats/imports/speedtree_mesh.h, formats/models/speedtree_model.h, wood_axes.h: a SpeedTree file's mesh, read, bound and written, held
// against the file as pugixml reads it, corner by corner.
#include "formats/models/speedtree_model.h"
#include "formats/exports/gltf.h"
#include "formats/exports/own_mover.h"
#include "lib/model/append.h"
#include "lib/model/drawn_pose.h"
#include "tests/support/gltf_reader.h"
#include "tests/support/import_support.h"
#include "tests/support/shown_speedtree.h"
#include "tests/support/speedtree_sample.h"
#include <filesystem>
#include <pugixml.hpp>
#include <unistd.h>

using namespace bough;
using namespace bough::test;

namespace {

std::string glb_of(const Shown& shown, const std::vector<MotionFrame>& frames = {}) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bough_own_" + std::to_string(::getpid()) + ".glb")).string();
    const JointGroups groups = merge_joints(shown.tree, shown.tree.size_bodies());
    Output output(path);
    GltfWriter writer(output, shown.mesh, shown.tree, groups, {});
    for (const MotionFrame& frame : frames) writer.write(frame);
    writer.finish();
    output.finish();
    const std::string bytes = content_of(path);
    std::filesystem::remove(path);
    return bytes;
}

std::vector<double> numbers(const pugi::xml_node& node, const char* child) {
    std::istringstream text(node.child(child).text().get());
    std::vector<double> values;
    for (std::string word; text >> word;) {
        std::replace(word.begin(), word.end(), ',', '.');
        values.push_back(std::stod(word));
    }
    return values;
}

struct Corner {
    Eigen::Vector3d position, normal;
    double u, v;
};

// Of each material's ID, in order: of objects, then of what leaf references place.
std::map<int, std::vector<Corner>> corners_of(const std::string& content, double unit) {
    pugi::xml_document document;
    REQUIRE(document.load_string(content.c_str() + (content.starts_with("\xEF\xBB\xBF") ? 3 : 0)));
    const pugi::xml_node root = document.child("SpeedTreeRaw");
    const auto up = [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.z(), -p.y()); };
    const auto vector = [](const std::vector<double>* of, std::size_t k) {
        return Eigen::Vector3d(of[0][k], of[1][k], of[2][k]);
    };
    std::map<int, std::vector<Corner>> all, placed;
    for (const pugi::xml_node& object : root.child("Objects").children("Object")) {
        const Eigen::Vector3d origin(object.attribute("AbsX").as_double(), object.attribute("AbsY").as_double(),
                                     object.attribute("AbsZ").as_double());
        const pugi::xml_node list = object.child("Points"), record = object.child("Vertices");
        const std::vector<double> p[] = {numbers(list, "X"), numbers(list, "Y"), numbers(list, "Z")},
                                  n[] = {numbers(record, "NormalX"), numbers(record, "NormalY"),
                                         numbers(record, "NormalZ")},
                                  u = numbers(record, "TexcoordU"), v = numbers(record, "TexcoordV");
        for (const pugi::xml_node& triangles : object.children("Triangles")) {
            const std::vector<double> at = numbers(triangles, "PointIndices"), of = numbers(triangles, "VertexIndices");
            for (std::size_t k = 0; k < at.size(); ++k) {
                const auto i = std::size_t(of[k]);
                all[triangles.attribute("Material").as_int()].push_back(
                    {unit * up(vector(p, std::size_t(at[k])) + origin), up(vector(n, i)), u[i], v[i]});
            }
        }
        for (const pugi::xml_node& leaves : object.children("LeafReferences")) {
            const std::vector<double> x[] = {numbers(leaves, "X"), numbers(leaves, "Y"), numbers(leaves, "Z")},
                                      axis[] = {numbers(leaves, "RotAxisX"), numbers(leaves, "RotAxisY"),
                                                numbers(leaves, "RotAxisZ")},
                                      angle = numbers(leaves, "RotAngle"), scale = numbers(leaves, "Scale"),
                                      id = numbers(leaves, "MeshID");
            for (std::size_t k = 0; k < angle.size(); ++k) {
                pugi::xml_node lod;
                for (const pugi::xml_node& mesh : root.child("Meshes").children("Mesh"))
                    if (mesh.attribute("ID").as_int() == int(id[k])) lod = mesh.child("LOD");
                const pugi::xml_node vertices = lod.child("Vertices");
                const std::vector<double> q[] = {numbers(vertices, "X"), numbers(vertices, "Y"),
                                                 numbers(vertices, "Z")};
                std::vector<double> index = numbers(lod, "TriangleIndices"), quad = numbers(lod, "QuadIndices");
                for (std::size_t c = 0; c + 3 < quad.size(); c += 4)
                    for (const std::size_t d : {0, 1, 2, 0, 2, 3}) index.push_back(quad[c + d]);
                const Eigen::Matrix3d turn =
                    Eigen::AngleAxisd(angle[k] * std::numbers::pi / 180, vector(axis, k).normalized())
                        .toRotationMatrix();
                for (const double i : index)
                    placed[leaves.attribute("Material").as_int()].push_back(
                        {unit * up(vector(x, k) + scale[k] * (turn * vector(q, std::size_t(i)))),
                         Eigen::Vector3d::Zero(), NAN, NAN});
            }
        }
    }
    for (auto& [material, more] : placed) all[material].insert(all[material].end(), more.begin(), more.end());
    return all;
}

// Every corner where the file has it, moved by `place`.
void hold(const std::string& bytes, const std::string& content, double unit,
          const Eigen::Affine3d& place = Eigen::Affine3d::Identity()) {
    const gltf_reader::Glb glb = gltf_reader::parse(bytes);
    const std::map<int, std::vector<Corner>> expected = corners_of(content, unit);
    pugi::xml_document document;
    REQUIRE(document.load_string(content.c_str() + (content.starts_with("\xEF\xBB\xBF") ? 3 : 0)));
    std::vector<int> ids;
    for (const pugi::xml_node& m : document.child("SpeedTreeRaw").child("Materials").children("Material"))
        ids.push_back(m.attribute("ID").as_int());
    double low = INFINITY, high = -INFINITY;
    for (const auto& [material, corners] : expected)
        for (const Corner& c : corners) low = std::min(low, c.position.y()), high = std::max(high, c.position.y());
    std::size_t primitives = 0;
    double off = 0, turned = 0, uv_off = 0;
    for (const auto& primitive : glb.json["meshes"][0]["primitives"]) {
        const std::vector<Corner>& corners = expected.at(ids.at(primitive["material"]));
        const auto& attributes = primitive["attributes"];
        const std::vector<double> p = gltf_reader::numbers(glb, attributes["POSITION"]),
                                  n = gltf_reader::numbers(glb, attributes["NORMAL"]),
                                  index = gltf_reader::numbers(glb, primitive["indices"]);
        std::vector<double> uv;
        if (attributes.contains("TEXCOORD_0")) uv = gltf_reader::numbers(glb, attributes["TEXCOORD_0"]);
        REQUIRE(index.size() == corners.size());
        for (std::size_t k = 0; k < index.size(); ++k) {
            const auto i = std::size_t(index[k]);
            const Eigen::Vector3d at(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
            off = std::max(off, (at - place * corners[k].position).norm());
            if (std::isnan(corners[k].u)) continue;
            turned = std::max(turned, (Eigen::Vector3d(n[3 * i], n[3 * i + 1], n[3 * i + 2]) -
                                       place.linear() * corners[k].normal.normalized())
                                          .norm());
            uv_off = std::max({uv_off, std::abs(uv[2 * i] - corners[k].u), std::abs(1 - uv[2 * i + 1] - corners[k].v)});
        }
        ++primitives;
    }
    CHECK(primitives == expected.size());
    CHECK(off <= 1e-6 * (high - low));
    CHECK(turned < 1e-5);
    CHECK(uv_off < 1e-5);
    // Weights are whole, and rest is the drawn pose.
    for (const auto& primitive : glb.json["meshes"][0]["primitives"]) {
        const std::vector<double> w = gltf_reader::numbers(glb, primitive["attributes"]["WEIGHTS_0"]);
        for (std::size_t k = 0; k < w.size(); k += 4) CHECK(std::abs(w[k] + w[k + 1] + w[k + 2] + w[k + 3] - 1) < 1e-6);
    }
}

// The poses that a turn of each joint by theta(i) [rad] about x gives.
template <class Theta> MotionFrame bent(const Tree& tree, Theta theta) {
    MotionFrame frame;
    std::vector<Mat3> R;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::int32_t p = tree.parent[i];
        const Mat3 own = tree.joint_rotation[i].toRotationMatrix() * Eigen::AngleAxisd(theta(i), Vec3::UnitX());
        R.push_back(p < 0 ? own : Mat3(R[std::size_t(p)] * own));
        frame.rotation.push_back(Quat(R.back()));
        frame.position.push_back(
            p < 0 ? tree.joint_position[i]
                  : Vec3(frame.position[std::size_t(p)] + R[std::size_t(p)] * tree.joint_position[i]));
    }
    return frame;
}

// The largest angle between faces that stand above each other on the trunk [deg], from ring to ring.
double worst_crease(const Skin& skin, const speedtree_sample::Tube& trunk, const std::vector<Vec3>& position) {
    const auto normal = [&](std::size_t t) {
        const auto [a, b, c] = skin.triangle[t];
        return Vec3((position[std::size_t(b)] - position[std::size_t(a)])
                        .cross(position[std::size_t(c)] - position[std::size_t(a)])
                        .normalized());
    };
    const std::size_t ring = 2 * std::size_t(trunk.sides), all = ring * std::size_t(trunk.rings - 1);
    double worst = 0;
    for (std::size_t t = 0; t + ring < all; ++t)
        worst = std::max(worst, std::acos(std::clamp(normal(t).dot(normal(t + ring)), -1.0, 1.0)));
    return worst * 180 / std::numbers::pi;
}

} // namespace

TEST_CASE("The mesh of a SpeedTree file comes through whole") {
    const std::string content = speedtree_sample::file({}, "", speedtree_sample::references(1));
    for (const bool spine : {true, false}) {
        const std::string text = speedtree_sample::file({}, "", speedtree_sample::references(1), spine);
        const Shown shown = shown_of(text);
        hold(glb_of(shown), text, 1);
    }
    const gltf_reader::Glb glb = gltf_reader::parse(glb_of(shown_of(content)));
    CHECK(glb.json["materials"].size() == 2);
    CHECK(glb.json["materials"][0]["name"] == "Bark");
    CHECK(glb.json["materials"][1]["doubleSided"] == true);
    const std::vector<double> factor = glb.json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"];
    CHECK(factor[1] == Approx(0.2140411)); // sRGB 0.5
    const std::vector<double> color =
        gltf_reader::numbers(glb, glb.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"]);
    CHECK(color[0] == Approx(0.5).margin(1e-5));
    CHECK(color[3] == 1);
    const Eigen::Affine3d place = Eigen::Translation3d(5, 0, -2) * Eigen::AngleAxisd(0.7, Vec3::UnitY());
    Shown moved = shown_of(content);
    Tree tree;
    append(tree, moved.tree, place.translation(), 0.7);
    ImportNotes found, notes;
    ImportOptions options;
    import_splines(content, options, found);
    moved.mesh = bound_to(read_speedtree_model(content, "t.xml", found, notes), tree, place, moved.notes);
    moved.tree = tree;
    hold(glb_of(moved), content, 1, place);
}

TEST_CASE("The meshes of SpeedTree's own files come through whole, and V grows from the bottom of an image up") {
    for (const auto& [name, unit] :
         {std::pair("speedtree/SimpleTree_01_groups_m.xml", 1.0), {"speedtree/SimpleTree_03_merged_cm.xml", 0.01}}) {
        const std::optional<std::string> content = foreign_case(name);
        if (!content) return;
        const Shown shown = shown_of(*content);
        hold(glb_of(shown), *content, unit);
        // Images are not mirrored on the bark: u, v and the way out are right-handed where v grows upward, so here, where it grows downward,
        // left-handed. (So it is on the leaves of the twigs, whose wood another program has made.)
        std::size_t left = 0, right = 0;
        for (const OwnPart& part : shown.mesh.part) {
            const OwnSurface& s = part.standing;
            for (const auto& [a, b, c] : s.triangle) {
                const auto& uv = s.uv.at(0);
                const float du1 = uv[std::size_t(b)][0] - uv[std::size_t(a)][0],
                            dv1 = uv[std::size_t(b)][1] - uv[std::size_t(a)][1],
                            du2 = uv[std::size_t(c)][0] - uv[std::size_t(a)][0],
                            dv2 = uv[std::size_t(c)][1] - uv[std::size_t(a)][1];
                const float area = du1 * dv2 - du2 * dv1;
                if (std::abs(area) < 1e-9f) continue;
                const Eigen::Vector3f out = (s.position[std::size_t(b)] - s.position[std::size_t(a)])
                                                .cross(s.position[std::size_t(c)] - s.position[std::size_t(a)]);
                const Eigen::Vector3f facing = s.normal[std::size_t(a)];
                (area * out.dot(facing) < 0 ? left : right) += 1;
            }
        }
        CAPTURE(name, left, right);
        CHECK(left > 20 * right);
        // Every twig moves with a body of its own.
        for (const OwnPart& part : shown.mesh.part)
            for (const OwnPlace& placed : part.placed) CHECK(shown.tree.kind[std::size_t(placed.body)] == Kind::leaf);
    }
}

TEST_CASE("Bark bends and does not crease") {
    const speedtree_sample::Tube trunk;
    const Shown shown = shown_of(speedtree_sample::file(trunk, "", ""));
    const Tree& tree = shown.tree;
    const Skin soft = skin_of(shown.mesh);
    Skin hard = soft; // as SpeedTree binds it: one piece a vertex
    for (auto& w : hard.weight) w = w[0] >= w[1] ? std::array<float, 4>{1, 0, 0, 0} : std::array<float, 4>{0, 1, 0, 0};
    std::vector<std::size_t> joints;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.branch[i] == 0 && tree.parent[i] >= 0) joints.push_back(i);
    REQUIRE(joints.size() >= 4);
    const double whole = std::numbers::pi / 6;
    const auto crease = [&](const Skin& skin, std::size_t first, std::size_t count) {
        const MotionFrame frame = bent(tree, [&](std::size_t i) {
            const bool one =
                std::find(joints.begin() + std::ptrdiff_t(first), joints.begin() + std::ptrdiff_t(first + count), i) !=
                joints.begin() + std::ptrdiff_t(first + count);
            return one ? whole / double(count) : 0.0;
        });
        std::vector<Mat3> R;
        for (const Quat& q : frame.rotation) R.push_back(q.toRotationMatrix());
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(R, frame.position, position, normal);
        return worst_crease(skin, trunk, position);
    };
    const std::size_t middle = joints.size() / 2;
    const double rest = worst_crease(soft, trunk, soft.position), one = crease(soft, middle, 1),
                 sharp = crease(hard, middle, 1), spread = crease(soft, 0, joints.size()),
                 spread_sharp = crease(hard, 0, joints.size());
    WARN("worst angle between faces of neighbouring rings [degrees]: at rest "
         << rest << "; 30 in one joint " << one << ", bound to one piece " << sharp << "; 30 over " << joints.size()
         << " joints " << spread << ", bound to one piece " << spread_sharp);
    CHECK(rest < 1e-3);
    CHECK(one < 0.62 * sharp);
    CHECK(spread < 0.62 * spread_sharp);
}

TEST_CASE("What a vertex is bound to") {
    const Shown shown = shown_of(speedtree_sample::file({}, "", speedtree_sample::references(1)));
    const DrawnPose pose = drawn_pose(shown.tree);
    const OwnPart& bark = shown.mesh.part.at(0);
    for (std::size_t v = 0; v < bark.body.size(); ++v) {
        const Vec3 p = bark.standing.position[v].cast<double>();
        const bool branch = std::hypot(p.y() - 3, p.z()) < 0.05 && p.x() > 0.101;
        for (int k = 0; k < 2; ++k) {
            if ((k == 0 ? 1 - bark.second[v] : bark.second[v]) <= 0) continue;
            const auto body = std::size_t(bark.body[v][std::size_t(k)]);
            // Bark of the trunk is never moved by the branch; that of the branch by it alone, from a little above its base on.
            if (std::hypot(p.x(), p.z()) > 0.099 && std::abs(p.y() - 3) > 0.05) CHECK(shown.tree.branch[body] == 0);
            if (branch && p.x() > 0.3) CHECK(shown.tree.branch[body] == 1);
        }
    }
    for (const OwnPlace& place : shown.mesh.part.at(1).placed) {
        CHECK(shown.tree.kind[std::size_t(place.body)] == Kind::leaf);
        CHECK((pose.x_w[std::size_t(place.body)] - place.place.cast<double>()).norm() < 1e-6);
    }
}

TEST_CASE("The vertices of a mesh of its own, some at a time, are those of its skin bit by bit") {
    const Shown shown = shown_of(speedtree_sample::file({}, "", speedtree_sample::references(1)));
    const Skin skin = skin_of(shown.mesh);
    OwnMover mover(shown.mesh, shown.tree);
    REQUIRE(mover.vertices() == skin.position.size());
    for (const double angle : {0.0, 0.3}) {
        const MotionFrame frame = bent(shown.tree, [&](std::size_t i) { return angle * std::sin(double(i)); });
        std::vector<Mat3> R;
        for (const Quat& q : frame.rotation) R.push_back(q.toRotationMatrix());
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, shown.tree).deform(R, frame.position, position, normal);
        mover.go_to(frame);
        for (const std::size_t size : {std::size_t(1), std::size_t(7), std::size_t(5000)})
            for (std::size_t first = 0; first < position.size(); first += size) {
                std::vector<Vec3> some(std::min(size, position.size() - first));
                mover.positions(first, some);
                REQUIRE(std::memcmp(some.data(), position.data() + first, some.size() * sizeof(Vec3)) == 0);
            }
    }
}

TEST_CASE("Tangents of the file stand where a normal map takes them: along u, and normal x tangent along v") {
    for (const bool turned : {false, true}) {
        Eigen::Affine3d place = Eigen::Affine3d::Identity();
        if (turned) place = Eigen::Translation3d(3, 0, -2) * Eigen::AngleAxisd(0.7, Vec3::UnitY());
        Shown shown = shown_of(speedtree_sample::file({}, "", speedtree_sample::references(1)));
        if (turned) { // where a scene puts the tree, it puts its mesh
            Tree moved;
            append(moved, shown.tree, Vec3(3, 0, -2), 0.7);
            shown = shown_of(speedtree_sample::file({}, "", speedtree_sample::references(1)), place, &moved);
        }
        CHECK(glb_of(shown).find("TANGENT") == std::string::npos); // no normal map
        for (std::string& material : shown.mesh.material) material.insert(1, "\"normalTexture\":{\"index\":0},");
        const gltf_reader::Glb glb = gltf_reader::parse(glb_of(shown));
        std::size_t seen = 0;
        for (const auto& primitive : glb.json["meshes"][0]["primitives"]) {
            const auto& attributes = primitive["attributes"];
            if (!attributes.contains("TANGENT")) continue; // the twig's mesh has none
            const auto of = [&](const char* name) { return gltf_reader::numbers(glb, attributes[name]); };
            const std::vector<double> p = of("POSITION"), n = of("NORMAL"), t = of("TANGENT"), uv = of("TEXCOORD_0"),
                                      corner = gltf_reader::numbers(glb, primitive["indices"]);
            for (std::size_t k = 0; k < corner.size(); k += 3) {
                const auto at = [&](const std::vector<double>& from, std::size_t c) {
                    return Vec3(from[3 * c], from[3 * c + 1], from[3 * c + 2]);
                };
                const std::size_t a = std::size_t(corner[k]), b = std::size_t(corner[k + 1]),
                                  c = std::size_t(corner[k + 2]);
                const Vec3 e1 = at(p, b) - at(p, a), e2 = at(p, c) - at(p, a);
                const double u1 = uv[2 * b] - uv[2 * a], u2 = uv[2 * c] - uv[2 * a], v1 = uv[2 * a + 1] - uv[2 * b + 1],
                             v2 = uv[2 * a + 1] - uv[2 * c + 1]; // v up, as a normal map's green is
                const double area = u1 * v2 - u2 * v1;
                const Vec3 along_u = (e1 * v2 - e2 * v1) / area, along_v = (e2 * u1 - e1 * u2) / area;
                const Vec3 tangent(t[4 * a], t[4 * a + 1], t[4 * a + 2]);
                CHECK(tangent.norm() == Approx(1).margin(1e-6));
                CHECK(std::abs(t[4 * a + 3]) == 1);
                CHECK(tangent.dot(along_u.normalized()) > 0.96);
                CHECK((at(n, a).cross(tangent) * t[4 * a + 3]).dot(along_v.normalized()) > 0.96);
                ++seen;
            }
        }
        CHECK(seen > 1000);
    }
}
