// What reading glTF may take: memory that runs out, or is not taken; time.
#include "formats/forked.h"
#include "formats/models/gltf_document.h"
#include "formats/models/model_scene.h"
#include "formats/models/texture_file.h"
#include "tests/support/import_support.h"
#include "tests/support/random_documents.h"
#include "tests/support/sanitized.h"
#include <ctime>
#include <filesystem>

using namespace bough;
using namespace bough::test;
using Json = nlohmann::ordered_json;

namespace {

ModelScene limited_scene(const std::string& content) {
    ImportOptions options;
    options.name = "s.gltf";
    return read_model(content, AssimpKind::gltf, options);
}

} // namespace

TEST_CASE("memory that runs out while what was read is taken over is told of in one line") {
    if (sanitized) return; // keeps no limits
    // Some 130 bytes for each of these nodes, more than what lies free here.
    std::string nodes = R"({"asset": {"version": "2.0"}, "nodes": [{})";
    for (int k = 1; k < 100000; ++k) nodes += ",{}";
    nodes += "]}";
    CHECK(limited_scene(nodes).parent.size() == 100000);
    ChildLimits little;
    little.bytes = std::size_t(1) << 20;
    const auto read = [&]() -> std::string {
        limited_scene(nodes);
        return "read";
    };
    CHECK_THAT(run_forked(read, little).failure,
               Catch::StartsWith("s.gltf: ") && Catch::Contains("needs more memory than"));
}

// Json's destructor takes memory of its own: without it a program would end there, by abort().
TEST_CASE("however little memory there is for a glTF file, its reader does not crash") {
    if (sanitized) return;
    std::string joints_text = "0";
    for (int k = 1; k < 1000000; ++k) joints_text += ",0";
    const std::string content =
        R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": []}], "skins": [{"joints": [)" +
        joints_text + "]}]}";
    for (std::size_t megabytes = 2; megabytes < 300; megabytes += megabytes / 2) {
        ChildLimits limits;
        limits.bytes = megabytes << 20;
        const ChildResult result = run_forked(
            [&]() -> std::string {
                limited_scene(content);
                return "read";
            },
            limits);
        CAPTURE(megabytes, result.failure);
        CHECK_THAT(result.failure, !Catch::Contains("crashed"));
        if (megabytes < 100) CHECK_THAT(result.failure, Catch::Contains("needs more memory than"));
    }
}

// Twenty million points in 300 kB: one array of 10 000 points that 2 000 lines name, or 2 000 nodes whose mesh it is.
TEST_CASE("arrays that are named over and over are refused before they take memory") {
    const auto refused = [](int primitives, int nodes) {
        Json json = Json::parse(
            R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "nodes": [], "meshes": [{"primitives": []}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 10000, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 120000}]})");
        json["buffers"] = Json::array({{{"byteLength", 120000}, {"uri", "data:," + std::string(120000, '0')}}});
        for (int k = 0; k < primitives; ++k)
            json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 3}});
        for (int k = 0; k < nodes; ++k) json["nodes"].push_back({{"mesh", 0}}), json["scenes"][0]["nodes"].push_back(k);
        ImportOptions options;
        options.name = "many.gltf";
        try {
            scene_of_gltf(json.dump(), options);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refused(2000, 1).find("named over and over") != std::string::npos);
    if (!sanitized) CHECK(refused(1, 2000).find("named over and over") != std::string::npos);
    const int some = sanitized ? 2 : 20;
    CHECK(refused(some, 1).empty());
    CHECK(refused(1, some).empty());
}

// A clock decides it, so it is run by hand: test_formats_models '[.time]'.
TEST_CASE("reading many nodes takes time in proportion to their number", "[.time]") {
    const auto seconds = [](int nodes) {
        Json json = Json::parse(R"({"asset": {"version": "2.0"}, "nodes": []})");
        for (int k = 0; k < nodes; ++k) json["nodes"].push_back({{"translation", {0, 1, 0}}});
        const std::string text = json.dump();
        ImportNotes notes;
        const std::clock_t start = std::clock();
        read_gltf(text, "nodes.gltf", "", GltfImages::leave, notes);
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    CHECK(seconds(160000) < 12 * seconds(40000)); // 16 and more where it goes with the square
}

TEST_CASE("an image whose name leads out is white, and is named in no output") {
    const Folder folder;
    std::filesystem::create_directory(folder.path / "in");
    put(folder / "out.png", "\x89PNG\r\n\x1a\n" + std::string(3000, 'x'));
    std::filesystem::create_symlink("../out.png", folder.path / "in" / "link.png");
    for (const char* uri : {"http://127.0.0.1:1/a.png", "file:///etc/passwd", "/etc/passwd", "../out.png",
                            "%2e%2e/out.png", "link.png", "C:/a.png", "..\\out.png", "\\\\host\\a.png", "HTTP:a.png"}) {
        CAPTURE(uri);
        const Json json{{"asset", {{"version", "2.0"}}}, {"images", {{{"uri", uri}}}}};
        ImportNotes notes;
        const GltfDocument read =
            read_gltf(json.dump(), "m.gltf", (folder.path / "in").string(), GltfImages::embed, notes);
        CHECK(read.json["images"][0].size() == 2);
        CHECK(read.json["images"][0]["mimeType"] == "image/png");
        CHECK(read.binary.size() < 80);
        put(folder / "white.png", read.binary.substr(0, read.json["bufferViews"][0]["byteLength"]));
        const Pixels pixels = read_texture(folder / "white.png", "the test").pixels;
        CHECK((pixels.width == 1 && pixels.height == 1));
        CHECK(pixels.rgba == std::vector<std::uint8_t>(4, 255));
        REQUIRE(notes.lines.size() == 1);
        CHECK(notes.lines[0].find("is white") != std::string::npos);
    }
    // One that is not there may come to stand beside the output; a colon is a letter like others.
    for (const char* uri : {"gone.png", "b:1.png", "b%3A1.png"}) {
        const Json json{{"asset", {{"version", "2.0"}}}, {"images", {{{"uri", uri}}}}};
        ImportNotes notes;
        CHECK(read_gltf(json.dump(), "m.gltf", (folder.path / "in").string(), GltfImages::embed, notes)
                  .json["images"][0]["uri"] == uri);
    }
    // One that is there stays itself, however a refused one is spelt.
    put((folder.path / "in" / "b.png").string(), "\x89PNG\r\n\x1a\n" + std::string(3000, 'y'));
    const Json json{{"asset", {{"version", "2.0"}}}, {"images", {{{"uri", "C:/b.png"}}, {{"uri", "b.png"}}}}};
    ImportNotes notes;
    const GltfDocument read = read_gltf(json.dump(), "m.gltf", (folder.path / "in").string(), GltfImages::embed, notes);
    CHECK(read.json["images"][0]["bufferView"] != read.json["images"][1]["bufferView"]);
    CHECK(read.binary.size() > 3000);
}

TEST_CASE("buffers and images of one file are held once, however it is spelt") {
    const Folder folder;
    const std::string image = "\x89PNG\r\n\x1a\n" + std::string(3000, 'x');
    put(folder / "a.png", image);
    put(folder / "b.bin", std::string(5000, 'b'));
    Json json{{"asset", {{"version", "2.0"}}}, {"buffers", Json::array()}, {"images", Json::array()}};
    for (const char* spelt : {"", "./", "././"})
        for (int k = 0; k < 5; ++k) {
            json["images"].push_back({{"uri", std::string(spelt) + "a.png"}});
            json["buffers"].push_back({{"uri", std::string(spelt) + "b.bin"}, {"byteLength", 5000}});
        }
    ImportNotes notes;
    const GltfDocument read = read_gltf(json.dump(), "m.gltf", folder.path.string(), GltfImages::embed, notes);
    CHECK(read.binary.size() < 3000 + 5000 + 200);
    CHECK(read.binary.find(image) != std::string::npos);
    REQUIRE(read.json["images"].size() == 15);
    for (const Json& each : read.json["images"]) CHECK(each["bufferView"] == read.json["images"][0]["bufferView"]);
}
