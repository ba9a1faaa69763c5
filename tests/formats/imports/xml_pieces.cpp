#include "formats/imports/xml_pieces.h"
#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

namespace {

std::string text_of(const std::string& content, const XmlPiece& piece) {
    return content.substr(piece.begin, piece.end - piece.begin);
}

} // namespace

TEST_CASE("an XML file is cut between children of the root's children") {
    const std::string file =
        "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <r> -->\n<r a='>'>\n <b n=\"/>\">text<c/> <c x='\"'>"
        "<c></c></c ><!-- <d> --><d><![CDATA[</d>]]></d></b>\n <e/>\n <f><c><g/></c></f></r>\n<!-- -->\n";
    const auto pieces = cut_xml(file, 1);
    REQUIRE(pieces);
    CHECK(text_of(file, pieces->root_tag) == "<r a='>'>");
    REQUIRE(pieces->section.size() == 3);
    CHECK(pieces->section[0].name == "b");
    CHECK(text_of(file, pieces->section[0].tag) == "<b n=\"/>\">");
    REQUIRE(pieces->section[0].piece.size() == 3);
    CHECK(text_of(file, pieces->section[0].piece[0]) == "<c/>");
    CHECK(text_of(file, pieces->section[0].piece[1]) == "<c x='\"'><c></c></c >");
    CHECK(text_of(file, pieces->section[0].piece[2]) == "<d><![CDATA[</d>]]></d>");
    CHECK(pieces->section[1].name == "e");
    CHECK(text_of(file, pieces->section[1].tag) == "<e/>");
    CHECK(pieces->section[1].piece.empty());
    CHECK(text_of(file, pieces->section[2].piece.at(0)) == "<c><g/></c>");
    // Pieces that hold more children hold what stands between them.
    const auto large = cut_xml(file, 1000);
    REQUIRE(large);
    REQUIRE(large->section[0].piece.size() == 1);
    CHECK(text_of(file, large->section[0].piece[0]) ==
          "<c/> <c x='\"'><c></c></c ><!-- <d> --><d><![CDATA[</d>]]></d>");
    const auto pairs = cut_xml(file, 6);
    REQUIRE(pairs);
    CHECK(pairs->section[0].piece.size() == 2);
}

TEST_CASE("what cannot be cut is said to be so") {
    for (const char* wrong : {"", " ", "<r>", "<r></s>", "<r><b></r></b>", "<r/><r/>", "<r/> x", "x <r/>", "<r",
                              "<r a='>", "<r><!-- </r>", "<r></r", "</r>", "<r></r></r>", "<!DOCTYPE r><r/>",
                              "<r><![CDATA[</r>", "<?xml <r/>", "<r><b <c/></b></r>", "< r/>"})
        CHECK_FALSE(cut_xml(wrong, 1));
    CHECK_FALSE(cut_xml(std::string("<r>\0</r>", 8), 1));
    CHECK(cut_xml("<r/>", 1));
    CHECK(cut_xml("<r></r>", 1));
}

TEST_CASE("a SpeedTree file of many pieces is read as one of few, with the lines of its errors") {
    // The same bones with and without a document type, which is not cut.
    std::string bones;
    for (int i = 0; i < 5000; ++i)
        bones += "<Bone ID=\"" + std::to_string(i) + "\" ParentID=\"" + std::to_string(i / 3 - (i < 3)) +
                 "\" Radius=\"" + std::to_string(1.0 / (i + 1)) + "\" StartX=\"" + std::to_string(i) +
                 "\" StartY=\"0\" StartZ=\"" + std::to_string(i / 3) + "\" EndX=\"1\" EndY=\"" + std::to_string(i) +
                 "\" EndZ=\"2\" Generator=\"a &amp; b\"/>\n";
    const std::string tree =
        "<SpeedTreeRaw units=\"m\">\n<Other><x>1</x></Other><Bones Count=\"5000\">" + bones + "</Bones></SpeedTreeRaw>";
    const Splines cut = imported(tree, "a.xml").splines;
    const Splines whole = imported("<!DOCTYPE SpeedTreeRaw>" + tree, "a.xml").splines;
    CHECK(cut.branches() > 100);
    CHECK(cut.parent == whole.parent);
    CHECK(cut.parent_at == whole.parent_at);
    CHECK(cut.point == whole.point);
    CHECK(cut.radius == whole.radius);
    const auto both = [&](const std::string& from, const std::string& to, const std::string& message) {
        const std::string wrong = replaced(tree, from, to);
        CHECK(error_of(wrong, "a.xml") == message);
        CHECK(error_of("<!DOCTYPE SpeedTreeRaw>" + wrong, "a.xml") == message);
    };
    both("ID=\"4999\"", "ID=\"12\"", "a.xml:5001: <Bone> ID 12 is used twice, expected each once");
    both("ParentID=\"1600\"", "ParentID=\"9999\"",
         "a.xml:4802: <Bone> ParentID 9999 does not exist, expected the ID of another or -1");
    both("Count=\"5000\"", "Count=\"1\"", "a.xml:2: <Bones> says Count 1 but holds 5000");
    both("StartX=\"4000\"", "StartX=\"x\"", "a.xml:4002: <Bone> StartX is \"x\", expected a finite number");
    both("units=\"m\"", "units=\"ell\"", "a.xml:1: <SpeedTreeRaw> units is \"ell\", expected m, cm, mm, in or ft");
    // Broken within a tag, in what is read and in what is not.
    for (const char* place : {"ID=\"4500\"", "<x>"}) {
        const std::string wrong = replaced(tree, place, std::string(place) == "<x>" ? "<x y>" : "ID=4500");
        CHECK(error_of(wrong, "a.xml") == error_of("<!DOCTYPE SpeedTreeRaw>" + wrong, "a.xml"));
        CHECK(error_of(wrong, "a.xml").find("XML is broken") != std::string::npos);
    }
}
