#include "tests/support/import_support.h"
#include <bit>
#include <cstring>

using namespace bough;
using namespace bough::test;

namespace {

const char* const points[] = {"0 0 0 0.2", "0 0 2 0.1", "0 0 3 0.05", "0 0 2 0.06", "1 0 3 0.04"};

std::string ascii() {
    std::string text = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 5\nproperty float x\nproperty float y\n"
                       "property float z\nproperty float radius\nelement edge 3\nproperty int vertex1\nproperty int "
                       "vertex2\nend_header\n";
    for (const char* p : points) text += std::string(p) + "\n";
    return text + "1 0\n1 2\n4 3\n";
}

template <class T> void put(std::string& to, T value, bool big) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
    to.append(bytes, sizeof(T));
}

// The same tree with other types and an order of its own: edges first and as lists, z before x, a colour and a normal
// list between, the diameter for the radius.
std::string binary(bool big) {
    std::string text =
        std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\r\nelement edge 2\r\nproperty uchar red\r\nproperty list uint16 short vertex_index\r\n"
        "element Vertex 5\r\nproperty double z\r\nproperty uchar r\r\nproperty uchar g\r\n"
        "property list uchar float normal\r\nproperty double x\r\nproperty float64 y\r\n"
        "property float diameter\r\nend_header\r\n";
    for (const std::vector<int>& line : {std::vector<int>{2, 1, 0}, {3, 4}}) {
        put(text, std::uint8_t(255), big);
        put(text, std::uint16_t(line.size()), big);
        for (const int i : line) put(text, std::int16_t(i), big);
    }
    for (const char* p : points) {
        std::istringstream numbers(p);
        double x, y, z, radius;
        numbers >> x >> y >> z >> radius;
        put(text, z, big);
        put(text, std::uint8_t(200), big);
        put(text, std::uint8_t(100), big);
        put(text, std::uint8_t(2), big);
        put(text, 0.5f, big);
        put(text, 0.25f, big);
        put(text, x, big);
        put(text, y, big);
        put(text, float(2 * radius), big);
    }
    return text;
}

void is_the_fork(const Imported& in) {
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 2);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0});
    CHECK(total_length(s) == Approx(3 + std::sqrt(2.0)));
    CHECK(s.parent_at[1] == Approx(2.0 / 3));
    CHECK(near(s.point[2], {0, 3, 0})); // Z is up
    CHECK(s.radius[0] == Approx(0.2));
    CHECK(s.radius[1] == Approx(0.1)); // the thicker of the two at that place
    CHECK(s.radius[2] == Approx(0.05));
    CHECK(in.notes_hold("1 point welded"));
}

} // namespace

TEST_CASE("a PLY skeleton in text and in both binary forms, with other types, names and orders") {
    is_the_fork(imported(ascii(), "x.ply"));
    const Imported little = imported(binary(false), "x.ply");
    is_the_fork(little);
    CHECK(little.notes_hold("half of the vertices' \"diameter\""));
    is_the_fork(imported(binary(true), "x.ply"));
    std::string cr = ascii(); // old Mac programs; in a binary file only the header has lines
    std::replace(cr.begin(), cr.end(), '\n', '\r');
    is_the_fork(imported(cr, "x.ply"));
    for (const bool big : {false, true}) {
        std::string bytes = binary(big);
        const std::size_t data = bytes.find("end_header\r\n") + 12;
        bytes.erase(std::remove(bytes.begin(), bytes.begin() + std::ptrdiff_t(data), '\n'),
                    bytes.begin() + std::ptrdiff_t(data));
        is_the_fork(imported(bytes, "x.ply"));
    }
    std::string crlf;
    for (const char c : ascii()) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    is_the_fork(imported(crlf, "x.ply"));
    // Edges as faces of two corners.
    std::string faces = replaced(ascii(), "element edge 3\nproperty int vertex1\nproperty int vertex2",
                                 "element face 3\nproperty list uchar int vertex_indices");
    faces.replace(faces.find("1 0\n1 2\n4 3\n"), std::string::npos, "2 1 0\n2 1 2\n2 4 3\n");
    is_the_fork(imported(faces, "x.ply"));
}

TEST_CASE("a PLY without radii gets them by the pipe rule") {
    const Imported in = imported(replaced(ascii(), "radius", "quality"), "x.ply");
    CHECK(in.notes_hold("filled by the pipe rule"));
    // The longest way is 2 + sqrt 2, two tips.
    CHECK(in.splines.radius[0] == Approx((2 + std::sqrt(2.0)) / 68));
    CHECK(in.splines.radius[2] == Approx((2 + std::sqrt(2.0)) / 68 / std::pow(2, 1 / 2.25)));
}

TEST_CASE("PLY files without a skeleton are refused with advice, wrong ones with their place") {
    const std::string good = ascii();
    const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
        const std::string error = error_of(replaced(good, from, to), "x.ply");
        INFO(error);
        CHECK(error.find(message) == 0);
    };
    refused("int vertex1", "int corner", "x.ply: has element \"edge\" without a list of vertices or a pair");
    refused("element edge 3", "element bone 3", "x.ply: is a cloud of 5 points without edges");
    refused("float x", "float u", "x.ply: has vertices without x, y or z");
    refused("ascii", "text", "x.ply:2: format \"text\"");
    refused("float z", "real z", "x.ply:7: \"real\" is no type");
    refused("vertex 5", "vertex 50000", "x.ply: names 50000 of element");
    refused("vertex 5", "vertex -1", "x.ply:4: element without a count");
    refused("1 0\n", "1 5\n", "x.ply:18: edge 0 names vertex 5, expected 0 to 4");
    refused("0 0 3 0.05", "0 0 3 wide", "x.ply:15: \"wide\" is no finite number at vertex 2 of 5");
    refused("1 2\n4 3\n", "1 2\n4\n", "x.ply:21: ends early at edge 2 of 3");
    refused("end_header", "endheader", "x.ply:12: \"endheader\" is no line of a PLY header");
    std::string mesh = replaced(good, "element edge 3\nproperty int vertex1\nproperty int vertex2",
                                "element face 1\nproperty list uchar int vertex_indices");
    mesh.replace(mesh.find("1 0\n1 2\n4 3\n"), std::string::npos, "3 0 1 2\n");
    CHECK(error_of(mesh, "x.ply").find("x.ply: is a mesh of 1 face ") == 0);
    std::string cut = binary(false);
    cut.pop_back();
    CHECK(error_of(cut, "x.ply").find("x.ply: ends early at Vertex 4 of 5") == 0);
}

TEST_CASE("damaged PLY files are read or refused in one line") {
    damage(ascii(), "damaged.ply", 1);
    damage(binary(false), "damaged.ply", 1);
}

TEST_CASE("AdTree's skeleton: one tree, its length, height and radii as another reading finds them") {
    const auto content = foreign_case("skeleton/adtree_tree1_skeleton.ply");
    if (!content) return;
    // By a script in Python (struct.unpack): 14805 distinct places, 14804 distinct lines in one component without a
    // circle; 2509 places with one line, 2507 lines more than two at forks, so 2508 branches.
    const Imported in = imported(*content, "tree1.ply");
    const Splines& s = in.splines;
    CHECK(s.branches() == 2508);
    CHECK(std::count(s.parent.begin(), s.parent.end(), -1) == 1);
    CHECK(total_length(s) == Approx(320.673467).epsilon(1e-8));
    CHECK(top_of(s) == 4.369999885559082);
    CHECK(near(s.point[0], {-0.6833775043487549, -1.162743330001831, -18.1905460357666}, 1e-12));
    CHECK(s.radius[0] == 0.11749997735023499);
    CHECK(*std::max_element(s.radius.begin(), s.radius.end()) == s.radius[0]);
    CHECK(in.notes_hold("2507 points welded"));
    CHECK_FALSE(in.notes_hold("loose"));
}
