// What is wrong with a SpeedTree file's mesh.
#include "formats/error.h"
#include "formats/models/speedtree_model.h"
#include "tests/support/replaced.h"
#include "tests/support/shown_speedtree.h"
#include "tests/support/speedtree_sample.h"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace bough;
using namespace bough::test;
using Catch::Contains;

namespace {

std::string error_of_mesh(const std::string& content) {
    try {
        shown_of(content);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("What is wrong with a mesh is told in a line with its place") {
    const std::string good = speedtree_sample::file({}, "", speedtree_sample::references(1));
    CHECK(error_of_mesh(good).empty());
    const auto says = [&](const std::string& from, const std::string& to, const std::string& text) {
        const std::string error = error_of_mesh(replaced(good, from, to));
        CAPTURE(from, to);
        CHECK_THAT(error, Contains(text));
        CHECK_THAT(error, Contains("t.xml:"));
        CHECK(error.find('\n') == std::string::npos);
    };
    says("<PointIndices>0 1", "<PointIndices>0 99999", "PointIndices holds \"99999\", expected 0 to 731 (points)");
    says("<PointIndices>0 1", "<PointIndices>0 -1", "PointIndices holds \"-1\"");
    says("<VertexIndices>0 1", "<VertexIndices>0 99999", "VertexIndices holds \"99999\"");
    says("<VertexIndices>0 ", "<VertexIndices>", "VertexIndices holds 4319 values, expected 4320");
    says("<PointIndices>0 1 ", "<PointIndices>0 ", "expected three a triangle");
    says("<QuadIndices>6 ", "<QuadIndices>6000 ", "QuadIndices holds \"6000\"");
    says("Triangles Material=\"7\"", "Triangles Material=\"8\"", "Material 8 does not exist");
    says("LeafReferences Material=\"3\"", "LeafReferences Material=\"8\"", "Material 8 does not exist");
    says("<MeshID>1 1", "<MeshID>1 9", "MeshID 9 does not exist, expected the ID of a Mesh or -1");
    says("<BoneID>0 ", "<BoneID>77 ", "BoneID 77 does not exist");
    says("<NormalX>1 ", "<NormalX>nan ", "NormalX holds \"nan\"");
    says("<NormalX>1 ", "<NormalX>", "holds 793 values, expected 792");
    says("<TexcoordU>0 ", "<TexcoordU>inf ", "TexcoordU holds \"inf\"");
    const std::size_t x = good.find("<Points>"), end = good.find("</Points>");
    std::string none = good;
    none.replace(x, end - x, "<Points><X></X><Y></Y><Z></Z>");
    CHECK_THAT(error_of_mesh(none), Contains("expected none, as there are no points"));
}

TEST_CASE(
    "A point of a mesh beside all of its skeleton is refused with its line, and one of a leaf's mesh beyond 1e15 m") {
    const std::string good = speedtree_sample::file({}, "", speedtree_sample::references(1));
    const auto line_of_first = [&](const std::string& text, const char* found, std::size_t from) {
        const std::size_t at = text.find(found, from);
        return std::to_string(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
    };
    const auto with = [&](const char* list, const std::string& number) {
        std::string text = good;
        const std::size_t x = text.find("<X>", text.find(list)) + 3;
        return text.replace(x, text.find(' ', x) - x, number);
    };
    for (const char* number : {"1e200", "-1e200", "1e38", "1e9"}) {
        const std::string text = with("<Points", number), error = error_of_mesh(text);
        CAPTURE(number, error);
        CHECK_THAT(error,
                   Contains("t.xml:" + line_of_first(text, "<X>", text.find("<Points")) + ": <Points> X holds "));
        CHECK_THAT(error, Contains("expected points near the skeleton"));
    }
    for (const char* number : {"1e200", "1e38"})
        CHECK_THAT(error_of_mesh(with("<Vertices", number)), Contains("expected at most 1e+15 m"));
    CHECK(error_of_mesh(with("<Points", "100")).empty());
}

TEST_CASE("A leaf may name no mesh, or any where the file holds none; the line of another is told") {
    const std::string good = speedtree_sample::file({}, "", speedtree_sample::references(1)),
                      wrong = replaced(good, "<MeshID>1 1", "<MeshID>1 9");
    const std::size_t at = wrong.find("<LeafReferences");
    CHECK_THAT(
        error_of_mesh(wrong),
        Contains("t.xml:" + std::to_string(1 + std::count(wrong.begin(), wrong.begin() + std::ptrdiff_t(at), '\n')) +
                 ": <LeafReferences> MeshID 9"));
    CHECK(error_of_mesh(replaced(good, "<MeshID>1 1", "<MeshID>1 -1")).empty());
    const std::size_t meshes = wrong.find("<Meshes"), end = wrong.find("</Meshes>");
    std::string none = wrong;
    CHECK(error_of_mesh(none.erase(meshes, end + 9 - meshes)).empty());
}
