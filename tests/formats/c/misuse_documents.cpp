// Documents that bough_c.h is given, broken or another's, and runs that become non-finite: what its messages say, and that they are text.
#include "formats/plain_text.h"
#include "tests/support/c_misuse.h"

using namespace bough::test;

TEST_CASE("documents that are none, or another's, are BOUGH_INPUT with name and place") {
    const Handles h;
    bough_tree* tree = nullptr;
    bough_splines* splines = nullptr;
    bough_scene* scene = nullptr;
    bough_simulation* simulation = nullptr;
    std::string noise(4096, 0);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = char(i * 2654435761u >> 13);
    std::size_t size = 0;
    REQUIRE(bough_save(h.simulation, nullptr, 0, &size) == BOUGH_OK);
    std::string state(size, 0);
    REQUIRE(bough_save(h.simulation, state.data(), size, &size) == BOUGH_OK);
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("{}"), std::string("[1]"), noise, state.substr(0, size / 2)}) {
        refused(bough_read_splines(text.data(), text.size(), "a.json", &splines), BOUGH_INPUT, "a.json");
        refused(bough_read_tree(text.data(), text.size(), "b.json", &tree), BOUGH_INPUT, "b.json");
        if (!text.empty()) refused(bough_read_scene(text.data(), text.size(), "c.json", &scene), BOUGH_INPUT, "c.json");
        refused(bough_restore(h.simulation, text.data(), text.size(), nullptr), BOUGH_INPUT, "<memory>");
    }
    refused(bough_read_tree(state.data(), state.size(), "b", &tree), BOUGH_INPUT, "b: ");
    const std::string wrong = R"({"format": "bough-scene", "version": 1, "wind": "gale"})";
    refused(bough_read_scene(wrong.data(), wrong.size(), "c", &scene), BOUGH_INPUT, "c: /wind");
    CHECK(tree == nullptr);
    CHECK(splines == nullptr);
    CHECK(scene == nullptr);

    // A scene that cannot be run: no tree; a selector that names none.
    REQUIRE(bough_read_scene(nullptr, 0, nullptr, &scene) == BOUGH_OK);
    refused(bough_simulate(scene, nullptr, nullptr, &simulation), BOUGH_USAGE, "has no tree");
    REQUIRE(bough_free(scene) == BOUGH_OK);
    const std::string nobody = R"({"format": "bough-scene", "version": 1, "trees": [{"file": "x"}],
        "pulls": [{"on": {"body": 9999}, "time": [0, 1], "force": [[0, 0, 0], [1, 0, 0]]}]})";
    REQUIRE(bough_read_scene(nobody.data(), nobody.size(), nullptr, &scene) == BOUGH_OK);
    REQUIRE(bough_scene_put(scene, 0, h.tree) == BOUGH_OK);
    refused(bough_simulate(scene, nullptr, nullptr, &simulation), BOUGH_INPUT, "/pulls/0");
    CHECK(simulation == nullptr);
    REQUIRE(bough_free(scene) == BOUGH_OK);
}

TEST_CASE("a run that becomes non-finite says so at each step, and everything can still be called") {
    const Handles h;
    std::size_t size = 0;
    REQUIRE(bough_save(h.simulation, nullptr, 0, &size) == BOUGH_OK);
    std::string state(size, 0);
    REQUIRE(bough_save(h.simulation, state.data(), size, &size) == BOUGH_OK);
    const double v[3] = {0, 0, 0.1}, force[3] = {1e308, 1e308, 0};
    for (int k = 0; k < 3; ++k) CHECK(bough_pull(h.simulation, 20, v, force) == BOUGH_OK);
    bough_report report = {};
    bough_result result = BOUGH_OK;
    for (int k = 0; k < 5 && result == BOUGH_OK; ++k) result = bough_step(h.simulation, &report);
    refused(result, BOUGH_NON_FINITE, "the simulation became non-finite in step ");
    CHECK(report.steps > 0);
    refused(bough_step(h.simulation, nullptr), BOUGH_NON_FINITE, "body ");
    bough_array a;
    bough_hit hit;
    std::int32_t found;
    std::uint64_t hash;
    const double from[3] = {0, 1, 30}, to[3] = {0, 0, -1};
    CHECK(bough_read(h.simulation, BOUGH_POSITION, &a) == BOUGH_OK);
    CHECK(bough_pick(h.simulation, from, to, 1, &hit, &found) == BOUGH_OK);
    CHECK(bough_hash(h.simulation, &hash) == BOUGH_OK);
    size = 7;
    refused(bough_save(h.simulation, nullptr, 0, &size), BOUGH_NON_FINITE,
            "the simulation became non-finite in step " + std::to_string(report.steps) + ": ");
    CHECK(std::string(bough_error()).find("; its state is not saved") != std::string::npos);
    refused(bough_save(h.simulation, state.data(), state.size(), &size), BOUGH_NON_FINITE, "; its state is not saved");
    CHECK(size == 7);
    // One that goes on with its motion, and has not been stepped.
    bough_simulation* following = nullptr;
    REQUIRE(bough_simulate(h.scene, nullptr, h.simulation, &following) == BOUGH_OK);
    refused(bough_save(following, nullptr, 0, &size), BOUGH_NON_FINITE, "the simulation is not finite");
    CHECK(bough_free(following) == BOUGH_OK);
    // From a state that is finite it goes on.
    REQUIRE(bough_restore(h.simulation, state.data(), state.size(), nullptr) == BOUGH_OK);
    CHECK(bough_save(h.simulation, nullptr, 0, &size) == BOUGH_OK);
    CHECK(size == state.size());
    CHECK(bough_step(h.simulation, nullptr) == BOUGH_OK);
}

TEST_CASE("messages are valid UTF-8 in one line, whatever bytes a document has and wherever they are cut") {
    for (const std::size_t length : {1, 40, 2000, 5000})
        for (const char* const part : {"\xFF", "\xC3\xA9", "\xA9\n", "\xF0\x9F\x8C\xB3"}) {
            std::string name, text = "{\"format\": \"bough-tree\", \"version\": ";
            for (std::size_t k = 0; k < length; ++k) name += part;
            text += name;
            bough_tree* tree = nullptr;
            CHECK(bough_read_tree(text.data(), text.size(), name.c_str(), &tree) == BOUGH_INPUT);
            const std::string message = bough_error();
            CHECK(bough::valid_utf8(message) == message);
            CHECK(message.find('\n') == std::string::npos);
        }
}
