#include "formats/models/driven_mesh.h"
#include "formats/exports/own_maps.h"
#include "formats/models/gltf_document.h"
#include "tests/support/two_bones.h"
#include <cstring>

using namespace bough;
using namespace bough::test;
using namespace bough::test::two_bones;

TEST_CASE("a skinned mesh goes where the sum of its bones' matrices puts it, what hangs on a node with the node") {
    TwoBones model;
    const Tree alone = model.tree();
    Placed at(model, alone);
    DrivenMesh& mesh = *at.mesh;
    const Tree& tree = at.tree;
    const Mat3& placed = at.turned;
    const Vec3& foot = at.foot;
    REQUIRE(mesh.vertices() == 29);
    for (const bool moved : {false, true}) {
        const Mat3 R = moved ? around_z(0.7) : Mat3(Mat3::Identity());
        const Mat3 Q = moved ? Eigen::AngleAxisd(-0.3, Vec3::UnitX()).toRotationMatrix() : Mat3(Mat3::Identity());
        const auto with_upper = [&](const Vec3& p) -> Vec3 { return Q * (upper_joint + R * (p - upper_joint)); };
        if (moved) mesh.go_to(bent_frame(tree, R, Q, placed, foot));
        std::vector<Vec3> position(29), normal(29);
        mesh.positions(0, position);
        mesh.normals(0, normal);
        double off = 0, turned_off = 0;
        const auto expect = [&](std::size_t v, const Vec3& p, const Vec3& n) {
            off = std::max(off, (position[v] - (foot + placed * p)).norm());
            turned_off = std::max(turned_off, (normal[v] - placed * n.normalized()).norm());
        };
        // The scene comes to the leaf's material first: on the twig, then in the pot and mirrored. The bark's vertices follow.
        const Vec3 n = model.leaf_normal;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = model.leaf[k];
            expect(k, with_upper(upper_joint + twig_place + twig_scale.cwiseProduct(p)),
                   Q * R * n.cwiseQuotient(twig_scale));
            expect(3 + k, pot_place + p, n);
            expect(6 + k, pot_place + mirror.cwiseProduct(p), mirror.cwiseProduct(n));
        }
        for (std::size_t v = 0; v < 20; ++v) {
            const double w = model.upper[v];
            const Vec3 &p = model.tube[v], &of = model.tube_normal[v];
            const Mat3 blended = (1 - w) * Q + w * Q * R;
            expect(9 + v, (1 - w) * Q * p + w * with_upper(p), blended.inverse().transpose() * of);
        }
        CHECK(off < 1e-6);
        CHECK(turned_off < 1e-6);
        // Any block of them is the same.
        std::vector<Vec3> some(7);
        mesh.positions(11, some);
        CHECK(std::equal(some.begin(), some.end(), position.begin() + 11));
    }
    CHECK(mesh.bones() == 2);
}

TEST_CASE("vertices that are kept are drawn where they are put, and go with the bones that they had") {
    TwoBones model;
    const Tree tree = model.tree();
    ImportNotes notes;
    std::vector<std::string> lines;
    DrivenMesh mesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    std::vector<Vec3> all(mesh.vertices());
    mesh.positions(0, all);
    // Of the leaf on the twig, of that in the pot, of the tube below, in the middle and above, in any order.
    const std::vector<std::int32_t> kept = {27, 1, 17, 4, 9};
    std::vector<Vec3> put;
    for (std::size_t k = 0; k < kept.size(); ++k)
        put.push_back(all[std::size_t(kept[k])] + 0.01 * double(k) * Vec3(1, -2, 3)); // the first stays
    mesh.keep(kept, put);
    REQUIRE(mesh.vertices() == kept.size());
    CHECK(mesh.skin().triangle.empty());
    std::vector<Vec3> drawn(kept.size());
    mesh.positions(0, drawn);
    for (std::size_t k = 0; k < kept.size(); ++k) CHECK((drawn[k] - put[k]).norm() < 1e-6);
    const Mat3 R = around_z(0.7), Q = Eigen::AngleAxisd(-0.3, Vec3::UnitX()).toRotationMatrix();
    mesh.go_to(bent_frame(tree, R, Q, Mat3::Identity(), Vec3::Zero()));
    mesh.positions(0, drawn);
    const auto with_upper = [&](const Vec3& p) -> Vec3 { return Q * (upper_joint + R * (p - upper_joint)); };
    CHECK((drawn[0] - with_upper(put[0])).norm() < 1e-6);
    CHECK((drawn[1] - with_upper(put[1])).norm() < 1e-6);
    CHECK((drawn[2] - (0.5 * (Q * put[2]) + 0.5 * with_upper(put[2]))).norm() < 1e-6);
    CHECK((drawn[3] - put[3]).norm() < 1e-6);
    CHECK((drawn[4] - Q * put[4]).norm() < 1e-6);
}

TEST_CASE("a vertex whose bones draw everything at one place stays there, finite") {
    TwoBones model;
    model.file.json["nodes"][5]["scale"] = {0, 0, 0}; // the twig's leaf is drawn as a point
    const Tree tree = model.tree();
    ImportNotes notes;
    std::vector<std::string> lines;
    DrivenMesh mesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    std::vector<Vec3> before(1), after(1);
    mesh.positions(0, before);
    mesh.keep(std::vector<std::int32_t>{0}, std::vector<Vec3>{before[0] + Vec3(0.1, 0, 0)});
    mesh.positions(0, after);
    CHECK((after[0] - before[0]).norm() < 1e-12);
}

TEST_CASE("a vertex's body is the one that its largest share follows") {
    TwoBones model;
    const Tree tree = model.tree();
    ImportNotes notes;
    std::vector<std::string> lines;
    const DrivenMesh mesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    const Skin skin = mesh.skin_of_bodies();
    const DrawnPose drawn = drawn_pose(tree);
    REQUIRE(skin.joint.size() == 29);
    const auto height = [&](std::size_t v) { return drawn.x_w[std::size_t(skin.joint[v][0])].y(); };
    for (std::size_t v = 0; v < 29; ++v) {
        CHECK(skin.weight[v] == std::array<float, 4>{1, 0, 0, 0});
        const bool pot = v >= 3 && v < 9, above = v < 3 || (v >= 9 && model.upper[v - 9] == 1);
        if (pot)
            CHECK(skin.joint[v][0] == 0);
        else if (v < 9 || model.upper[v - 9] != 0.5)
            CHECK((height(v) > 1 - 1e-6) == above);
    }
}

TEST_CASE("a skinned mesh's triangles, coordinates and materials are the file's") {
    TwoBones model;
    GltfJson& json = model.file.json;
    const std::string png = std::string("\x89PNG\r\n\x1a\n") + std::string(41, 'x');
    json["images"] = {{{"mimeType", "image/png"},
                       {"name", "bark colour"},
                       {"bufferView",
                        [&] {
                            model.file.add(std::vector<char>(png.begin(), png.end()), "SCALAR", 5121);
                            json["accessors"].erase(json["accessors"].size() - 1);
                            return json["bufferViews"].size() - 1;
                        }()}},
                      {{"uri", "gone.png"}}};
    json["textures"] = {{{"source", 1}}, {{"source", 0}}};
    json["materials"][1] = {{"name", "old bark"},
                            {"alphaMode", "MASK"},
                            {"normalTexture", {{"index", 0}}},
                            {"pbrMetallicRoughness",
                             {{"baseColorTexture",
                               {{"index", 1},
                                {"texCoord", 0},
                                {"extensions",
                                 {{"KHR_texture_transform",
                                   {{"texCoord", 1},
                                    {"offset", {0.5, 0.25}},
                                    {"scale", {2, 3}},
                                    {"rotation", double(EIGEN_PI) / 2}}}}}}}}}};
    json["materials"].push_back({{"name", "old bark"}}); // of none
    json["materials"][0]["name"] = "old\tbark";
    ImportNotes notes;
    std::vector<std::string> lines;
    const Tree tree = model.tree();
    const DrivenMesh mesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    const Skin skin = mesh.skin();
    REQUIRE(skin.part.size() == 2);
    CHECK(skin.part[0].name == "old_bark");
    CHECK(skin.part[1].name == "old_bark_2");
    CHECK((skin.part[0].color - Vec3(1, 0.7353569830524495, 0)).norm() < 1e-6); // 1.055 * 0.5^(1/2.4) - 0.055
    REQUIRE(skin.triangle.size() == 3 + 32);
    CHECK(skin.part[1].first_index == 3);
    CHECK(skin.part[1].index_count == 32);
    // Seen from outside, the mirrored one too.
    for (const auto& [a, b, c] : skin.triangle) {
        const Vec3 &p = skin.position[std::size_t(a)], &q = skin.position[std::size_t(b)],
                   &r = skin.position[std::size_t(c)];
        const Vec3 area = (q - p).cross(r - p);
        if (std::max({a, b, c}) <
            9) // the leaf's own normals lie aslant: its front is where +Z is, of the mirrored one too
            CHECK(area.z() > 0);
        else
            CHECK(area.dot(skin.normal[std::size_t(a)] + skin.normal[std::size_t(b)] + skin.normal[std::size_t(c)]) >
                  0);
    }
    // A quarter turn takes (u, v), scaled, to (3 v, -2 u); then it is moved, and v counted from the bottom.
    for (std::size_t v = 0; v < 20; ++v) {
        const double u = double(v % 4) / 4, w = double(v / 4) / 4;
        CHECK(std::abs(skin.texture[9 + v][0] - (0.5 + 3 * w)) < 1e-6);
        CHECK(std::abs(skin.texture[9 + v][1] - (1 - (0.25 - 2 * u))) < 1e-6);
    }
    const OwnMaps maps = maps_of(mesh.look(), "frames.mtl");
    REQUIRE(maps.image.size() == 1);
    CHECK(*maps.image[0].bytes == png);
    CHECK(maps.part[1].color == "frames_textures/bark_colour.png");
    CHECK(maps.part[1].cut);
    CHECK(maps.part[1].normal.empty());
    CHECK(maps.part[0].color.empty());
    const bool told = std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.find("model.gltf: image 1 is not in the file: its material does without it") != std::string::npos;
    });
    CHECK(told);
}

TEST_CASE("normals that a skinned file has not are made, what it cannot show is told of, what is wrong is refused") {
    const auto mesh_of = [](TwoBones& model, std::vector<std::string>& lines) {
        ImportNotes notes;
        const Tree tree = TwoBones().tree();
        return DrivenMesh(read_user_model(model.file.saved(), notes), tree, {}, lines);
    };
    std::vector<std::string> lines;
    {
        TwoBones model;
        GltfJson& bark = model.file.json["meshes"][0]["primitives"][0];
        bark["attributes"].erase("NORMAL");
        bark["targets"] = {{{"POSITION", bark["attributes"]["POSITION"]}}};
        const DrivenMesh mesh = mesh_of(model, lines);
        std::vector<Vec3> normal(20);
        mesh.normals(9, normal);
        // By the tube's own shape they point outward, those in the middle straight.
        for (std::size_t v = 0; v < 20; ++v) CHECK(normal[v].dot(model.tube_normal[v]) > 0.7);
        CHECK(std::abs(normal[9].y()) < 1e-6);
        CHECK(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
            return line.find("morph targets are not shown") != std::string::npos;
        }));
    }
    const auto refuses = [&](const std::string& what,
                             const std::function<void(TwoBones&, GltfJson & attributes)>& spoil) {
        INFO(what);
        TwoBones model;
        spoil(model, model.file.json["meshes"][0]["primitives"][0]["attributes"]);
        CHECK_THROWS_WITH(mesh_of(model, lines), Catch::Matchers::Contains(what));
    };
    refuses("NORMAL has 3 elements, expected one for each of 20 vertices", [](TwoBones& model, GltfJson& bark) {
        bark["NORMAL"] = model.file.add(std::vector<std::int8_t>(9, 1), "VEC3", 5120, true);
    });
    refuses("JOINTS_2 has joint 2 move vertex 0, but skin 0 has 2 joints", [](TwoBones& model, GltfJson& bark) {
        bark["JOINTS_2"] = model.file.add(std::vector<std::uint8_t>(80, 2), "VEC4", 5121);
        bark["WEIGHTS_2"] = model.file.add(std::vector<std::uint8_t>(80, 9), "VEC4", 5121, true);
    });
    refuses("JOINTS_2 comes without WEIGHTS_2", [](TwoBones&, GltfJson& bark) { bark["JOINTS_2"] = bark["JOINTS_0"]; });
    refuses("WEIGHTS_1: vertex 2 is not finite", [](TwoBones& model, GltfJson& bark) {
        std::vector<float> weight(80, 0.25f);
        weight[9] = NAN;
        bark["WEIGHTS_1"] = model.file.add(weight, "VEC4", 5126);
    });
    refuses("vertex 9 of its mesh is drawn beyond any float", [](TwoBones& model, GltfJson& bark) {
        std::vector<Vec3> far(20, Vec3(3e38, 0, 0));
        bark["POSITION"] = model.file.floats(far);
    });
    refuses("TEXCOORD_1 of vertex 4 is moved beyond any float", [](TwoBones& model, GltfJson&) {
        model.file.json["textures"] =
            GltfJson::array({GltfJson::object()}); // clang takes a brace about one object for the object
        model.file.json["materials"][1]["normalTexture"] = {
            {"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {1, 1e300}}}}}}};
    });
    refuses("Draco", [](TwoBones& model, GltfJson&) {
        model.file.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
        model.file.json["meshes"][0]["primitives"][0]["extensions"] = {
            {"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
    });
}
