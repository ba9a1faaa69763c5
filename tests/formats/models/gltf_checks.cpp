// Each refusal beside a neighbour that is read.
#include "formats/models/model_scene.h"
#include "tests/support/small_gltf.h"

using namespace small_gltf;

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
    refuses(weighted(5126, "CDCC4CBE CDCC4C3F 00000000 00000000", false),
            "mesh 0, primitive 0: WEIGHTS_0: vertex 0 has a weight below 0, expected 0 or more");
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

TEST_CASE("numbers that a moved model keeps are finite, and a mesh has primitives") {
    // NaN and infinity in one vertex after another of what is kept beside positions.
    const auto with = [](const char* name, const char* type, std::size_t width, std::size_t at, const char* hex) {
        return [=](Json& j) {
            std::string all;
            for (std::size_t k = 0; k < 4 * width; ++k) all += k == at ? hex : half;
            j["buffers"].push_back(buffer(all));
            j["bufferViews"].push_back({{"buffer", 4}, {"byteLength", 16 * width}});
            j["accessors"].push_back({{"bufferView", 4}, {"componentType", 5126}, {"count", 4}, {"type", type}});
            attributes(j)[name] = 4;
        };
    };
    const char *const nan = "0000C07F", *const infinite = "0000807F";
    const std::string place = "mesh 0, primitive 0: ", wrong = " is not finite, expected numbers";
    refuses(with("NORMAL", "VEC3", 3, 7, nan), place + "NORMAL: vertex 2" + wrong);
    refuses(with("TEXCOORD_1", "VEC2", 2, 0, infinite), place + "TEXCOORD_1: vertex 0" + wrong);
    refuses(with("COLOR_0", "VEC4", 4, 15, nan), place + "COLOR_0: vertex 3" + wrong);
    refuses(with("_AGE", "SCALAR", 1, 1, nan), place + "_AGE: vertex 1" + wrong);
    for (const char* name : {"NORMAL", "_AGE"}) reads(with(name, "VEC3", 3, 12, ""));
    refuses(
        [](Json& j) {
            put(j, weights, 5126,
                one + zero + zero + zero + half + half + zero + zero + zero + "0000C07F" + zero + zero + one + zero +
                    zero + zero);
        },
        place + "WEIGHTS_0: vertex 2" + wrong);
    refuses(
        [&](Json& j) {
            with("NORMAL", "VEC3", 3, 4, nan)(j);
            attributes(j).erase("NORMAL");
            j["meshes"][0]["primitives"][0]["targets"] = {{{"NORMAL", 4}}};
        },
        "mesh 0, primitive 0, target 0: NORMAL: vertex 1" + wrong);
    refuses([](Json& j) { j["meshes"][0]["primitives"] = Json::array(); },
            "mesh 0 has no primitives, expected one or more");
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
    refuses(lines(77, "00000000"), "mesh 0, primitive 0: mode is 77, expected 0 to 6");
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
    refuses([](Json& j) { accessor(j, joints)["count"] = "four"; }, "/accessors/1/count: is a text, expected a number");
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
