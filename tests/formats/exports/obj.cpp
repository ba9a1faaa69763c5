#include "formats/exports/obj.h"
#include "tests/support/make_tree.h"
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <catch2/catch.hpp>
#include <clocale>
#include <filesystem>
#include <map>
#include <sstream>
#include <unistd.h>

using namespace bough;

namespace {

struct ObjFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("bough_test_obj_" + std::to_string(getpid()));
    ObjFolder() { std::filesystem::create_directories(path); }
    ~ObjFolder() { std::filesystem::remove_all(path); }
    std::string file(const std::string& name) const { return (path / name).string(); }
};

void write(const ObjFolder& folder, const Skin& skin) {
    Output obj(folder.file("tree.obj"));
    write_obj(obj, skin, skin.position, skin.normal, "tree.mtl");
    obj.finish();
    Output mtl(folder.file("tree.mtl"));
    write_mtl(mtl, skin);
    mtl.finish();
}

// A second reading of the mesh: by assimp, part by part. assimp makes a vertex of each face corner.
void compare(const aiScene& scene, const Skin& skin, double largest) {
    REQUIRE(scene.mNumMeshes == skin.part.size());
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        const SkinPart& part = skin.part[m];
        aiString material;
        REQUIRE(scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, material) == AI_SUCCESS);
        CHECK(material.C_Str() == part.name);
        CHECK(std::string(mesh.mName.C_Str()) == part.name);
        REQUIRE(mesh.mNumFaces == part.index_count);
        REQUIRE(mesh.HasNormals());
        REQUIRE(mesh.HasTextureCoords(0));
        double off = 0, off_normal = 0, off_texture = 0;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            REQUIRE(mesh.mFaces[f].mNumIndices == 3);
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned got = mesh.mFaces[f].mIndices[k];
                const std::size_t want = std::size_t(skin.triangle[part.first_index + f][k]);
                const aiVector3D &p = mesh.mVertices[got], &n = mesh.mNormals[got], &t = mesh.mTextureCoords[0][got];
                off = std::max(off, (Vec3(double(p.x), double(p.y), double(p.z)) - skin.position[want]).norm());
                off_normal =
                    std::max(off_normal, (Vec3(double(n.x), double(n.y), double(n.z)) - skin.normal[want]).norm());
                off_texture =
                    std::max(off_texture, double(std::hypot(t.x - skin.texture[want][0], t.y - skin.texture[want][1])));
            }
        }
        CHECK(off < 1e-6 * largest);
        CHECK(off_normal < 1e-4);
        CHECK(off_texture < 1e-5);
    }
}

} // namespace

TEST_CASE("assimp reads back the mesh, its texture and its materials") {
    const ObjFolder folder;
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(2000, 1), make_tree::chain(1, 1e-3, 1e-4, 0),
                             make_tree::chain(3, 1e5, 1e3, 10)}) {
        const Skin skin = build_skin(tree, {});
        write(folder, skin);
        double largest = 0;
        for (const Vec3& p : skin.position) largest = std::max(largest, p.norm());
        Assimp::Importer importer;
        const aiScene* scene = importer.ReadFile(folder.file("tree.obj"), 0);
        REQUIRE(scene);
        compare(*scene, skin, largest);
    }
}

TEST_CASE("colours reach assimp and differ between bark, leaf and fruit") {
    const ObjFolder folder;
    write(folder, build_skin(make_tree::branched(), {}));
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(folder.file("tree.obj"), 0);
    REQUIRE(scene);
    std::map<std::string, aiColor3D> color;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMaterial& material = *scene->mMaterials[scene->mMeshes[m]->mMaterialIndex];
        aiString name;
        REQUIRE(material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS);
        REQUIRE(material.Get(AI_MATKEY_COLOR_DIFFUSE, color[name.C_Str()]) == AI_SUCCESS);
    }
    REQUIRE(color.size() == 3);
    CHECK(color["leaf"].g > color["leaf"].r);
    CHECK(color["fruit"].r > 2 * color["fruit"].g);
    CHECK(color["bark"] != aiColor3D(0.6f, 0.6f, 0.6f)); // assimp's own default
}

TEST_CASE("coordinates far from the origin keep the mesh's own precision") {
    const ObjFolder folder;
    Tree tree = make_tree::branched();
    tree.joint_position[0] = {500000.25, 254.5, -4200000.125}; // metres of a national grid
    const Skin skin = build_skin(tree, {});
    write(folder, skin);
    const std::string text = read_input(folder.file("tree.obj"));
    std::size_t line = 0, at = text.find("\nv ") + 1;
    double off = 0;
    for (; text.compare(at, 2, "v ") == 0; at = text.find('\n', at) + 1, ++line) {
        const char* s = text.c_str() + at + 2;
        for (int k = 0; k < 3; ++k) {
            char* end = nullptr;
            off = std::max(off, std::abs(std::strtod(s, &end) - skin.position[line][k]));
            s = end;
        }
    }
    CHECK(line == skin.position.size());
    CHECK(off < 1e-9);
}

TEST_CASE("numbers are written alike in every locale") {
    const ObjFolder folder;
    const Skin skin = build_skin(make_tree::branched(), {});
    write(folder, skin);
    const std::string before = read_input(folder.file("tree.obj"));
    const char* set = nullptr;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
        if (!set) set = std::setlocale(LC_ALL, name);
    if (!set) WARN("no locale with a decimal comma is installed: only the comma's absence is checked");
    write(folder, skin);
    std::setlocale(LC_ALL, "C");
    CHECK(read_input(folder.file("tree.obj")) == before);
    CHECK(before.find(',') == std::string::npos);
}

TEST_CASE("an empty skin is a valid file") {
    const ObjFolder folder;
    write(folder, Skin());
    CHECK(read_input(folder.file("tree.obj")) == "mtllib tree.mtl\n");
    CHECK(read_input(folder.file("tree.mtl")).empty());
}

TEST_CASE("names of a sequence") {
    CHECK(sequence_name("frames/oak_%04d.obj", 7) == "frames/oak_0007.obj");
    CHECK(sequence_name("frames/oak_%04d.obj", 123456) == "frames/oak_123456.obj");
    CHECK(sequence_name("oak%d.obj", 12) == "oak12.obj");
    CHECK(sequence_name("a.b/oak_%02d", 3) == "a.b/oak_03");
    CHECK(sequence_mtl("frames/oak_%04d.obj") == "frames/oak.mtl");
    CHECK(sequence_mtl("oak%d.obj") == "oak.mtl");
    CHECK(sequence_mtl("frames/_%d.obj") == "frames/_.mtl");
    CHECK(sequence_mtl("./x-y.%03d.obj") == "./x-y.mtl");
}

// Blender's add-on Stop-motion-OBJ takes all PREFIX*.obj of a folder in the order of their names, digits as numbers, as one
// mesh a file without splitting it by objects, and keeps the first one's materials.
TEST_CASE("an add-on that plays sequences finds the frames in their order, and one mesh in all") {
    const auto key = [](const std::string& name) { // its alphanumKey: split at runs of digits, those as numbers
        std::vector<std::pair<long, std::string>> parts(1);
        bool digits = false;
        for (const char c : name) {
            const bool digit = c >= '0' && c <= '9';
            if (digit != digits) parts.push_back({-1, ""});
            digits = digit;
            parts.back().second += c;
            if (digit) parts.back() = {std::stol(parts.back().second), parts.back().second};
        }
        for (auto& part : parts)
            if (part.first >= 0) part.second.clear();
        return parts;
    };
    for (const char* pattern : {"f/oak_%04d.obj", "f/oak%d.obj", "f2/oak.%02d.obj"})
        for (const std::int64_t f : {0, 8, 9, 98, 99, 999, 9999})
            CHECK(key(sequence_name(pattern, f)) < key(sequence_name(pattern, f + 1)));

    const ObjFolder folder;
    const Tree tree = make_tree::branched();
    const Skin skin = build_skin(tree, {});
    std::vector<Vec3> moved = skin.position;
    for (Vec3& p : moved) p += 0.01 * p.y() * p.y() * Vec3(1, 0, 0);
    std::vector<std::string> rest;
    for (const std::vector<Vec3>* position : {&skin.position, &std::as_const(moved)}) {
        Output obj(folder.file("frame.obj"));
        write_obj(obj, skin, *position, skin.normal, "oak.mtl");
        obj.finish();
        std::istringstream lines(read_input(folder.file("frame.obj")));
        std::string others;
        std::size_t vertices = 0;
        for (std::string line; std::getline(lines, line);)
            if (line.compare(0, 2, "v ") == 0)
                ++vertices;
            else
                others += line + "\n";
        CHECK(vertices == skin.position.size());
        rest.push_back(others);
    }
    CHECK(rest[0] == rest[1]); // faces, texture, materials and their file: all but the places (and here the normals)
    CHECK(rest[0].find("\no ") == std::string::npos); // objects would be meshes of their own
    CHECK(rest[0].compare(0, 15, "mtllib oak.mtl\n") == 0);
}

TEST_CASE("patterns that are none are refused with what is wrong") {
    for (const char* good : {"a%d.obj", "a_%04d.obj", "/tmp/a/b_%018d.obj", "a%01dz"})
        CHECK(valid_sequence(good).empty());
    const std::map<std::string, std::string> bad = {
        {"", "no %d"},
        {"oak.obj", "no %d"},
        {"%04d.obj", "before the number"},
        {"frames/%d.obj", "before the number"},
        {"f%d/oak.obj", "folder"},
        {"f%d/oak_%d.obj", "folder"},
        {"oak_%d_%d.obj", "more than one"},
        {"oak_%d%.obj", "more than one"},
        {"oak_%4d.obj", "not %d"},
        {"oak_%s.obj", "not %d"},
        {"oak_%", "not %d"},
        {"oak_%04", "not %d"},
        {"oak_%04x.obj", "not %d"},
        {"oak_%%d.obj", "not %d"},
        {"oak_%0d.obj", "width"},
        {"oak_%00d.obj", "width"},
        {"oak_%0-3d.obj", "width"},
        {"oak_%099999999999999d.obj", "width"},
    };
    for (const auto& [pattern, what] : bad) {
        INFO(pattern << ": " << valid_sequence(pattern));
        CHECK(valid_sequence(pattern).find(what) != std::string::npos);
    }
}
