// How sharp the bark of SpeedTree's own files is: the worst angle between the normals at the ends of an edge, in the file, at rest and bent.
#include "formats/models/speedtree_model.h"
#include "lib/growth/segment.h"
#include "lib/growth/skin.h"
#include "lib/model/drawn_pose.h"
#include "lib/model/wood.h"
#include "tests/support/import_support.h"
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

using namespace bough;
using namespace bough::test;

namespace {

double degrees(const Vec3& a, const Vec3& b) {
    return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180 / std::numbers::pi;
}

std::vector<double> values_in(const pugi::xml_node& of, const char* name) {
    std::istringstream text(of.child(name).text().get());
    return {std::istream_iterator<double>(text), {}};
}

// In the file itself, read by pugixml.
double worst_in_file(const std::string& content) {
    pugi::xml_document document;
    REQUIRE(document.load_buffer(content.data(), content.size()));
    double worst = 0;
    for (const pugi::xml_node& object : document.child("SpeedTreeRaw").child("Objects").children("Object")) {
        const pugi::xml_node vertices = object.child("Vertices");
        const std::vector<double> x = values_in(vertices, "NormalX"), y = values_in(vertices, "NormalY"),
                                  z = values_in(vertices, "NormalZ");
        const auto normal = [&](double v) { return Vec3(x[std::size_t(v)], y[std::size_t(v)], z[std::size_t(v)]); };
        for (const pugi::xml_node& triangles : object.children("Triangles")) {
            const std::vector<double> corner = values_in(triangles, "VertexIndices");
            for (std::size_t k = 0; k + 2 < corner.size(); k += 3)
                for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}})
                    worst = std::max(worst,
                                     degrees(normal(corner[k + std::size_t(a)]), normal(corner[k + std::size_t(b)])));
        }
    }
    return worst;
}

double worst_of(const Skin& skin, const std::vector<Vec3>& normal, std::size_t triangles) {
    double worst = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
        const auto [a, b, c] = skin.triangle[t];
        for (const auto& [i, j] : {std::pair(a, b), {b, c}, {c, a}})
            worst = std::max(worst, degrees(normal[std::size_t(i)], normal[std::size_t(j)]));
    }
    return worst;
}

// By how much the angle over an edge grows at most.
double most_growth_of(const Skin& skin, const std::vector<Vec3>& normal) {
    double most = 0;
    for (const auto& [a, b, c] : skin.triangle)
        for (const auto& [i, j] : {std::pair(a, b), {b, c}, {c, a}})
            most = std::max(most, degrees(normal[std::size_t(i)], normal[std::size_t(j)]) -
                                      degrees(skin.normal[std::size_t(i)], skin.normal[std::size_t(j)]));
    return most;
}

} // namespace

TEST_CASE("bark of SpeedTree's own files is no sharper bent by 30 degrees than the file has it") {
    for (const char* name : {"speedtree/SimpleTree_01_groups_m.xml", "speedtree/SimpleTree_01_spines_cm.xml",
                             "speedtree/SimpleTree_03_merged_cm.xml"}) {
        const std::optional<std::string> content = foreign_case(name);
        if (!content) return;
        ImportNotes found, notes;
        std::vector<std::string> said;
        const Tree tree = segment(import_splines(*content, {}, found), wood_presets().front(), {});
        OwnMesh mesh =
            bound_to(read_speedtree_model(*content, name, found, notes), tree, Eigen::Affine3d::Identity(), said);
        for (OwnPart& part : mesh.part) part.placed.clear();
        const Skin skin = skin_of(mesh);
        // Each trunk bends by 30 degrees in the joint at its middle; what it bears goes along.
        const DrawnPose pose = drawn_pose(tree);
        std::map<std::int32_t, std::vector<std::size_t>> joints; // of each trunk
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            if (tree.level[i] == 0 && continues_parent(tree, i)) joints[tree.branch[i]].push_back(i);
        std::vector<char> bends(tree.size_bodies(), false);
        for (const auto& [branch, of] : joints) bends[of[of.size() / 2]] = true;
        std::vector<Mat3> R(tree.size_bodies());
        std::vector<Vec3> x(tree.size_bodies());
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const std::int32_t p = tree.parent[i];
            const Mat3 turn = Eigen::AngleAxisd(bends[i] ? std::numbers::pi / 6 : 0, Vec3::UnitX()).toRotationMatrix();
            const Mat3 drawn = p < 0 ? pose.R_wb[i] : Mat3(pose.R_wb[std::size_t(p)].transpose() * pose.R_wb[i]);
            R[i] = p < 0 ? drawn : Mat3(R[std::size_t(p)] * drawn * turn);
            x[i] = p < 0 ? pose.x_w[i] : Vec3(x[std::size_t(p)] + R[std::size_t(p)] * tree.joint_position[i]);
        }
        std::vector<Vec3> position, normal;
        SkinDeformer(skin, tree).deform(R, x, position, normal);
        const std::size_t all = skin.triangle.size();
        const double grown = most_growth_of(skin, normal);
        const double own = worst_in_file(*content), rest = worst_of(skin, skin.normal, all),
                     bent = worst_of(skin, normal, all);
        WARN(name << ": worst angle between neighbouring normals [degrees]: the file's own " << own << ", at rest "
                  << rest << ", bent by 30 " << bent << "; an angle grows at most by " << grown);
        CHECK(rest == Approx(own).margin(0.1));
        CHECK(bent < own + 1);
        CHECK(grown < 25); // 30 where each vertex moves with one piece
    }
}
