// What a file can reach that names other files: its own folder and what is below it.
#include "formats/inside.h"
#include "formats/documents/scene.h"
#include "formats/models/gltf_uri.h"
#include "formats/models/texture_file.h"
#include "formats/open.h"
#include "tests/support/random_documents.h"
#include <fstream>

using namespace bough;
using namespace bough::test;
namespace fs = std::filesystem;

namespace {

// own/ with a file in it and one below, and what it is not to reach: a secret beside it, by four links too.
struct Places {
    Folder folder;
    std::string own = folder / "own";
    Places() {
        fs::create_directories(fs::path(own) / "below");
        fs::create_directories(folder.path / "own2");
        put(folder.path / "secret", "secret");
        put(folder.path / "own2/secret", "secret");
        put(fs::path(own) / "file", "file");
        put(fs::path(own) / "below/file", "file");
        fs::create_symlink("../secret", fs::path(own) / "link");
        fs::create_directory_symlink("..", fs::path(own) / "up");
        fs::create_symlink("below/file", fs::path(own) / "fine");
        fs::create_symlink("link", fs::path(own) / "twice");
    }
    std::vector<std::string> within() const { return {"file", "below/file", "below/../file", "./file", "fine"}; }
    std::vector<std::string> outside() const {
        return {"../secret",  "below/../../secret",        "link",           "up/secret",
                "twice",      "below/../up/own/up/secret", "../own2/secret", "missing/../../secret",
                "../own/file"}; // which tells whether a folder of that name is there
    }
};

Placement naming(const std::string& file) {
    Placement place;
    place.file = file;
    return place;
}

struct Outside {
    Outside() { may_reach_outside() = true; }
    ~Outside() { may_reach_outside() = false; }
};

} // namespace

TEST_CASE("a path is within reach where it ends in the folder, whatever way it takes") {
    const Places places;
    for (const std::string& name : places.within()) {
        CAPTURE(name);
        CHECK(within_reach(places.own + "/" + name, places.own));
        CHECK(within_reach(places.own + "/" + name, places.own + "/"));
    }
    for (const std::string& name : places.outside()) {
        CAPTURE(name);
        CHECK(!within_reach(places.own + "/" + name, places.own));
        const Outside allowed;
        CHECK(within_reach(places.own + "/" + name, places.own));
    }
    CHECK(within_reach(places.own + "/not/there/yet", places.own));
    CHECK(!within_reach("/etc/passwd", places.own));
    const fs::path before = fs::current_path();
    fs::current_path(places.own);
    for (const char* here : {"", ".", "./", "../own"}) CHECK(within_reach("below/file", here));
    CHECK(!within_reach("../secret", "."));
    CHECK(!within_reach("link", ""));
    CHECK(within_reach("not_there", "."));
    fs::current_path(before);
    CHECK(within_reach("/etc/passwd", "/"));
}

TEST_CASE("a scene reaches no tree outside its folder") {
    const Places places;
    const std::string scene = places.own + "/scene.json";
    for (const std::string& name : places.within()) CHECK(tree_file(scene, naming(name)) == places.own + "/" + name);
    std::vector<std::string> outside = places.outside();
    outside.push_back("/etc/passwd");
    for (const std::string& name : outside) {
        CAPTURE(name);
        CHECK_THROWS_WITH(tree_file(scene, naming(name)),
                          Catch::Contains("scene.json: /trees: names '" + name + "', which leads out of the folder"));
    }
    const Outside allowed;
    CHECK(tree_file(scene, naming("/etc/passwd")) == "/etc/passwd");
}

TEST_CASE("a glTF file reaches no buffer or image outside its folder, nor the network") {
    const Places places;
    for (const std::string& name : places.within()) CHECK(bytes_of_uri(name, places.own) == "file");
    CHECK(bytes_of_uri("below%2Ffile", places.own) == "file");
    std::vector<std::string> outside = places.outside();
    for (const char* more : {"%2e%2e/secret", "..%2Fsecret", "%2E%2E%2fsecret", "below/%2e./%2e./secret"})
        outside.push_back(more);
    for (const std::string& name : outside) {
        CAPTURE(name);
        CHECK_THROWS_WITH(bytes_of_uri(name, places.own), Catch::Contains("leads out of the folder"));
    }
    for (const char* other : {"/etc/passwd", "file:///etc/passwd", "https://example.org/x.bin", "http://[::1]/x"}) {
        CAPTURE(other);
        CHECK_THROWS_WITH(bytes_of_uri(other, places.own), Catch::Contains("is not beside the file"));
    }
    CHECK_THROWS_AS(bytes_of_uri("%2Fetc%2Fpasswd", places.own), std::runtime_error); // below the folder: not there
}

TEST_CASE("a texture outside the folder of the file that names it is not found") {
    const Places places;
    TextureFinder textures(places.own);
    TexturePlaces looked;
    for (const std::string name : {"file", "below/file", "FILE", "below\\file"})
        CHECK(!textures.find(name, looked).empty());
    CHECK(looked.tried.empty());
    for (const std::string name :
         {"link", "twice", "LINK", "up/secret", "../secret", "..\\secret", "..\\own2\\secret"}) {
        CAPTURE(name);
        looked = {};
        CHECK(textures.find(name, looked).empty());
        CHECK(!looked.outside.empty());
    }
    // It is told which place was not looked at, whatever stands there.
    for (const auto& [name, outside] : {std::pair("link", "/link"), std::pair("../secret", "/../secret"),
                                        std::pair("../none", "/../none"), std::pair("none", "")}) {
        looked = {};
        CHECK(textures.find(name, looked).empty());
        CHECK(looked.outside == (*outside ? places.own + outside : ""));
    }
    CHECK(textures.find(places.folder / "secret", looked).empty());
    CHECK(textures.find("/etc/passwd", looked).empty());
    // An absolute path of another machine falls back on the bare name, as ever.
    CHECK(textures.find("C:\\elsewhere\\file", looked) == places.own + "/file");
    const Outside allowed;
    CHECK(textures.find("../secret", looked) == places.own + "/../secret");
}

TEST_CASE("a folder is looked through once, however many textures are missing") {
    const Places places;
    TextureFinder textures(places.own);
    TexturePlaces looked;
    CHECK(textures.find("none", looked).empty());
    std::ofstream(places.own + "/LATER") << "x"; // which a second look would find
    CHECK(textures.find("later", looked).empty());
    CHECK(textures.find("LATER", looked) == places.own + "/LATER");
    CHECK(TextureFinder(places.own).find("later", looked) == places.own + "/LATER");
}

TEST_CASE("of files whose names differ in capitals alone the first by its bytes is taken") {
    const Places places;
    for (const char* name : {"bark.png", "Bark.png", "BARK.png"}) std::ofstream(places.own + "/" + name) << name;
    TexturePlaces looked;
    CHECK(TextureFinder(places.own).find("bARK.png", looked) == places.own + "/BARK.png");
    CHECK(TextureFinder(places.own).find("Bark.png", looked) == places.own + "/Bark.png");
    std::filesystem::remove(places.own + "/BARK.png");
    std::filesystem::create_symlink(places.folder / "secret", places.own + "/BARK.png");
    CHECK(TextureFinder(places.own).find("bARK.png", looked) == places.own + "/Bark.png"); // BARK.png leads out
}
