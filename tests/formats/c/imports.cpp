// bough_imports.h: bytes of other programs' trees are the tree that treeconvert makes of them, or an error, whatever they are.
#include "formats/c/bough_imports.h"
#include "formats/error.h"
#include "formats/files.h"
#include "formats/open.h"
#include "tests/support/c_misuse.h"

using namespace bough;
using namespace bough::test;

namespace {

std::string data(const std::string& name) {
    return read_input(std::string(BOUGH_DATA_DIR) + "/" + name);
}

std::string bytes_of(const bough_tree* tree) {
    std::size_t size = 0;
    REQUIRE(bough_write_tree(tree, nullptr, 0, &size) == BOUGH_OK);
    std::string bytes(size, '\0');
    REQUIRE(bough_write_tree(tree, bytes.data(), bytes.size(), &size) == BOUGH_OK);
    return bytes;
}

} // namespace

TEST_CASE("a foreign tree is the same in C and C++, at once and by its splines, with notes") {
    for (const char* file : {"fixtures/bare_bones.xml", "fixtures/archi_small.csv", "fixtures/shuffled.swc",
                             "fixtures/eztree_list.json", "fixtures/lines.gltf"}) {
        INFO(file);
        const std::string bytes = data(file);
        bough_tree *at_once = nullptr, *in_two = nullptr;
        bough_splines* splines = nullptr;
        REQUIRE(bough_import_tree(bytes.data(), bytes.size(), file, nullptr, &at_once) == BOUGH_OK);
        const std::string notes = bough_import_notes();
        REQUIRE(bough_import_splines(bytes.data(), bytes.size(), file, nullptr, &splines) == BOUGH_OK);
        REQUIRE(bough_convert(splines, nullptr, &in_two) == BOUGH_OK);
        CHECK(bytes_of(at_once) == bytes_of(in_two));
        std::vector<std::string> lines;
        const Tree tree = import_tree(bytes, file, {}, &lines);
        CHECK(import_tree(bytes, file).mass == tree.mass); // notes are not asked for
        bough_bodies bodies;
        REQUIRE(bough_tree_bodies(at_once, &bodies) == BOUGH_OK);
        REQUIRE(bodies.count == tree.size_bodies());
        CHECK(std::equal(tree.mass.begin(), tree.mass.end(), bodies.mass));
        REQUIRE(!lines.empty());
        CHECK(notes.substr(0, notes.find('\n')) == lines[0]);
        CHECK(std::size_t(std::count(notes.begin(), notes.end(), '\n')) + 1 == lines.size());

        // A document of ours is read as it is, and has none.
        bough_tree* again = nullptr;
        const std::string own = bytes_of(at_once);
        REQUIRE(bough_import_tree(own.data(), own.size(), nullptr, nullptr, &again) == BOUGH_OK);
        CHECK(bytes_of(again) == own);
        CHECK(std::string(bough_import_notes()).empty());
        for (void* handle : {(void*)at_once, (void*)in_two, (void*)splines, (void*)again}) bough_free(handle);
    }
}

TEST_CASE("a file beside is opened in the folder that is named alone") {
    const std::string folder = std::string(BOUGH_DATA_DIR) + "/fixtures", bytes = data("fixtures/twig_armature.gltf");
    CHECK(import_tree(bytes, "twig.gltf", folder).size_bodies() > 0);
    CHECK_THROWS_WITH(import_tree(bytes, "twig.gltf"), Catch::Matchers::Contains("from memory"));
    CHECK_THROWS_WITH(import_tree(bytes, "twig.gltf", folder + "/.."), Catch::Matchers::Contains("is not beside"));
    bough_tree* tree = nullptr;
    CHECK(bough_import_tree(bytes.data(), bytes.size(), "twig.gltf", folder.c_str(), &tree) == BOUGH_OK);
    bough_free(tree);
}

TEST_CASE("what is cut off, changed or no tree is an error with its name, and outputs stay as they were") {
    bough_tree* const before = reinterpret_cast<bough_tree*>(77);
    for (const char* file : {"fixtures/bare_bones.xml", "fixtures/simpleforest_small.csv", "fixtures/shuffled.swc",
                             "fixtures/eztree_list.json", "fixtures/lines.gltf", "fixtures/shrub.mtg"}) {
        const std::string whole = data(file);
        for (std::size_t k = 0; k < 40; ++k) {
            std::string bytes = whole;
            const std::size_t at = whole.size() * k / 40;
            if (k % 2)
                bytes.resize(at);
            else
                bytes[at] = char(k % 4 ? 0xff : '9');
            bough_tree* tree = before;
            const bough_result result = bough_import_tree(bytes.data(), bytes.size(), "some", nullptr, &tree);
            INFO(file << " " << k << ": " << bough_error());
            if (result == BOUGH_OK) {
                CHECK(bough_free(tree) == BOUGH_OK);
            } else {
                CHECK(result == BOUGH_INPUT);
                CHECK(tree == before);
                CHECK(std::string(bough_error()).starts_with("some"));
            }
        }
    }
    bough_tree* tree = before;
    bough_splines* splines = nullptr;
    refused(bough_import_tree("", 0, nullptr, nullptr, &tree), BOUGH_INPUT, "<memory>");
    refused(bough_import_tree("once upon a time", 16, "tale", nullptr, &tree), BOUGH_INPUT, "tale: ");
    refused(bough_import_tree(nullptr, 4, nullptr, nullptr, &tree), BOUGH_USAGE, "bytes: is NULL");
    refused(bough_import_tree("{}", 2, nullptr, nullptr, nullptr), BOUGH_USAGE, "tree: is NULL");
    refused(bough_import_splines("{}", 2, nullptr, nullptr, nullptr), BOUGH_USAGE, "splines: is NULL");
    refused(bough_import_splines("{}", 2, nullptr, nullptr, &splines), BOUGH_INPUT, "<memory>");
    CHECK(tree == before);
}
