// each_array() goes over all that a tree has of its bodies. An array that Tree has and each_array() leaves out would be lost where trees
// are joined or cut.
#include "lib/model/tree_arrays.h"
#include "formats/documents/tree.h"
#include "tests/support/random_documents.h"
#include <set>

using namespace bough;
using namespace bough::test;

TEST_CASE("each of a tree's arrays is gone over, and once") {
    const Tree tree;
    std::set<const void*> arrays;
    std::size_t bytes = 0;
    each_array(
        [&](const char* name, const auto&, const auto& array) {
            INFO(name);
            CHECK(arrays.insert(&array).second);
            bytes += sizeof array;
        },
        tree);
    const std::size_t labels = sizeof tree.name + sizeof tree.material + sizeof tree.source + sizeof tree.color;
    CHECK(bytes + labels == sizeof tree); // else Tree has an array that each_array() leaves out, or another label
}

TEST_CASE("a tree's arrays have the names of the document's fields") {
    Random random;
    Tree tree = random_tree(4, random);
    tree.rigid = {0, 1, 0, 1};
    tree.load = {0, 1, 0, 0};
    const std::string text = written([&](Output& to) { write_tree(to, tree, Form::json); });
    each_array(
        [&](const char* name, const auto& absent, const auto& array) {
            INFO(name);
            CHECK(array.size() == 4);
            const bool stands = text.find("\"" + std::string(name) + "\":") != std::string::npos;
            CHECK(stands != std::is_same_v<std::decay_t<decltype(absent)>, InNoDocument>);
        },
        tree);
}
