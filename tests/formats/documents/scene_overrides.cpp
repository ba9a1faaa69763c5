// Fields of a scene's document replaced before it is read: against the document as people would have written it.
#include "formats/documents/scene.h"
#include "tests/support/random_documents.h"

using namespace bough;
using namespace bough::test;

namespace {

std::string document(const std::string& fields) {
    return R"({"format": "bough-scene", "version": 1)" + (fields.empty() ? "" : ", " + fields) + "}";
}

std::vector<SceneOverride> overrides(const std::vector<std::string>& texts) {
    std::vector<SceneOverride> result;
    for (const std::string& text : texts) result.push_back(parse_override("--set", text));
    return result;
}

std::string text_of(const SceneDocument& scene) {
    return written([&](Output& o) { write_scene(o, scene.scene, Form::json, scene.material); });
}

std::string with(const std::string& fields, const std::vector<std::string>& set) {
    return text_of(read_scene_document(document(fields), "s.json", overrides(set)));
}

std::string written_by_hand(const std::string& fields) {
    return text_of(read_scene_document(document(fields), "s.json"));
}

std::string error(const std::string& fields, const std::vector<std::string>& set) {
    return error_of([&] { read_scene_document(document(fields), "s.json", overrides(set)); });
}

const std::string two_trees = R"("trees": [{"file": "a.json"}, {"file": "b.json", "yaw": 3}])";

} // namespace

TEST_CASE("a field is replaced, or made with all on the way to it") {
    CHECK(with("", {"gravity=[0,-3,0]"}) == written_by_hand(R"("gravity": [0, -3, 0])"));
    CHECK(with("", {"wind.velocity=[8,0,0]"}) == written_by_hand(R"("wind": {"velocity": [8, 0, 0]})"));
    CHECK(with(R"("wind": {"velocity": [8, 0, 0], "turbulence": 0.3})", {"wind.turbulence=0.1", "wind.seed=7"}) ==
          written_by_hand(R"("wind": {"velocity": [8, 0, 0], "turbulence": 0.1, "seed": 7})"));
    CHECK(with(two_trees, {"trees.1.yaw=30"}) ==
          written_by_hand(R"("trees": [{"file": "a.json"}, {"file": "b.json", "yaw": 30}])"));
    CHECK(with(two_trees, {"trees.2.file=c.json"}) ==
          written_by_hand(R"("trees": [{"file": "a.json"}, {"file": "b.json", "yaw": 3}, {"file": "c.json"}])"));
    CHECK(with("", {"pulls.0.on.body=3", "pulls.0.time=[0,1]", "pulls.0.force=[[0,0,0],[1,0,0]]"}) ==
          written_by_hand(R"("pulls": [{"on": {"body": 3}, "time": [0, 1], "force": [[0, 0, 0], [1, 0, 0]]}])"));
    CHECK(with(R"("joint_limit": 20)", {"joint_limit={\"leaf\": 60}"}) ==
          written_by_hand(R"("joint_limit": {"leaf": 60})"));
    CHECK(with("", {"material.E=9e9", "material.damping_ratio=0.1"}) ==
          written_by_hand(R"("material": {"E": 9e9, "damping_ratio": 0.1})"));
    CHECK(with("", {"balls=[{\"position\":[0,1,0],\"radius\":0.1,\"mass\":2}]", "balls.0.mass=3"}) ==
          written_by_hand(R"("balls": [{"position": [0, 1, 0], "radius": 0.1, "mass": 3}])"));
}

TEST_CASE("a value is JSON, or else text; quotes make it text") {
    CHECK(with("", {"pose=settled"}) == written_by_hand(R"("pose": "settled")"));
    CHECK(with("", {"pose=\"settled\""}) == written_by_hand(R"("pose": "settled")"));
    CHECK(with(two_trees, {"trees.0.file=\"1\""}) ==
          written_by_hand(R"("trees": [{"file": "1"}, {"file": "b.json", "yaw": 3}])"));
    CHECK(with(two_trees, {"trees.0.file=x=y.json"}) ==
          written_by_hand(R"("trees": [{"file": "x=y.json"}, {"file": "b.json", "yaw": 3}])"));
    CHECK(with("", {"wind=storm"}) == written_by_hand(R"("wind": "storm")"));
}

TEST_CASE("a wind that is a preset becomes its fields; later ones come after earlier ones") {
    const Scene calm = read_scene_document(document(R"("wind": "gusty")"), "s").scene;
    const SceneDocument turned =
        read_scene_document(document(R"("wind": "gusty")"), "s", overrides({"wind.velocity=[0,0,5]"}));
    REQUIRE(turned.scene.wind);
    CHECK(turned.scene.wind->velocity == Vec3(0, 0, 5));
    CHECK(turned.scene.wind->turbulence == calm.wind->turbulence);
    CHECK(turned.scene.wind->gust_period == calm.wind->gust_period);
    CHECK(with("", {"wind=storm", "wind.seed=9", "wind.seed=4"}) == with("", {"wind=storm", "wind.seed=4"}));
    CHECK(with("", {"wind.seed=9", "wind=storm"}) == written_by_hand(R"("wind": "storm")"));
}

TEST_CASE("a document that was read is changed as its text would be") {
    const std::string fields = two_trees + R"(, "wind": "breeze", "fracture": {"leaf": 0.1}, "material": {"G": 5e8})";
    const std::vector<std::string> set{"wind.gust_period=9", "fracture.spread=0.5", "material.E=7e9", "trees.0.yaw=8"};
    const SceneDocument read = read_scene_document(document(fields), "s");
    CHECK(text_of(changed(read, overrides(set))) == with(fields, set));
    CHECK(text_of(changed(changed(read, overrides(set)), overrides(set))) == with(fields, set));
}

TEST_CASE("what an override does wrong is told with it and its place") {
    CHECK(error("", {"wnd.velocity=[1,0,0]"}) ==
          "--set wnd.velocity=[1,0,0]: /wnd: is an unknown field, did you mean \"wind\"?");
    CHECK(error(R"("wind": "calm")", {"gravity=[0,0,0]", "wind.velocty=[1,0,0]"}) ==
          "--set wind.velocty=[1,0,0]: /wind/velocty: is an unknown field, did you mean \"velocity\"?");
    CHECK_THAT(error("", {"material.stiffness=3"}),
               Catch::StartsWith("--set material.stiffness=3: /material/stiffness: is an unknown field, expected one "
                                 "of E, G, damping_ratio, density"));
    CHECK(error("", {"wind.turbulence=0.1"}) == "--set wind.turbulence=0.1: /wind/velocity: is missing");
    CHECK(error("", {"wind.velocity=[1,0"}) ==
          "--set wind.velocity=[1,0: /wind/velocity: is \"[1,0\", expected an array of numbers");
    CHECK(error("", {"material.E=-1"}) == "--set material.E=-1: /material/E: is -1, expected more than 0");
    CHECK(error("", {"material.damping_ratio=-1"}) ==
          "--set material.damping_ratio=-1: /material/damping_ratio: is -1, expected 0 or more");
    CHECK(error(two_trees, {"trees.3.file=c"}) ==
          "--set trees.3.file=c: /trees/3: is no element of a list of 2, expected 0 to 2 (the last of them adds one)");
    CHECK_THAT(error(two_trees, {"trees.first.file=c"}),
               Catch::StartsWith("--set trees.first.file=c: /trees/first: is no element of a list of 2"));
    CHECK(error(two_trees, {"trees.00.yaw=3"}).find("/trees/00: is no element of a list of") != std::string::npos);
    CHECK(error(two_trees, {"trees.0.yaw.x=c"}) ==
          "--set trees.0.yaw.x=c: /trees/0/yaw: is an object, expected a number");
    CHECK(error(two_trees, {"trees.1.yaw.x=c"}) ==
          "--set trees.1.yaw.x=c: /trees/1/yaw: is 3, which has no field \"x\"");
    CHECK(error("", {"gravity={\"x\": 1, \"x\": 2}"}) ==
          "--set gravity={\"x\": 1, \"x\": 2}: /gravity/x: appears twice");
}

TEST_CASE("what is wrong in the document itself stays its own error") {
    CHECK(error(R"("gravty": [0, 0, 0])", {"pose=rest"}) ==
          "s.json: /gravty: is an unknown field, did you mean \"gravity\"?");
    CHECK(error(R"("trees": [{"yaw": 3}])", {"trees.0.yaw=4"}) == "s.json: /trees/0/file: is missing");
    CHECK(error(R"("trees": [{"yaw": 3}])", {"trees.0.file=a.json"}) == "");
}

TEST_CASE("what is no PATH=VALUE is refused") {
    for (const char* wrong : {"", "wind", "=3", "wind.=3", ".wind=3", "wind..velocity=3", "wind="})
        CHECK_THROWS_AS(parse_override("--set", wrong), std::invalid_argument);
}

TEST_CASE("what a scene changes of its trees' material comes back") {
    for (const Form form : {Form::json, Form::safetensors}) {
        const SceneDocument scene = read_scene_document(
            document(R"("material": {"E": 1e9, "G": 2e8, "density": 0.1, "damping_ratio": 0})"), "s");
        const std::string text = written([&](Output& o) { write_scene(o, scene.scene, form, scene.material); });
        const MaterialChange back = read_scene_document(text, "s").material;
        CHECK(back.youngs_modulus == 1e9);
        CHECK(back.shear_modulus == 2e8);
        CHECK(back.density == 0.1);
        CHECK(back.damping_ratio == 0.0);
    }
}

TEST_CASE("bytes that are no text are refused, with what is") {
    for (const std::string text : {"wind.se\xA9\xA9=7", "name=\xFF", "a\x01=1", "name=\"\x01\""})
        CHECK_THROWS_WITH(parse_override("--set", text), Catch::Contains("expected UTF-8") && !Catch::Contains("\xA9"));
    CHECK(with("", {"wind={\n\t\"velocity\": [1, 0, 0]}"}) == written_by_hand(R"("wind": {"velocity": [1, 0, 0]})"));
    CHECK(with(two_trees, {"trees.0.file=\xC3\xA9.json"}).find("\xC3\xA9.json") != std::string::npos);
}
