// What a glTF names by number, when it is read and when arrays are left out of it.
#include "formats/models/gltf_complete.h"
#include "formats/models/gltf_document.h"
#include "formats/models/gltf_prune.h"
#include "tests/support/small_gltf.h"

using namespace small_gltf;

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
