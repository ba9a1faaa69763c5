#include "formats/models/assimp_mends.h"
#include <catch2/catch.hpp>

using namespace bough;
using Json = nlohmann::ordered_json;

namespace {

// Two images in one buffer, as their first bytes say, and as `type` calls them.
GltfDocument with_images(const std::string& type) {
    const std::string png = "\x89PNG\r\n\x1a\n----", jpeg = "\xFF\xD8\xFF\xE0----";
    GltfDocument document;
    document.binary = png + jpeg + "no image";
    document.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", png.size()}}, // from 0, which need not be said
                                    {{"buffer", 0}, {"byteOffset", png.size()}, {"byteLength", jpeg.size()}},
                                    {{"buffer", 0}, {"byteOffset", png.size() + jpeg.size()}, {"byteLength", 8}}};
    document.json["images"] = {{{"bufferView", 0}, {"mimeType", type}},
                               {{"bufferView", 1}, {"mimeType", type}},
                               {{"bufferView", 2}, {"mimeType", type}},
                               {{"uri", "bark.png"}}};
    return document;
}

// A mesh of one triangle with a morph target of so many vertices.
Json mesh(std::size_t target) {
    return {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"targets", {{{"POSITION", target}}}}}}},
            {"weights", {0.5}},
            {"extras", {{"targetNames", {"wide"}}}}};
}

} // namespace

TEST_CASE("an embedded image has the type of its bytes") {
    GltfDocument document = with_images("image/fbm");
    ImportNotes notes;
    mend_assimp(document, notes);
    const Json& image = document.json["images"];
    CHECK(image[0]["mimeType"] == "image/png");
    CHECK(image[1]["mimeType"] == "image/jpeg");
    CHECK(image[2]["mimeType"] == "image/fbm"); // nothing is known of it
    CHECK_FALSE(image[3].contains("mimeType")); // a file's name: its reader sees for itself
    CHECK(notes.lines.empty());
}

TEST_CASE("morph targets of other vertices than their mesh has are left out, with a note") {
    GltfDocument document;
    document.json["accessors"] = {{{"count", 3}}, {{"count", 3}}, {{"count", 2}}};
    document.json["meshes"] = {mesh(1), mesh(2), {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
    const Json before = document.json["meshes"];
    ImportNotes notes;
    mend_assimp(document, notes);
    const Json& meshes = document.json["meshes"];
    CHECK(meshes[0] == before[0]);
    CHECK(meshes[2] == before[2]);
    CHECK_FALSE(meshes[1]["primitives"][0].contains("targets"));
    CHECK_FALSE(meshes[1].contains("weights")); // which would be of targets that are not there
    CHECK_FALSE(meshes[1].contains("extras"));  // their names
    CHECK(meshes[1]["primitives"][0]["attributes"]["POSITION"] == 0);
    REQUIRE(notes.lines.size() == 1);
    CHECK(notes.lines[0].starts_with("1 mesh comes without shape keys: "));
}
