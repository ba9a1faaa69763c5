// Each refusal beside a neighbour that is read. Files are written here byte by byte, and what they must give follows from
// the format: a vertex is moved by its joints' world matrices, weighted.
#include "formats/models/gltf_complete.h"
#include "formats/models/gltf_document.h"
#include "formats/models/gltf_prune.h"
#include "formats/models/model_scene.h"
#include "tests/support/import_support.h"
#include <functional>

using namespace bough;
using namespace bough::test;
using Json = nlohmann::ordered_json;

namespace {

// A buffer of the bytes that pairs of hexadecimal digits stand for; blanks part them.
Json buffer(const std::string& hex) {
    std::string digits, uri = "data:application/octet-stream,";
    for (const char c : hex)
        if (c != ' ') digits += c;
    for (std::size_t k = 0; k < digits.size(); k += 2) uri += "%" + digits.substr(k, 2);
    return {{"byteLength", digits.size() / 2}, {"uri", uri}};
}

// Views, buffers and accessors of the file below go by these numbers.
enum Array : std::size_t { position, joints, weights, indices };

const std::string one = "0000803F ", zero = "00000000 ", half = "0000003F ";

// Two joints, at (0, 0, 0) and (0, 1, 0); a skin without matrices, so that each moves a vertex by its place; and two
// triangles of four vertices on x, of which the joints take all, 1/2, nothing and nothing to the first of the two.
Json skinned() {
    Json json = Json::parse(R"({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 2]}],
        "nodes": [{"children": [1]}, {"translation": [0, 1, 0]}, {"mesh": 0, "skin": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]}],
        "skins": [{"joints": [0, 1]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5121, "count": 4, "type": "VEC4"},
                      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
                      {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 1, "byteLength": 16},
                        {"buffer": 2, "byteLength": 64}, {"buffer": 3, "byteLength": 12}]})");
    json["buffers"] = {buffer(zero + zero + zero + half + zero + zero + one + zero + zero + "00000040" + zero + zero),
                       buffer("00010000 00010000 00010000 01000000"),
                       buffer(one + zero + zero + zero + half + half + zero + zero + zero + one + zero + zero + one +
                              zero + zero + zero),
                       buffer("0000 0100 0200 0200 0100 0300")};
    return json;
}

const std::vector<Vec3> moved{{0, 0, 0}, {0.5, 0.5, 0}, {1, 1, 0}, {2, 1, 0}};

using Change = std::function<void(Json&)>;

std::string changed(const Change& change) {
    Json json = skinned();
    change(json);
    return json.dump();
}

ModelScene scene_of(const std::string& content) {
    ImportOptions options;
    options.name = "s.gltf";
    return read_model(content, AssimpKind::gltf, options);
}

// The file's vertices as the joints move them.
void reads(const Change& change, const std::vector<Vec3>& expected = moved) {
    const ModelScene scene = scene_of(changed(change));
    REQUIRE(scene.vertex.size() == expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v) {
        INFO(v << ": " << scene.vertex[v].transpose());
        CHECK(near(scene.vertex[v], expected[v], 1e-6));
    }
    CHECK(scene.triangles == 2);
}

void refuses(const Change& change, const std::string& text) {
    std::string error;
    try {
        scene_of(changed(change));
    } catch (const InputError& e) {
        error = e.what();
    }
    INFO("expected: " << text);
    CHECK(error == "s.gltf: is no glTF 2.0: " + text);
}

Json& accessor(Json& json, std::size_t array) {
    return json["accessors"][array];
}
Json& view(Json& json, std::size_t array) {
    return json["bufferViews"][array];
}
Json& attributes(Json& json) {
    return json["meshes"][0]["primitives"][0]["attributes"];
}
void put(Json& json, std::size_t array, int component, const std::string& hex) {
    json["buffers"][array] = buffer(hex);
    view(json, array)["byteLength"] = json["buffers"][array]["byteLength"];
    accessor(json, array)["componentType"] = component;
}

// The same weights of joints 0 and 1 for the first three vertices, of 1 and 0 for the last.
Change weighted(int component, const std::string& element, bool normalized) {
    return [=](Json& json) {
        put(json, weights, component, element + element + element + element);
        if (normalized) accessor(json, weights)["normalized"] = true;
    };
}

} // namespace

TEST_CASE("a small skin is read as the format has it") {
    reads([](Json&) {});
}

TEST_CASE("joints are four unsigned bytes or shorts") {
    reads([](Json& j) {
        put(j, joints, 5123, "0000 0100 0000 0000 0000 0100 0000 0000 0000 0100 0000 0000 0100 0000 0000 0000");
    });
    const std::string expected = ", expected VEC4 of unsigned bytes or shorts",
                      place = "mesh 0, primitive 0: JOINTS_0 (accessor 1) is ";
    refuses([](Json& j) { accessor(j, joints)["type"] = "VEC3"; }, place + "\"VEC3\" of unsigned bytes" + expected);
    refuses([](Json& j) { accessor(j, joints)["type"] = "VEC5"; }, place + "\"VEC5\" of unsigned bytes" + expected);
    refuses([](Json& j) { accessor(j, joints)["componentType"] = 5120; }, place + "\"VEC4\" of bytes" + expected);
    refuses([](Json& j) { accessor(j, joints)["componentType"] = 5126; }, place + "\"VEC4\" of floats" + expected);
    refuses([](Json& j) { accessor(j, joints)["componentType"] = 5125; },
            place + "\"VEC4\" of unsigned ints" + expected);
    refuses([](Json& j) { accessor(j, joints)["normalized"] = true; },
            place + "\"VEC4\" of normalized unsigned bytes" + expected);
    refuses([](Json& j) { accessor(j, joints)["componentType"] = 5124; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1): componentType is 5124, expected 5120 to 5123, 5125 or 5126");
}

TEST_CASE("weights are four floats, or bytes and shorts that stand for them") {
    // 0.2 and 0.8 as floats, of 255 and of 65535.
    const std::vector<Vec3> shared{{0, 0.8, 0}, {0.5, 0.8, 0}, {1, 0.8, 0}, {2, 0.2, 0}};
    reads(weighted(5126, "CDCC4C3E CDCC4C3F 00000000 00000000", false), shared);
    reads(weighted(5121, "33 CC 00 00", true), shared);
    reads(weighted(5123, "3333 CCCC 0000 0000", true), shared);
    // Where bytes do not stand for 0 to 1, the fifth of them outweighs the four fifths in floats.
    const auto in_two_sets = [](Json& j) {
        weighted(5121, "33 00 00 00", true)(j);
        j["buffers"].push_back(buffer("00000000 CDCC4C3F 00000000 00000000 00000000 CDCC4C3F 00000000 00000000"
                                      "00000000 CDCC4C3F 00000000 00000000 00000000 CDCC4C3F 00000000 00000000"));
        j["bufferViews"].push_back({{"buffer", 4}, {"byteLength", 64}});
        j["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
        attributes(j)["JOINTS_1"] = joints, attributes(j)["WEIGHTS_1"] = 4;
    };
    reads(in_two_sets, shared);
    const std::string expected = ", expected VEC4 of floats or normalized unsigned bytes or shorts",
                      place = "mesh 0, primitive 0: WEIGHTS_0 (accessor 2) is ";
    refuses(weighted(5121, "33 CC 00 00", false), place + "\"VEC4\" of unsigned bytes" + expected);
    refuses(weighted(5120, "19 66 00 00", true), place + "\"VEC4\" of normalized bytes" + expected);
    refuses([](Json& j) { accessor(j, weights)["type"] = "VEC2"; }, place + "\"VEC2\" of floats" + expected);
}

TEST_CASE("joints and weights come together, one for each vertex") {
    refuses([](Json& j) { accessor(j, joints)["count"] = 3; },
            "mesh 0, primitive 0: JOINTS_0 has 3 elements, expected one for each of 4 vertices");
    refuses([](Json& j) { accessor(j, weights)["count"] = 1; },
            "mesh 0, primitive 0: WEIGHTS_0 has 1 element, expected one for each of 4 vertices");
    refuses([](Json& j) { attributes(j).erase("WEIGHTS_0"); }, "mesh 0, primitive 0: JOINTS_0 comes without WEIGHTS_0");
    refuses([](Json& j) { attributes(j)["WEIGHTS_1"] = weights; },
            "mesh 0, primitive 0: WEIGHTS_1 comes without JOINTS_1");
    // The same four again are the same shares.
    reads([](Json& j) { attributes(j)["WEIGHTS_1"] = weights, attributes(j)["JOINTS_1"] = joints; });
}

TEST_CASE("a vertex is moved by joints that its skin has") {
    refuses([](Json& j) { put(j, joints, 5121, "00010000 00010000 00020000 01000000"); },
            "mesh 0, primitive 0: JOINTS_0 has joint 2 move vertex 2, but skin 0 has 2 joints");
    refuses([](Json& j) { j["skins"][0]["joints"] = {0}; },
            "mesh 0, primitive 0: JOINTS_0 has joint 1 move vertex 1, but skin 0 has 1 joint");
    reads([](Json& j) { put(j, joints, 5121, "0001FFFF 00010000 0001FF02 01000000"); }); // with a weight of 0
    reads([](Json& j) { j["skins"][0]["joints"] = {0, 1, 2}; });
    // A mesh that no skin moves has none that could be wrong.
    const std::string still = changed([](Json& j) {
        put(j, joints, 5121, "00010000 00010000 00020000 01000000");
        j["nodes"][2].erase("skin");
    });
    CHECK(scene_of(still).triangles == 2);
}

TEST_CASE("indices are whole and name vertices that are there") {
    reads([](Json& j) { put(j, indices, 5121, "00 01 02 02 01 03"); });
    reads([](Json& j) { put(j, indices, 5125, "00000000 01000000 02000000 02000000 01000000 03000000"); });
    refuses([](Json& j) { put(j, indices, 5123, "0000 0100 0200 0200 0100 0400"); },
            "mesh 0, primitive 0: a triangle names vertex 4, expected 0 to 3");
    const auto lines = [](int mode, const std::string& hex) {
        return [=](Json& j) {
            put(j, indices, 5125, hex);
            accessor(j, indices)["count"] = hex.size() / 8;
            j["meshes"][0]["primitives"][0]["mode"] = mode;
        };
    };
    // 1 000 000, and the largest there is: all their digits.
    refuses(lines(1, "0000000040420F00"), "mesh 0, primitive 0: a line names vertex 1000000, expected 0 to 3");
    refuses(lines(0, "FFFFFFFF"), "mesh 0, primitive 0: a point names vertex 4294967295, expected 0 to 3");
    const ModelScene line = scene_of(changed(lines(1, "0000000003000000")));
    CHECK(line.line.size() == 1);
    const std::string expected = ", expected SCALAR of unsigned bytes, shorts or ints",
                      place = "mesh 0, primitive 0: indices (accessor 3) is ";
    refuses([](Json& j) { accessor(j, indices)["type"] = "VEC3"; }, place + "\"VEC3\" of unsigned shorts" + expected);
    refuses([](Json& j) { accessor(j, indices)["componentType"] = 5122; }, place + "\"SCALAR\" of shorts" + expected);
    refuses([](Json& j) { accessor(j, indices)["normalized"] = true; },
            place + "\"SCALAR\" of normalized unsigned shorts" + expected);
    refuses([](Json& j) { accessor(j, position)["type"] = "VEC2"; },
            "mesh 0, primitive 0: POSITION (accessor 0) is \"VEC2\" of floats, expected VEC3 of floats");
}

TEST_CASE("elements stand apart by their size or more, within their view") {
    // Positions and joints by turns, 16 bytes apart; the last joints end where the view does.
    const auto interleaved = [](std::size_t stride, std::size_t length) {
        return [=](Json& j) {
            put(j, position, 5126,
                zero + zero + zero + "00010000" + half + zero + zero + "00010000" + one + zero + zero + "00010000" +
                    "00000040" + zero + zero + "01000000");
            view(j, position)["byteStride"] = stride;
            view(j, position)["byteLength"] = length;
            accessor(j, joints)["bufferView"] = position;
            accessor(j, joints)["byteOffset"] = 12;
        };
    };
    reads(interleaved(16, 64));
    refuses(interleaved(16, 63), "mesh 0, primitive 0: JOINTS_0 (accessor 1) ends beyond its view: 4 elements of 4 "
                                 "bytes, 16 apart, from byte 12 of 63");
    refuses(interleaved(11, 64), "mesh 0, primitive 0: POSITION (accessor 0), view 0: byteStride is 11, expected "
                                 "at least the 12 bytes of an element");
    reads([](Json& j) { view(j, joints)["byteStride"] = 4; });
    reads([](Json& j) { view(j, joints)["byteStride"] = 0; }); // other readers take it for none, too
    refuses([](Json& j) { view(j, joints)["byteStride"] = 3; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1), view 1: byteStride is 3, expected at least the 4 bytes "
            "of an element");
}

TEST_CASE("places beyond any file are refused as such") {
    const std::string place = "mesh 0, primitive 0: JOINTS_0 (accessor 1) ends beyond its view: ";
    // 2^62 elements behind the first, 4 bytes each, end where the first does if sums are kept to 64 bits.
    refuses([](Json& j) { accessor(j, joints)["count"] = 4611686018427387905u; },
            place + "4611686018427387905 elements of 4 bytes, 4 apart, from byte 0 of 16");
    refuses([](Json& j) { view(j, joints)["byteStride"] = 9223372036854775808u; },
            place + "4 elements of 4 bytes, 9223372036854775808 apart, from byte 0 of 16");
    refuses([](Json& j) { accessor(j, joints)["byteOffset"] = 18446744073709551612u; },
            place + "4 elements of 4 bytes, 4 apart, from byte 18446744073709551612 of 16");
    refuses([](Json& j) { accessor(j, joints)["byteOffset"] = -4; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1): byteOffset is -4, expected a whole number");
    refuses([](Json& j) { accessor(j, joints)["count"] = 4.5; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1): count is 4.5, expected a whole number");
    refuses([](Json& j) { accessor(j, joints)["count"] = "four"; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1): count is \"four\", expected a whole number");
    refuses([](Json& j) { accessor(j, joints).erase("bufferView"), accessor(j, joints)["count"] = 1000000000; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1) names 1000000000 zeros, more than the file has bytes");
    std::string error;
    try {
        scene_of(changed([](Json& j) { view(j, joints)["byteOffset"] = 18446744073709551608u; }));
    } catch (const InputError& e) {
        error = e.what();
    }
    CHECK(error == "s.gltf: view 1 has 16 bytes from byte 18446744073709551608 on, of a buffer of 16 (glTF 2.0)");
}

TEST_CASE("a sparse array changes what is there") {
    // Weights of nothing but zeros, into which one element is put for each of these places; as bytes, so that they are
    // put there by us.
    const auto sparse = [](int component, const std::string& places) {
        return [=](Json& j) {
            put(j, weights, 5121, "FF000000 80800000 00FF0000 FF000000");
            accessor(j, weights).erase("bufferView");
            accessor(j, weights)["normalized"] = true;
            put(j, indices, 5121, "00 01 02 02 01 03");
            j["buffers"].push_back(buffer(places));
            j["bufferViews"].push_back({{"buffer", 4}, {"byteLength", j["buffers"][4]["byteLength"]}});
            accessor(j, weights)["sparse"] = {{"count", 4},
                                              {"indices", {{"bufferView", 4}, {"componentType", component}}},
                                              {"values", {{"bufferView", std::size_t(weights)}}}};
        };
    };
    reads(sparse(5121, "00 01 02 03"));
    reads(sparse(5123, "0000 0100 0200 0300"));
    refuses(sparse(5121, "00 01 02 04"), "mesh 0, primitive 0: WEIGHTS_0: a sparse array changes element 4 of 4");
    refuses(sparse(5126, zero + zero + zero + zero),
            "mesh 0, primitive 0: WEIGHTS_0 (accessor 2): its sparse indices are floats, expected unsigned bytes, "
            "shorts or ints");
    refuses(sparse(5121, "00 01 02"), "mesh 0, primitive 0: WEIGHTS_0 (accessor 2), the array of sparse indices ends "
                                      "beyond its view: 4 elements of 1 byte, "
                                      "1 apart, from byte 0 of 3");
}

TEST_CASE("a skin has a matrix of floats for each joint, or none at all") {
    const std::string identity =
        one + zero + zero + zero + zero + one + zero + zero + zero + zero + one + zero + zero + zero + zero + one;
    const auto with = [&](const char* type, int component, std::size_t count) {
        return [=](Json& j) {
            std::string all;
            for (std::size_t k = 0; k < count; ++k) all += identity;
            j["buffers"].push_back(buffer(all));
            j["bufferViews"].push_back({{"buffer", 4}, {"byteLength", 64 * count}});
            j["accessors"].push_back(
                {{"bufferView", 4}, {"componentType", component}, {"count", count}, {"type", type}});
            j["skins"][0]["inverseBindMatrices"] = 4;
        };
    };
    reads(with("MAT4", 5126, 2));
    reads(with("MAT4", 5126, 3));
    refuses(with("MAT4", 5126, 1), "skin 0: inverseBindMatrices has 1 matrix, expected one for each of 2 joints");
    refuses(with("MAT3", 5126, 2),
            "skin 0: inverseBindMatrices (accessor 4) is \"MAT3\" of floats, expected MAT4 of floats");
    refuses(with("MAT4", 5125, 2),
            "skin 0: inverseBindMatrices (accessor 4) is \"MAT4\" of unsigned ints, expected MAT4 of floats");
}

TEST_CASE("a mesh in Draco's form is left out, its joints stay") {
    const ModelScene scene = scene_of(changed([](Json& j) {
        j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    }));
    CHECK(scene.mesh_encoded);
    CHECK(scene.triangles == 0);
    CHECK(std::count(scene.role.begin(), scene.role.end(), NodeRole::joint) == 2);
}

TEST_CASE("places, materials, textures and images are there and are what they are called") {
    const std::string nan = "0000C07F ";
    refuses(
        [&](Json& j) {
            put(j, position, 5126, zero + zero + zero + one + nan + zero + one + one + one + one + one + one);
        },
        "mesh 0, primitive 0: POSITION: vertex 1 is not finite, expected numbers");
    refuses(
        [](Json& j) {
            for (const std::size_t a : {position, joints, weights, indices}) accessor(j, a)["count"] = 0;
        },
        "mesh 0, primitive 0: POSITION has no vertices, expected one or more");
    const auto with_image = [](const char* key, Json value, const std::string& uri) {
        return [=](Json& j) {
            j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
            j["textures"] = {{{"source", 0}}};
            j["images"] = {{{"uri", uri}}};
            j["meshes"][0]["primitives"][0]["material"] = 0;
            if (key) j[Json::json_pointer(key)] = value;
        };
    };
    const std::string png = "data:image/png;base64,iVBORw0KGgo="; // a PNG's first bytes
    reads(with_image(nullptr, {}, png));
    refuses(with_image("/meshes/0/primitives/0/material", 1, png),
            "mesh 0, primitive 0: material is 1, expected less than 1");
    refuses(with_image("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 3, png),
            "material 0, baseColorTexture: index is 3, expected less than 1");
    refuses(with_image("/textures/0/source", 1, png), "texture 0: source is 1, expected less than 1");
    refuses(with_image(nullptr, {}, "data:image/png;base64,AAAA"),
            "image 0 is no image that can be read, expected image/png");
    refuses(with_image(nullptr, {}, "data:image/jpeg;base64,iVBO"),
            "image 0 is no image that can be read, expected image/jpeg");
}

TEST_CASE("whole numbers are positions where the file says that it quantizes") {
    // 0, 1/2, 1 and 2 as shorts of which the largest stands for 1, in a mesh that its skin's matrices make 2 units long.
    const auto shorts = [](bool stated) {
        return [=](Json& j) {
            put(j, position, 5122, "00000000 00000000 00200000 00000000 00400000 00000000 FF7F0000 00000000");
            view(j, position)["byteStride"] = 8;
            accessor(j, position)["normalized"] = true;
            if (stated) j["extensionsUsed"] = {"KHR_mesh_quantization"};
            const std::string two = "00000040 ";
            const std::string matrix = two + zero + zero + zero + zero + two + zero + zero + zero + zero + two + zero +
                                       zero + zero + zero + one;
            j["buffers"].push_back(buffer(matrix + matrix));
            j["bufferViews"].push_back({{"buffer", 4}, {"byteLength", 128}});
            j["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
            j["skins"][0]["inverseBindMatrices"] = 4;
        };
    };
    const double unit = 2.0 / 32767; // of a short, once it is in the world
    reads(shorts(true), {{0, 0, 0}, {0x2000 * unit, 0.5, 0}, {0x4000 * unit, 1, 0}, {2, 1, 0}});
    refuses(shorts(false),
            "mesh 0, primitive 0: POSITION (accessor 0) is \"VEC3\" of normalized shorts, expected VEC3 of floats");
}

TEST_CASE("what a file names by number is there") {
    refuses([](Json& j) { j["nodes"][2]["mesh"] = 1; }, "the mesh of node 2 is 1, expected less than 1");
    refuses([](Json& j) { j["nodes"][2]["skin"] = -1; }, "the skin of node 2 is -1, expected a whole number");
    refuses([](Json& j) { j["nodes"][2]["mesh"] = 0.5; }, "the mesh of node 2 is 0.5, expected a whole number");
    refuses([](Json& j) { j["skins"][0]["joints"][1] = 3; }, "a joint of skin 0 is 3, expected less than 3");
    refuses([](Json& j) { attributes(j)["JOINTS_0"] = 4; }, "mesh 0, primitive 0: JOINTS_0 is 4, expected less than 4");
    refuses([](Json& j) { accessor(j, joints)["bufferView"] = 4; },
            "mesh 0, primitive 0: JOINTS_0 (accessor 1): bufferView is 4, expected less than 4");
    refuses([](Json& j) { j.erase("meshes"); }, "the mesh of node 2 is 0, but there is none");
    // Without scenes, what is no child is a root.
    const auto orphaned = [](int child) {
        return [=](Json& j) {
            j.erase("scenes");
            j["nodes"][0]["children"] = {child};
        };
    };
    reads(orphaned(1));
    refuses(orphaned(3), "a child of node 0 is 3, expected less than 3");
    Json json = skinned();
    json.erase("scenes");
    add_missing_scene(json);
    CHECK(json["scenes"] == Json::parse(R"([{"nodes": [0, 2]}])"));
    CHECK(json["scene"] == 0);
}

TEST_CASE("an index is a whole number below its end") {
    const Json json =
        Json::parse(R"({"last": 4, "beyond": 5, "part": 4.0, "negative": -1, "text": "4", "huge": 1e300})");
    CHECK(index_of(json, "last", "o", 5) == 4);
    CHECK_THROWS_WITH(index_of(json, "beyond", "o", 5), "o: beyond is 5, expected less than 5");
    CHECK_THROWS_WITH(index_of(json, "last", "o", 0), "o: last is 4, but there is none");
    CHECK_THROWS_WITH(index_of(json, "part", "o", 5), "o: part is 4.0, expected a whole number");
    CHECK_THROWS_WITH(index_of(json, "negative", "o", 5), "o: negative is -1, expected a whole number");
    CHECK_THROWS_WITH(index_of(json, "text", "o", 5), "o: text is \"4\", expected a whole number");
    CHECK_THROWS_WITH(index_of(json, "huge", "o", 5), "o: huge is 1e+300, expected a whole number");
    CHECK_THROWS_AS(index_of(json, "gone", "o", 5), Json::exception);
}

TEST_CASE("arrays are only left out of a document whose indices are right") {
    const auto document = [](const Change& change) {
        GltfDocument result;
        result.binary = std::string(140, '\0');
        result.json = skinned();
        for (Json& v : result.json["bufferViews"]) v["buffer"] = 0;
        change(result.json);
        return result;
    };
    GltfDocument good = document([](Json& j) { attributes(j).erase("WEIGHTS_0"); });
    CHECK(prune(good, {weights}).empty());
    CHECK(good.json["accessors"].size() == 3);
    CHECK(good.json["meshes"][0]["primitives"][0]["indices"] == 2);
    GltfDocument beyond = document([](Json& j) { attributes(j)["WEIGHTS_0"] = 4; });
    CHECK_THROWS_WITH(prune(beyond, {weights}), "an accessor is 4, expected less than 4");
    GltfDocument part = document([](Json& j) { accessor(j, joints)["bufferView"] = 1.5; });
    CHECK_THROWS_WITH(prune(part, {weights}), "a bufferView is 1.5, expected a whole number");
}
