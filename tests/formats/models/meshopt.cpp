// meshopt.h: views against what another decoder (meshoptimizer 1.3, from npm) makes of them, a tree whose mesh gltfpack
// quantized and compressed against the plain file, and what is refused.
#include "formats/models/meshopt.h"
#include "formats/models/envelope_mesh.h"
#include "tests/support/import_support.h"
#include "tests/support/solids.h"
#include <functional>

using namespace bough;
using namespace bough::test;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* extension = "EXT_meshopt_compression";

GltfDocument document_of(const std::string& content) {
    ImportNotes none;
    return read_gltf(content, "m.gltf", "", GltfImages::leave, none);
}

std::string_view bytes_of(const GltfDocument& document, const Json& view) {
    return std::string_view(document.binary)
        .substr(view.value("byteOffset", std::size_t(0)), view["byteLength"].get<std::size_t>());
}

void decoder_refuses(const std::function<void(Json&)>& change, const std::string& text) {
    GltfDocument document = document_of(fixture("meshopt_views.gltf"));
    change(document.json["bufferViews"][1]);
    std::string error;
    try {
        decode_meshopt(document);
    } catch (const std::out_of_range& e) {
        error = e.what();
    }
    INFO("expected: " << text);
    CHECK(error == "view 1" + text);
}

Json& packed(Json& view) {
    return view["extensions"][extension];
}

} // namespace

TEST_CASE("compressed views hold what another decoder makes of them") {
    const GltfDocument whole = document_of(fixture("meshopt_views.gltf"));
    GltfDocument plain = whole;
    decode_meshopt(plain);
    REQUIRE(whole.json["bufferViews"].size() == 9); // each mode and filter, elements of each size
    for (std::size_t v = 0; v < whole.json["bufferViews"].size(); ++v) {
        const Json& before = whole.json["bufferViews"][v]; // names the fallback: the other decoder's bytes
        const Json& after = plain.json["bufferViews"][v];
        INFO(v << ": " << before.dump());
        CHECK_FALSE(after["extensions"].contains(extension));
        CHECK(before["byteOffset"] != after["byteOffset"]);
        CHECK(bytes_of(whole, before) == bytes_of(plain, after));
    }
}

TEST_CASE("a tree whose mesh is quantized and compressed is that of the plain file") {
    ImportOptions beside;
    beside.folder = std::string(BOUGH_DATA_DIR) + "/fixtures";
    const Imported plain = imported(fixture("twig_armature.gltf"), "plain.gltf", beside),
                   small = imported(fixture("twig_meshopt.glb"), "small.glb");
    const Splines &a = plain.splines, &b = small.splines;
    CHECK(a.parent == b.parent);
    REQUIRE(a.first_point == b.first_point);
    constexpr double step = 2.0 / (1 << 14); // [m] of the positions: 14 bits over the height
    for (std::size_t k = 0; k < a.points(); ++k) {
        CHECK((a.point[k] - b.point[k]).norm() < step);
        CHECK(std::abs(a.radius[k] - b.radius[k]) < step);
    }
    CHECK(small.notes_hold("radii of 4 of 4 bones measured"));
}

TEST_CASE("an envelope may be quantized and compressed") {
    ImportOptions options;
    options.name = "small.glb";
    ImportNotes notes;
    const EnvelopeMesh mesh = read_envelope_mesh(fixture("twig_meshopt.glb"), "small.glb", options, notes);
    REQUIRE(mesh.triangle.size() == 32);
    Vec3 low = mesh.vertex[0], high = low;
    for (const Vec3& p : mesh.vertex) low = low.cwiseMin(p), high = high.cwiseMax(p);
    CHECK((low - Vec3(-0.1, 0, -0.1)).norm() < 1e-4); // the mesh's node takes the quantization back
    CHECK((high - Vec3(0.7, 2, 0.1)).norm() < 2e-4);
}

TEST_CASE("a view that is not what its extension says is refused") {
    const std::string of = " (EXT_meshopt_compression)";
    decoder_refuses([](Json& v) { packed(v)["mode"] = "POINTS"; },
                    of + ": mode is \"POINTS\", expected ATTRIBUTES, TRIANGLES or INDICES");
    decoder_refuses([](Json& v) { packed(v)["filter"] = "COLOR"; },
                    of + ": filter is \"COLOR\", expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
    decoder_refuses([](Json& v) { packed(v)["filter"] = "QUATERNION"; },
                    of + ": byteStride is 4, which QUATERNION does not allow");
    decoder_refuses([](Json& v) { packed(v)["byteStride"] = 6; },
                    of + ": byteStride is 6, which ATTRIBUTES does not allow");
    decoder_refuses([](Json& v) { packed(v)["byteStride"] = 0; },
                    of + ": byteStride is 0, which ATTRIBUTES does not allow");
    decoder_refuses([](Json& v) { packed(v)["mode"] = "TRIANGLES"; }, of + ": count is 40, expected three a triangle");
    decoder_refuses([](Json& v) { packed(v)["count"] = 41; },
                    of + " has 41 elements of 4 bytes, but its view 160 bytes");
    decoder_refuses(
        [](Json& v) { packed(v)["count"] = 4611686018427387944u; }, // 2^62 more: so many bytes are 160 again
        of + " has 4611686018427387944 elements of 4 bytes, but its view 160 bytes");
    decoder_refuses(
        [](Json& v) { packed(v)["byteLength"] = 9; },
        of + ": 9 bytes are no array of 40 elements compressed as ATTRIBUTES; the file is damaged or of a newer "
             "version");
    decoder_refuses([](Json& v) { packed(v)["count"] = 250000000, v["byteLength"] = 1000000000; },
                    of + ": 148 bytes cannot hold 1000000000");
    decoder_refuses([](Json& v) { packed(v)["byteLength"] = 1.5; },
                    of + ": byteLength is 1.5, expected a whole number");
    decoder_refuses(
        [](Json& v) { v["extensions"]["KHR_meshopt_compression"] = packed(v); },
        " is compressed by KHR_meshopt_compression, which is not read here; expected EXT_meshopt_compression "
        "(gltfpack -ce ext)");
}

TEST_CASE("damaged bytes of a compressed view are refused or read, within their size") {
    const GltfDocument whole = document_of(fixture("meshopt_views.gltf"));
    for (std::size_t k = 0; k < 1796; ++k) { // the compressed buffer stands first
        GltfDocument damaged = whole;
        damaged.binary[k] = static_cast<char>(damaged.binary[k] ^ (1 << k % 8));
        try {
            decode_meshopt(damaged);
        } catch (const std::out_of_range&) {
        }
    }
}
