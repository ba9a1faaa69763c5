// collada_check.h: a whole file passes; each number made wrong by hand is named with its place.
#include "formats/models/collada_check.h"
#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

namespace {

std::string refusal(const std::string& content) {
    try {
        check_collada(content);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

// Two vertices and a triangle of three, moved by one joint.
const std::string whole = R"(<?xml version="1.0"?><COLLADA><library_geometries><geometry id="bark"><mesh>
<source id="at"><float_array id="at-array" count="9">0 0 0 1 0 0 <!-- the third --> 0 1 0</float_array>
<technique_common><accessor source="#at-array" count="3" stride="3"/></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#at"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#corners" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries><library_controllers><controller id="arm"><skin source="#bark">
<source id="names"><Name_array id="n" count="1">stem</Name_array><technique_common><accessor count="1"/></technique_common></source>
<source id="shares"><float_array id="w" count="1">1</float_array><technique_common><accessor count="1"/></technique_common></source>
<vertex_weights count="3"><input semantic="JOINT" source="#names" offset="0"/><input semantic="WEIGHT" source="#shares" offset="1"/>
<vcount>1 1 1</vcount><v>0 0 -1 0 0 0</v></vertex_weights></skin></controller></library_controllers></COLLADA>)";

std::string with(const std::string& part, const std::string& other) {
    std::string text = whole;
    const std::size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    return text.replace(at, part.size(), other);
}

} // namespace

TEST_CASE("COLLADA files that are whole pass, and what is no COLLADA is left to its reader") {
    CHECK(refusal(whole) == "");
    for (const char* name : {"twig_joints.dae", "two_armatures.dae", "moved_armature.dae"})
        CHECK(refusal(fixture(name)) == "");
    CHECK(refusal(whole.substr(0, 300)) == "");
    CHECK(refusal("") == "");
}

TEST_CASE("a COLLADA node that holds itself, or others without end, is named") {
    const auto nodes = [](const std::string& inside) {
        return with("</library_controllers>", "</library_controllers><library_nodes>" + inside + "</library_nodes>");
    };
    const auto node = [](const std::string& id, const std::string& inside) {
        return "<node id=\"" + id + "\">" + inside + "</node>";
    };
    const auto instance = [](const std::string& id) { return "<instance_node url=\"#" + id + "\"/>"; };
    CHECK(refusal(nodes(node("a", instance("b")) + node("b", node("c", "")))) == "");
    CHECK(refusal(nodes(node("a", instance("gone")))) == "");
    // Another file's node, or none, is no node of this one that has no id.
    for (const char* url : {"other.dae#x", "#", ""})
        CHECK(refusal(nodes("<node>" + node("a", std::string("<instance_node url=\"") + url + "\"/>") + "</node>")) ==
              "");
    CHECK(refusal(nodes("<node name=\"a\"><instance_node url=\"#a\"/></node>")).find("holds itself") !=
          std::string::npos);
    CHECK(refusal(nodes(node("a", instance("a")))) == "node \"a\" holds itself, by <instance_node>");
    CHECK(refusal(nodes(node("a", "") + node("b", node("c", instance("b"))))) ==
          "node \"b\" holds itself, by <instance_node>");
    CHECK(refusal(nodes(node("a", instance("b")) + node("b", "<node>" + instance("b") + "</node>"))) ==
          "node \"b\" holds itself, by <instance_node>");
    std::string doubled = node("n0", ""), deep;
    for (int k = 1; k < 40; ++k)
        doubled += node("n" + std::to_string(k),
                        instance("n" + std::to_string(k - 1)) + instance("n" + std::to_string(k - 1)));
    CHECK(refusal(nodes(doubled)).find("has more than 1000000 nodes in it") != std::string::npos);
    for (int k = 0; k < 20000; ++k) deep += "<node>";
    for (int k = 0; k < 20000; ++k) deep += "</node>";
    CHECK(refusal(nodes(deep)) == "");
}

TEST_CASE("COLLADA indices and numbers that are out of range are named with their place") {
    CHECK(refusal(with("<p>0 1 2", "<p>0 1 3")) ==
          "geometry \"bark\": <triangles> names VERTEX 3, expected 0 to less than 3");
    CHECK(refusal(with("<p>0 1 2", "<p>0 -1 2")) ==
          "geometry \"bark\": <triangles> names VERTEX -1, expected 0 to less than 3");
    CHECK(refusal(with("<p>0 1 2", "<p>0 one 2")) == "geometry \"bark\": <p> holds \"one\", expected a whole number");
    CHECK(refusal(with("0 0 0 1 0 0", "0 0 0 NaN 0 0")) ==
          "geometry \"bark\": float_array \"at-array\" holds \"NaN\" as number 3, expected a finite number");
    CHECK(refusal(with("0 0 0 1 0 0", "0 0 0 1e999 0 0")) ==
          "geometry \"bark\": float_array \"at-array\" holds \"1e999\" as number 3, expected a finite number");
    CHECK(refusal(with("count=\"9\">0 0 0 1 0 0", "count=\"9\">")) ==
          "geometry \"bark\": float_array \"at-array\" has 3 numbers, expected the 9 that its count says");
    CHECK(refusal(with("count=\"3\" stride=\"3\"", "count=\"9000000000000\" stride=\"9000000000000\"")) ==
          "geometry \"bark\": float_array \"at-array\" has 9 numbers, expected the 4611686018427387904 that its count "
          "says");
    CHECK(refusal(with("count=\"3\" stride=\"3\"", "count=\"0\" stride=\"3\"")) ==
          "geometry \"bark\": has no vertices, but <triangles> of them");
    CHECK(refusal(with("<v>0 0", "<v>1 0")) ==
          "controller \"arm\": <vertex_weights> names JOINT 1, expected 0 to less than 1");
    CHECK(refusal(with("<v>0 0", "<v>0 5")) ==
          "controller \"arm\": <vertex_weights> names WEIGHT 5, expected 0 to less than 1");
    CHECK(refusal(with("<vcount>1 1 1", "<vcount>1 1 7")) ==
          "controller \"arm\": <vcount> takes 18 numbers of <v>, which has 6");
    CHECK(refusal(with("<vcount>1 1 1", "<vcount>1 1 -7")) ==
          "controller \"arm\": <vcount> holds -7, expected 0 or more");
    CHECK(refusal(with("count=\"1\">1</float_array>", "count=\"1\">inf</float_array>")) ==
          "controller \"arm\": float_array \"w\" holds \"inf\" as number 0, expected a finite number");
}
