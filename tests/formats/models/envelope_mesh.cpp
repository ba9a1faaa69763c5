// envelope_mesh.h: meshes written here in each format, other programs' models where they are present, and what is refused.
#include "formats/models/envelope_mesh.h"
#include "tests/support/solids.h"
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <numbers>

using namespace bough;

namespace {

EnvelopeMesh read(const std::string& content, const std::string& name = "crown", std::optional<double> unit = {},
                  char up = 0, ImportNotes* notes = nullptr) {
    ImportOptions options;
    options.name = name;
    options.unit = unit;
    options.up = up;
    ImportNotes own;
    return read_envelope_mesh(content, name, options, notes ? *notes : own);
}

MeshInterior interior(const EnvelopeMesh& m) {
    return MeshInterior(m.vertex, m.triangle);
}

Vec3 extent(const EnvelopeMesh& m) {
    const MeshInterior i = interior(m);
    return i.upper() - i.lower();
}

std::string dae(const solids::Solid& s, const std::string& unit, const std::string& up) {
    std::string places, faces;
    for (const Vec3& p : s.vertex)
        for (int k = 0; k < 3; ++k) places += std::to_string(p[k]) + " ";
    for (const Triangle& t : s.triangle)
        for (const std::int32_t c : t) faces += std::to_string(c) + " ";
    return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
           unit + "<up_axis>" + up +
           R"(</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count=")" +
           std::to_string(3 * s.vertex.size()) + "\">" + places +
           R"(</float_array><technique_common><accessor source="#pa" count=")" + std::to_string(s.vertex.size()) +
           R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count=")" +
           std::to_string(s.triangle.size()) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + faces +
           R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

// One mesh under a node that moves it up by 5.
std::string glb(const solids::Solid& s) {
    std::string data;
    Vec3 low = s.vertex[0], high = low;
    for (const Vec3& p : s.vertex) {
        low = low.cwiseMin(p), high = high.cwiseMax(p);
        for (int k = 0; k < 3; ++k) {
            const auto value = static_cast<float>(p[k]);
            data.append(reinterpret_cast<const char*>(&value), 4);
        }
    }
    const std::size_t places = data.size();
    for (const Triangle& t : s.triangle) data.append(reinterpret_cast<const char*>(t.data()), 12);
    const auto list = [](const Vec3& p) {
        return "[" + std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z()) + "]";
    };
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,5,0]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":)" +
        std::to_string(data.size()) + R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
        std::to_string(places) + R"(},{"buffer":0,"byteOffset":)" + std::to_string(places) + R"(,"byteLength":)" +
        std::to_string(data.size() - places) + R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
        std::to_string(s.vertex.size()) + R"(,"type":"VEC3","min":)" + list(low) + R"(,"max":)" + list(high) +
        R"(},{"bufferView":1,"componentType":5125,"count":)" + std::to_string(3 * s.triangle.size()) +
        R"(,"type":"SCALAR"}]})";
    while (json.size() % 4) json += ' ';
    const auto word = [](std::size_t n) {
        const auto value = static_cast<std::uint32_t>(n);
        return std::string(reinterpret_cast<const char*>(&value), 4);
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + data.size()) + word(json.size()) + "JSON" + json +
           word(data.size()) + std::string("BIN\0", 4) + data;
}

// ASCII FBX 7.4 of a unit tetrahedron at the origin, its settings as given.
std::string fbx(int up, int up_sign, int front, int front_sign, double unit) {
    const auto integer = [](const std::string& name, int value) {
        return "\t\tP: \"" + name + "\", \"int\", \"Integer\", \"\"," + std::to_string(value) + "\n";
    };
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
           "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n" +
           integer("UpAxis", up) + integer("UpAxisSign", up_sign) + integer("FrontAxis", front) +
           integer("FrontAxisSign", front_sign) + integer("CoordAxis", 0) + integer("CoordAxisSign", 1) +
           "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + std::to_string(unit) + "\n\t}\n}\n" +
           "Objects:  {\n\tGeometry: 1000, \"Geometry::t\", \"Mesh\" {\n\t\tVertices: *12 {\n\t\t\ta: "
           "0,0,0,1,0,0,0,2,0,0,0,3\n\t\t}\n\t\tPolygonVertexIndex: *12 {\n\t\t\ta: "
           "0,2,-2,0,1,-4,0,3,-3,1,2,-4\n\t\t}\n"
           "\t\tGeometryVersion: 124\n\t}\n\tModel: 2000, \"Model::t\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n}\n"
           "Connections:  {\n\tC: \"OO\",2000,0\n\tC: \"OO\",1000,2000\n}\n";
}

bool close_to(const Vec3& a, const Vec3& b) {
    return (a - b).norm() < 1e-5;
}

} // namespace

TEST_CASE("An OBJ keeps its shape; polygons, also concave ones, are triangulated") {
    ImportNotes notes;
    const EnvelopeMesh ball = read(solids::obj_text(solids::icosphere(3)), "crown.obj", {}, 0, &notes);
    CHECK(notes.lines.size() == 2); // unit and axis are guesses
    CHECK(ball.triangle.size() == 1280);
    CHECK(interior(ball).closure().alike);
    CHECK(interior(ball).closure().volume == Approx(4 * std::numbers::pi / 3).epsilon(0.02));
    std::string l = "# an L\n";
    for (const Vec3& p : solids::l_prism().vertex)
        l += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    l += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
    for (int i = 1; i <= 6; ++i) {
        const int j = i % 6 + 1;
        l += "f " + std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(j + 6) + " " +
             std::to_string(i + 6) + "\n";
    }
    const EnvelopeMesh prism = read(l);
    CHECK(interior(prism).closure().volume == Approx(32));
    CHECK(interior(prism).contains({1, 7, 1}));
    CHECK_FALSE(interior(prism).contains({3, 7, 1}));
}

TEST_CASE("Units and up axes of OBJ: guessed from the height, or given") {
    const std::string tall = solids::obj_text(solids::moved(solids::l_prism(), 100, Vec3::Zero()));
    CHECK(close_to(extent(read(tall)), {4, 6, 2})); // 600 units high: centimetres
    CHECK(close_to(extent(read(tall, "x", 0.001)), {0.4, 0.6, 0.2}));
    const MeshInterior turned = interior(read(tall, "x", 0.01, 'z'));
    CHECK(close_to(turned.lower(), {0, 0, -8}));
    CHECK(close_to(turned.upper(), {4, 2, -2}));
    CHECK(turned.closure().volume == Approx(32));
}

TEST_CASE("COLLADA's unit and axis are applied once, and overridden") {
    const solids::Solid l = solids::l_prism();
    CHECK(close_to(extent(read(dae(l, R"(<unit name="meter" meter="1"/>)", "Y_UP"))), {4, 6, 2}));
    CHECK(close_to(extent(read(dae(l, R"(<unit name="decimeter" meter="0.1"/>)", "Y_UP"))), {0.4, 0.6, 0.2}));
    const MeshInterior z_up = interior(read(dae(l, R"(<unit meter="1"/>)", "Z_UP")));
    CHECK(close_to(z_up.lower(), {0, 0, -8}));
    CHECK(close_to(z_up.upper(), {4, 2, -2}));
    CHECK(close_to(extent(read(dae(l, R"(<unit meter="0.1"/>)", "Z_UP"), "x", 0.5, 'y')), {2, 3, 1}));
}

TEST_CASE("A binary glTF: metres, its node's place applied") {
    const MeshInterior m = interior(read(glb(solids::l_prism()), "crown.glb"));
    CHECK(close_to(m.lower(), {0, 7, 0}));
    CHECK(close_to(m.upper(), {4, 13, 2}));
    CHECK(m.closure().alike);
}

TEST_CASE("FBX says its unit and axes in its settings") {
    const MeshInterior y_up = interior(read(fbx(1, 1, 2, 1, 100)));
    CHECK(close_to(y_up.lower(), {0, 0, 0}));
    CHECK(close_to(y_up.upper(), {1, 2, 3}));
    const MeshInterior z_up = interior(read(fbx(2, 1, 1, -1, 1)));
    CHECK(close_to(z_up.lower(), {0, 0, -0.02}));
    CHECK(close_to(z_up.upper(), {0.01, 0.03, 0}));
    const MeshInterior given = interior(read(fbx(2, 1, 1, -1, 1), "x", 2, 'y'));
    CHECK(close_to(given.upper(), {2, 4, 6}));
}

TEST_CASE("What is no closed mesh of the four is refused in one line that says what was expected") {
    const auto refused = [](const std::string& content, const std::string& why) {
        CHECK_THROWS_WITH(read(content, "file"), Catch::StartsWith("file: ") && Catch::Contains(why) &&
                                                     Catch::Contains("expected") && !Catch::Contains("\n"));
        CHECK_THROWS_AS(read(content, "file"), InputError);
    };
    refused("", "is empty");
    refused(" \n\n", "is blank");
    refused("ply\nformat ascii 1.0\n", "is a PLY model");
    refused("solid cube\n", "is an STL model");
    refused("xof 0302txt 0064\n", "DirectX");
    refused("\xFF\xFEv\0", "UTF-16");
    refused("hello\n", "unknown format");
    refused("{\"format\": \"bough-splines\"}", "unknown format");
    refused("v 0 0 0\nv 1 0 0\nl 1 2\n", "has no faces");
    refused("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "finite");
    refused(std::string("glTF\2\0\0\0", 8), "is cut off within its header");
    refused("Kaydara FBX Binary  \0\x1a\0", "assimp could not read it");
    refused("<?xml version=\"1.0\"?><COLLADA><library_geo", "assimp could not read it");
    std::string torn = glb(solids::l_prism());
    CHECK_THROWS_WITH(read(torn.substr(0, torn.size() / 2), "file"), Catch::StartsWith("file: is cut off: a chunk of"));
}

TEST_CASE("Damaged files end in an error or a mesh, never in a crash of ours") {
    for (const std::string& whole : {glb(solids::unit_box()), fbx(1, 1, 2, 1, 1), dae(solids::unit_box(), "", "Y_UP"),
                                     solids::obj_text(solids::unit_box())})
        for (std::size_t i = 0; i < 40; ++i) {
            std::string damaged = whole;
            for (std::size_t k = 0; k < 3; ++k)
                damaged[(i * 7919 + k * 104729) % damaged.size()] ^= static_cast<char>(1 + i);
            try {
                const EnvelopeMesh m = read(damaged);
                for (const Vec3& p : m.vertex) CHECK(p.allFinite());
            } catch (const InputError& error) {
                CHECK(std::strchr(error.what(), '\n') == nullptr);
            }
        }
}

TEST_CASE("Other programs' models") {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (!folder) {
        WARN("BOUGH_CASES_DIR is not set: models of other programs are not tried");
        return;
    }
    const auto file = [&](const std::string& name) {
        const std::string path = std::string(folder) + "/" + name;
        ImportOptions options;
        options.name = path;
        ImportNotes notes;
        return read_envelope_mesh(read_input(path), path, options, notes);
    };
    CHECK(extent(file("models/cube_UTF8BOM.dae")).minCoeff() > 0);
    CHECK(file("models/global_settings.fbx").triangle.size() > 848); // quads among its faces
    CHECK(file("models/simple_skin.gltf").triangle.size() == 8);
    for (const char* name : {"models/box_UTF16BE.obj", "models/testline.obj", "invalid/empty.obj",
                             "invalid/malformed_skinweights_oob.x", "invalid/wrongTypes/badArray.gltf"})
        CHECK_THROWS_AS(file(name), InputError);
    CHECK(file("invalid/wrongTypes/badString.gltf").triangle.size() == 12); // a scene's name that nobody reads
}
