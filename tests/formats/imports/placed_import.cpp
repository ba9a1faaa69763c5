// Where an imported tree stands, and what is refused of it.
#include "formats/imports/placed_import.h"
#include "tests/support/import_support.h"

using namespace bough;
using namespace bough::test;

namespace {

// A trunk of n points 0.1 m apart, one of which is moved `aside` [m].
std::string trunk(int n, int moved, double aside) {
    std::ostringstream swc;
    swc.precision(17);
    for (int k = 0; k < n; ++k)
        swc << k + 1 << " 2 " << (k == moved ? aside : 0) << " 0 " << 0.1 * k << " 0.05 " << (k == 0 ? -1 : k) << "\n";
    return swc.str();
}

std::string error_with(const std::string& content, ImportNotes&& notes = {}) {
    ImportOptions options;
    options.name = "t.swc";
    options.unit = 1;
    options.up = 'z';
    try {
        import_splines(content, options, notes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("one coordinate far off is a slip, which is named with its place") {
    // Of 41 points 20 are within 1 m of the middle, 2 m up, and one is aside.
    const std::string error = error_with(trunk(41, 17, 1e9));
    CHECK(error.find("t.swc: a point of branch 0 is at 1e+09, 1.7, 0 m") == 0);
    CHECK(error.find("1e+09 m from the middle of the tree, half of which is within 1.1 m") != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
    CHECK(error_with(trunk(41, 17, -20'000)) != "");
    CHECK(error_with(trunk(41, 17, 5'000)) == ""); // far, as a root's survey point or an axon may be
    CHECK(error_with(trunk(41, 17, 0)) == "");
    CHECK(error_with(trunk(2, 1, 1e6)) == ""); // of so few none is the odd one
}

TEST_CASE("a point far off is noted where it may be meant, and not in a tree of usual shape") {
    const auto noted = [](double aside) {
        ImportNotes notes;
        CHECK(error_with(trunk(41, 17, aside), std::move(notes)) == "");
        return std::any_of(notes.lines.begin(), notes.lines.end(), [](const std::string& line) {
            return line.find("a point of branch 0 is at ") == 0 && line.ends_with("is it a slip?");
        });
    };
    CHECK(noted(5'000));
    CHECK(noted(120));
    CHECK_FALSE(noted(100)); // of 1.1 m
    CHECK_FALSE(noted(0));
}

TEST_CASE("a leaf or a fruit far off, or larger than its tree, is a slip too") {
    const std::string maple = content_of(std::string(BOUGH_DATA_DIR) + "/young_maple.xml");
    const auto with = [&](const std::string& element, const std::string& number) {
        const std::size_t leaf = maple.find("<LeafReferences");
        REQUIRE(leaf != std::string::npos);
        const std::size_t begin = maple.find('>', maple.find("<" + element, leaf)) + 1,
                          end = maple.find_first_of(" <", begin);
        std::string broken = maple;
        broken.replace(begin, end - begin, number);
        ImportOptions options;
        options.name = "m.xml";
        ImportNotes notes;
        std::string error;
        try {
            import_splines(broken, options, notes);
        } catch (const InputError& wrong) {
            error = wrong.what();
        }
        for (const std::string& line : notes.lines)
            if (line.ends_with("is it a slip?")) error += "noted: " + line;
        return error;
    };
    CHECK(with("X", "1e12").find("m.xml: leaf 0 is at ") == 0);
    CHECK(with("X", "1e5").find("noted: leaf 0 is at ") == 0);
    CHECK(with("X", "20").empty());
    CHECK(with("Scale", "1e12").find("m.xml: the length of leaf 0 is 1e+10 m in a tree that is 4.186 m large") == 0);
    CHECK(with("Scale", "40").empty());
}

TEST_CASE("one coordinate of a SpeedTree file far off is refused, wherever it stands") {
    const std::string maple = content_of(std::string(BOUGH_DATA_DIR) + "/young_maple.xml");
    std::size_t spine = 0;
    int tried = 0;
    for (const char* list : {"<X", "<Y", "<Z"}) {
        spine = maple.find("<Spine");
        if (spine == std::string::npos) return;
        const std::size_t begin = maple.find('>', maple.find(list, spine)) + 1, end = maple.find_first_of(" <", begin);
        std::string broken = maple;
        broken.replace(begin, end - begin, "1e12");
        ImportOptions options;
        options.name = "m.xml";
        ImportNotes notes;
        CHECK_THROWS_WITH(import_splines(broken, options, notes), Catch::Contains("m.xml: a point of branch "));
        ++tried;
    }
    CHECK(tried == 3);
}

TEST_CASE("a radius beyond the tree's extent is refused with its branch and place, and noted before that") {
    const auto thick = [](const std::string& radius) {
        return replaced(trunk(41, 0, 0), "0 0 2 0.05", "0 0 2 " + radius);
    };
    CHECK(error_with(thick("50")) ==
          "t.swc: the radius of branch 0 at 0, 2, 0 m (x, y up, z) is 50 m in a tree that is 4 large, with "
          "a median radius of 0.05; expected less than the tree is large");
    CHECK(error_with(thick("3")) == "");
    const auto noted = [&](const std::string& radius) {
        return imported(thick(radius), "t.swc", {}, true).notes_hold("is it a slip?");
    };
    CHECK(noted("3"));
    CHECK(noted("1.1"));
    CHECK_FALSE(noted("0.9"));
}

TEST_CASE("a trunk that begins above the lowest is told, and so is a foot that stays below the ground") {
    const auto two = [](double rise) {
        std::ostringstream swc;
        for (int k = 0; k < 2; ++k)
            swc << 2 * k + 1 << " 2 " << 30 * k << " 0 " << rise * k << " 0.1 -1\n"
                << 2 * k + 2 << " 2 " << 30 * k << " 0 " << 20 + rise * k << " 0.1 " << 2 * k + 1 << "\n";
        return swc.str();
    };
    const auto told = [](const std::string& swc, bool on_ground, const std::string& text) {
        ImportOptions options;
        options.unit = 1;
        options.up = 'z';
        return imported(swc, "t.swc", options, on_ground).notes_hold(text);
    };
    const std::string above = "the highest of its 2 trunks begins 4 m above the lowest";
    CHECK(told(two(4), true, above));
    CHECK(told(two(-4), true, above));
    CHECK_FALSE(told(two(0.4), true, "above the lowest"));
    CHECK_FALSE(told(two(4), false, "above the lowest"));
    CHECK(told(two(-4), false, "its foot is 4 m below the ground, y = 0, under which no wind blows (--keep-place)"));
    CHECK_FALSE(told(two(4), false, "below the ground"));
    CHECK_FALSE(told(two(-4), true, "below the ground"));
}
