// Files of a hundred bytes that say that they hold a milliard of something: refused before memory is asked for, and at once. What was asked for is
// counted by replacing operator new; what C libraries take (images) is bounded by a child that may not have it.
#include "formats/documents/material.h"
#include "formats/documents/motion.h"
#include "formats/documents/scene.h"
#include "formats/documents/species.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "formats/forked.h"
#include "formats/imports/import.h"
#include "formats/imports/speedtree_mesh.h"
#include "formats/models/texture_file.h"
#include "formats/parameters/eztree.h"
#include "formats/parameters/growth_params.h"
#include "tests/support/random_documents.h"
#include "tests/support/sanitized.h"
#include <atomic>
#include <ctime>
#include <functional>
#include <malloc.h>

namespace {

std::atomic<std::int64_t> held{0}, most{0};

} // namespace

#ifndef BOUGH_SANITIZED
void* operator new(std::size_t bytes) {
    void* const p = std::malloc(bytes ? bytes : 1);
    if (!p) throw std::bad_alloc();
    held += std::int64_t(::malloc_usable_size(p));
    most = std::max<std::int64_t>(most, held);
    return p;
}
void* operator new[](std::size_t bytes) {
    return operator new(bytes);
}
void operator delete(void* p) noexcept {
    held -= std::int64_t(::malloc_usable_size(p));
    std::free(p);
}
void operator delete[](void* p) noexcept {
    operator delete(p);
}
void operator delete(void* p, std::size_t) noexcept {
    operator delete(p);
}
void operator delete[](void* p, std::size_t) noexcept {
    operator delete(p);
}
#endif

using namespace bough;
using namespace bough::test;

namespace {

struct Declared {
    std::string what, content;
    std::function<void(std::string_view)> read;
};

// The binary form: its header of this JSON, and `data` bytes behind.
std::string binary(const std::string& header, std::size_t data = 0) {
    std::string bytes;
    for (std::size_t k = 0, length = header.size(); k < 8; ++k, length >>= 8) bytes += char(length & 255);
    return bytes + header + std::string(data, '\0');
}

std::string binary_of(const std::string& format, const std::string& array, const std::string& dtype) {
    return binary("{\"__metadata__\":{\"format\":\"" + format + "\",\"version\":\"1\"},\"" + array +
                      "\":{\"dtype\":\"" + dtype + "\",\"shape\":[1000000000],\"data_offsets\":[0,4000000000]}}",
                  4);
}

void import(std::string_view content, const std::string& name) {
    ImportOptions options;
    options.name = name;
    ImportNotes notes;
    import_splines(content, options, notes);
}

std::function<void(std::string_view)> as(const std::string& name) {
    return [name](std::string_view content) { import(content, name); };
}

std::string gltf(const std::string& rest) {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" + rest + "}";
}

std::vector<Declared> declared() {
    const auto tree = [](std::string_view c) { read_tree(c, "f"); };
    const auto splines = [](std::string_view c) { read_splines(c, "f"); };
    const auto motion = [](std::string_view c) { read_motion(c, "f"); };
    const auto state = [](std::string_view c) { read_state(c, "f"); };
    const auto scene = [](std::string_view c) { read_scene_document(c, "f"); };
    const auto wind = [](std::string_view c) { read_wind(c, "f"); };
    const auto growth = [](std::string_view c) {
        ParameterNotes notes;
        read_growth_parameters(c, "f", notes);
    };
    const auto mesh = [](std::string_view c) {
        const speedtree::File file = speedtree::parse(c, "f");
        speedtree::parse_mesh(c, "f", file.bones, Eigen::Affine3d::Identity());
    };
    const std::string
        glb_views =
            R"("bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12,"uri":"data:,%00%00%00%00%00%00%00%00%00%00%00%00"}],)",
        lines = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":1}]}],)";
    const std::string xml = R"(<SpeedTreeRaw VersionMajor="1"><Objects Count="1"><Object ID="0" Name="a">)";
    return {
        {"tree", binary_of("bough-tree", "parent", "I32"), tree},
        {"tree, the header", binary("{").replace(0, 8, std::string("\0\xCA\x9A\x3B\0\0\0\0", 8)), tree},
        {"tree, JSON", R"({"format":"bough-tree","version":1,"parent":1000000000})", tree},
        {"splines", binary_of("bough-splines", "parent", "I32"), splines},
        {"splines, points",
         R"({"format":"bough-splines","version":1,"parent":[-1],"parent_at":[0],"first_point":[0,1000000000],"point":[0,0,0],"radius":[1]})",
         splines},
        {"motion, lines",
         "{\"format\":\"bough-motion\",\"version\":1,\"fps\":30,\"bodies\":1000000000,\"fields\":[\"pose\"]}\n{"
         "\"frame\":0,\"time\":0,\"position\":[],\"rotation\":[]}\n",
         motion},
        {"motion, binary",
         binary(
             R"({"__metadata__":{"format":"bough-motion","version":"1","fps":"30","bodies":"1000000000","fields":"[\"pose\"]"},"frame":{"dtype":"I64","shape":[1000000000],"data_offsets":[0,8000000000]}})"),
         motion},
        {"state", binary_of("bough-state", "theta", "F64"), state},
        {"scene, a curve of a root",
         R"({"format":"bough-scene","version":1,"trees":[{"file":"a","root_motion":{"time":1000000000}}]})", scene},
        {"scene, a grid of wind",
         R"({"format":"bough-scene","version":1,"wind":{"velocity":[1,0,0],"grid":{"size":[1000,1000,1000],"velocity":[1,0,0]}}})",
         scene},
        {"wind", R"({"format":"bough-wind","version":1,"velocity":[1,0,0],"octaves":1000000000})", wind},
        {"species", R"({"format":"bough-species","version":1,"levels":1000000000})",
         [](std::string_view c) { read_species(c, "f"); }},
        {"material", R"({"format":"bough-material","version":1,"bodies":1000000000})",
         [](std::string_view c) { read_material(c, "f"); }},
        {"Arbaro",
         R"(<?xml version='1.0' ?><arbaro><species name='a'><param name='Levels' value='1000000000'/></species></arbaro>)",
         growth},
        {"tree-gen", R"({'shape': 0, 'levels': 1000000000})", growth},
        {"Sapling", R"({'levels': 1000000000, 'bevel': False})", growth},
        {"ez-tree", R"({"seed":1,"branch":{"levels":1000000000},"leaves":{"count":1000000000}})",
         [](std::string_view c) {
             std::vector<std::string> notes;
             read_eztree(c, "f", notes);
         }},
        {"SpeedTree, spine",
         xml + R"(<Spine Count="1000000000"><X>0</X><Y>0</Y><Z>0</Z></Spine></Object></Objects></SpeedTreeRaw>)",
         as("f.xml")},
        {"SpeedTree, mesh",
         xml +
             R"(<Points Count="1000000000"><X>0</X><Y>0</Y><Z>0</Z></Points><Triangles Count="1"><PointIndices>0 0 1000000000</PointIndices></Triangles></Object></Objects></SpeedTreeRaw>)",
         mesh},
        {"PLY, text",
         "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty float "
         "z\nend_header\n0 0 0\n",
         as("f.ply")},
        {"PLY, binary",
         "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty float x\nproperty float "
         "y\nproperty float z\nend_header\n0123",
         as("f.ply")},
        {"PLY, a list",
         std::string("ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint float "
                     "x\nend_header\n\0\xCA\x9A\x3B",
                     94),
         as("f.ply")},
        {"SWC", "1000000000 3 0 0 0 1 1000000000\n", as("f.swc")},
        {"MTG",
         "CODE:\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$"
         "\t0\tFREE\tFREE\tIMPLICIT\nP\t1000000000\tFREE\tFREE\tEXPLICIT\n",
         as("f.mtg")},
        {"treetools", "x,y,z,radius,parent_id\n0,0,0,1,1000000000\n", as("f.txt")},
        {"cylinders",
         "radius (m),length (m),start_x,start_y,start_z,axis_x,axis_y,axis_z,parent\n1,1,0,0,0,0,0,1,1000000000\n",
         as("f.txt")},
        {"curves, a table", "spline,point,x,y,z,radius\n1000000000,1000000000,0,0,0,1\n", as("f.csv")},
        {"curves, JSON", R"({"splines":[{"points":[[0,0,0]],"radii":[1],"order_u":1000000000}]})", as("f.json")},
        {"ez-tree's branches",
         R"([{"origin":[0,0,0],"orientation":[0,0,0],"length":1,"radius":1,"level":1,"parent":1000000000,"sectionCount":1000000000}])",
         as("f.json")},
        {"OBJ, a line", "v 0 0 0\nl 1 1000000000\n", as("f.obj")},
        {"OBJ, a curve", "v 0 0 0\nv 0 1 0\ncstype bspline\ndeg 1000000000\ncurv 0 1 1 2\nparm u 0 1\nend\n",
         as("f.obj")},
        {"glTF, elements",
         gltf(glb_views + lines +
              R"("accessors":[{"bufferView":0,"componentType":5126,"count":1000000000,"type":"VEC3"}])"),
         as("f.gltf")},
        {"glTF, zeros", gltf(lines + R"("accessors":[{"componentType":5126,"count":1000000000,"type":"VEC3"}])"),
         as("f.gltf")},
        {"glTF, a buffer", gltf(lines + R"("buffers":[{"byteLength":1000000000,"uri":"data:,a"}])"), as("f.gltf")},
        {"glTF, a chunk", std::string("glTF\2\0\0\0\0\xCA\x9A\x3B\0\xCA\x9A\x3BJSON{}", 22), as("f.glb")},
    };
}

std::string little(std::uint32_t value, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k, value >>= 8) text += char(value & 255);
    return text;
}

// Images of 16 000 x 16 000 pixels, 1 GB, by their heads.
std::vector<std::pair<std::string, std::string>> images() {
    const std::uint32_t side = 16000;
    const auto big = [](std::uint32_t value) {
        const std::string l = little(value, 4);
        return std::string(l.rbegin(), l.rend());
    };
    const auto entry = [](std::uint32_t tag, std::uint32_t value) {
        return little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
    };
    std::string tiff = "II" + little(42, 2) + little(8, 4) + little(8, 2);
    for (const auto& [tag, value] : {std::pair(256u, side),
                                     {257u, side},
                                     {258u, 8u},
                                     {259u, 1u},
                                     {262u, 1u},
                                     {273u, 110u},
                                     {278u, side},
                                     {279u, 1u}})
        tiff += entry(tag, value);
    return {{"TGA",
             std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + little(side, 2) + little(side, 2) + little(32, 2) + "abcd"},
            {"TGA, packed",
             std::string("\0\0\12\0\0\0\0\0\0\0\0\0", 12) + little(side, 2) + little(side, 2) + little(32, 2) + "abcd"},
            {"BMP", "BM" + little(58, 4) + little(0, 4) + little(54, 4) + little(40, 4) + little(side, 4) +
                        little(side, 4) + little(1, 2) + little(24, 2) + std::string(24, '\0') + "abcd"},
            {"PNG", "\x89PNG\r\n\x1A\n" + big(13) + "IHDR" + big(side) + big(side) + std::string("\10\6\0\0\0", 5) +
                        big(0) + big(4) + "IDATabcd" + big(0) + big(0) + "IEND" + big(0)},
            {"TIFF", tiff + little(0, 4) + "abcd"}};
}

} // namespace

TEST_CASE("a file that declares a milliard is refused at once and nothing is allocated for it") {
    for (const Declared& file : declared()) {
        INFO(file.what);
        CHECK(file.content.size() < 400);
        held = most = 0;
        const std::string error = error_of([&] { file.read(file.content); });
        INFO(error);
        CHECK(!error.empty());
        if (!sanitized) CHECK(most < 200000); // a message, JSON's values, a block of numbers on their way
    }
}

// A clock decides it, so it is run by hand: test_formats_declared '[.time]'.
TEST_CASE("a file that declares a milliard takes a tenth of a second at most", "[.time]") {
    for (const Declared& file : declared()) {
        INFO(file.what);
        const std::clock_t start = std::clock();
        error_of([&] { file.read(file.content); });
        CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 0.1);
    }
}

TEST_CASE("values nested a hundred thousand deep are refused or left alone, with the stack that a thread has") {
    const auto in = [](const std::string& before, const std::string& open, const std::string& inside,
                       const std::string& close, const std::string& after) {
        std::string text = before;
        const int depth = 100000;
        for (int k = 0; k < depth; ++k) text += open;
        text += inside;
        for (int k = 0; k < depth; ++k) text += close;
        return text + after;
    };
    const auto json = [&](const std::string& before, const std::string& after) {
        return std::vector<std::string>{in(before, "[", "", "]", after), in(before, "{\"a\":", "0", "}", after)};
    };
    const std::vector<Declared> readers = declared();
    const auto reader = [&](const std::string& what) {
        for (const Declared& file : readers)
            if (file.what == what) return file.read;
        FAIL(what);
        return readers[0].read;
    };
    for (const auto& [what, before, after] : std::vector<std::tuple<std::string, std::string, std::string>>{
             {"tree", R"({"format":"bough-tree","version":1,"mass":)", "}"},
             {"tree", R"({"format":"bough-tree","version":1,"unknown":)", "}"},
             {"splines", R"({"format":"bough-splines","version":1,"name":)", "}"},
             {"motion, lines", R"({"format":"bough-motion","version":1,"fields":)", "}"},
             {"state", R"({"format":"bough-state","version":1,"theta":)", "}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"wind":)", "}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"unknown":)", "}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"name":)", "}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"trees":)", "}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"trees":[{"file":)", "}]}"},
             {"scene, a grid of wind", R"({"format":"bough-scene","version":1,"gravity":)", "}"},
             {"wind", R"({"format":"bough-wind","version":1,"velocity":)", "}"},
             {"species", R"({"format":"bough-species","version":1,"levels":)", "}"},
             {"material", R"({"format":"bough-material","version":1,"density":)", "}"},
             {"tree-gen", R"({"shape":)", "}"},
             {"ez-tree", R"({"seed":1,"branch":{"levels":)", R"(},"leaves":{}})"},
             {"curves, JSON", R"({"splines":[{"points":)", "}]}"},
             {"ez-tree's branches", R"([{"origin":)", R"(,"orientation":[0,0,0],"length":1,"radius":1}])"},
             {"glTF, zeros", R"({"asset":{"version":"2.0"},"nodes":)", "}"}})
        for (const std::string& content : json(before, after)) {
            INFO(what << ": " << content.substr(0, 80));
            const std::string error = error_of([&, named = what] { reader(named)(content); });
            CHECK(error.size() < 1000);
        }
    for (const std::string what : {"SpeedTree, spine", "SpeedTree, mesh", "Arbaro"}) {
        INFO(what);
        const std::string root = what == "Arbaro" ? "arbaro" : "SpeedTreeRaw VersionMajor=\"1\"";
        const std::string content =
            in("<" + root + ">", "<Objects>", "", "</Objects>", "</" + root.substr(0, root.find(' ')) + ">");
        CHECK(error_of([&] { reader(what)(content); }).size() < 1000);
    }
}

TEST_CASE("an image that says that it is larger than its bytes can hold is refused, with 100 MB to read it in") {
    if (sanitized) return; // without limits of memory
    const Folder folder;
    for (const auto& [what, content] : images()) {
        INFO(what);
        const std::string path = folder / "image";
        {
            Output output(path);
            output.write(content);
            output.finish();
        }
        ChildLimits limits;
        limits.bytes = std::size_t(100) << 20;
        const ChildResult result = run_forked([&] { return error_of([&] { read_texture(path, "a test"); }); }, limits);
        CHECK(result.failure == "");
        CHECK(result.bytes.find("says that it is 16000 x 16000 pixels, more than its") != std::string::npos);
    }
}
