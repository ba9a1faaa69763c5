// Documents written and read again, in both forms, against what was in memory; and small documents written by hand. Scenes: scene.cpp.
#include "formats/documents/document.h"
#include "formats/documents/material.h"
#include "formats/documents/motion.h"
#include "formats/documents/scene.h"
#include "formats/documents/species.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "lib/growth/grow.h"
#include "tests/support/random_documents.h"
#include <chrono>
#include <clocale>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

using namespace bough;
using namespace bough::test;

namespace {

std::string tree_text(const Tree& tree, Form form) {
    return written([&](Output& o) { write_tree(o, tree, form); });
}
std::string splines_text(const Splines& splines, Form form) {
    return written([&](Output& o) { write_splines(o, splines, form); });
}
std::string motion_text(const Motion& motion, MotionForm form) {
    return written([&](Output& o) {
        MotionWriter writer(o, motion.header, form);
        for (const MotionFrame& frame : motion.frame) writer.write(frame);
        writer.finish();
    });
}

const char* one_body = R"({"format": "bough-tree", "version": 1, "parent": [-1], "mass": [2], "com": [0, 0, 0.5],
"inertia": [0.2, 0.2, 0.01, 0.001, 0.002, 0.003], "joint_position": [1, 2, 3], "joint_rotation": [0, 0.6, 0, 0.8],
"stiffness": [10, 10, 5], "size": [1, 0.1, 0.05], "branch": [0], "level": [0], "s": [0]})";

} // namespace

TEST_CASE("trees come back bit by bit from both forms") {
    Random random;
    for (const std::size_t bodies : {1u, 2u, 57u, 5000u}) {
        const Tree tree = random_tree(bodies, random);
        for (const Form form : {Form::json, Form::safetensors}) {
            const std::string text = tree_text(tree, form);
            CHECK(is_tree(text));
            CHECK_FALSE(is_splines(text));
            CHECK(same(read_tree(text, "t"), tree));
        }
    }
}

TEST_CASE("a tree read from its file is the one read from its content, and in the binary form not wholly in memory") {
    Random random;
    const Folder folder;
    const std::string file = folder / "tree";
    for (const std::size_t bodies : {1u, 57u, 5000u, 10000u}) {
        const Tree tree = random_tree(bodies, random);
        for (const Form form : {Form::json, Form::safetensors}) {
            const std::string text = tree_text(tree, form);
            std::ofstream(file, std::ios::binary) << text;
            const Input input(file);
            CHECK(input.size() == text.size());
            CHECK(input.all() == text);
            CHECK(is_tree(input.content()));
            std::uint64_t header = 0; // as the form has it: its length in 8 bytes, little-endian, and itself
            std::memcpy(&header, text.data(), 8);
            CHECK(input.content() == (form == Form::json ? text : text.substr(0, 8 + header)));
            CHECK(same(read_tree(input), tree));
        }
    }
}

TEST_CASE("what is wrong with a file is said as of its content") {
    Random random;
    const Folder folder;
    const std::string file = folder / "tree";
    const Tree tree = random_tree(300, random);
    const std::string good = tree_text(tree, Form::safetensors);
    const auto swapped = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    std::string infinite = good;
    const double inf = INFINITY; // the last bytes of F64 stand before I32 and U8: 3 and 1 numbers a body
    std::memcpy(infinite.data() + infinite.size() - 300 * (3 * 4 + 1) - 8, &inf, sizeof inf);
    for (const std::string& text :
         {std::string(), std::string("x"), std::string("\x08\0\0\0\0\0\0\0{", 9), good.substr(0, 40),
          good.substr(0, good.size() - 1), good + "x", swapped("\"mass\"", "\"maze\""), swapped("F64", "F32"),
          swapped("bough-tree", "bough-wind"), swapped("\"version\":\"1", "\"version\":\"7"), infinite}) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
        const std::string expected = error_of([&] { read_tree(text, file); });
        CAPTURE(expected);
        CHECK_FALSE(expected.empty());
        CHECK(error_of([&] { read_tree(Input(file)); }) == expected);
    }
    // Cut short once it is open.
    std::ofstream(file, std::ios::binary | std::ios::trunc) << good;
    const Input input(file);
    std::filesystem::resize_file(file, good.size() - 5);
    CHECK_THROWS_WITH(read_tree(input), Catch::Matchers::Contains("was written to while it was read"));
    CHECK_THROWS_AS(Input(folder / "none"), InputError);
    CHECK_THROWS_AS(Input(folder / "."), InputError);
}

TEST_CASE("splines come back bit by bit from both forms") {
    Random random;
    for (const std::size_t branches : {1u, 2u, 900u}) {
        const Splines splines = random_splines(branches, random);
        for (const Form form : {Form::json, Form::safetensors}) {
            const std::string text = splines_text(splines, form);
            CHECK(is_splines(text));
            CHECK(same(read_splines(text, "s"), splines));
        }
    }
}

TEST_CASE("motions come back bit by bit from all three forms") {
    Random random;
    const MotionFields all{true, true, true, true, true}, pose{}, torque{false, false, true, false},
        stress{false, false, false, false, true};
    for (const MotionFields& fields : {all, pose, torque, stress})
        for (const std::int64_t frames : {0, 1, 7})
            for (const std::int64_t bodies : {0, 1, 12}) {
                const Motion motion = random_motion(fields, bodies, frames, random);
                for (const MotionForm form : {MotionForm::jsonl, MotionForm::json, MotionForm::safetensors}) {
                    INFO(frames << " frames of " << bodies << " bodies, form " << int(form));
                    const std::string text = motion_text(motion, form);
                    CHECK(document_format(text) == "bough-motion");
                    CHECK(same(read_motion(text, "m"), motion));
                }
            }
}

TEST_CASE("what of a frame no float can say is named, and what is no number") {
    MotionFrame good;
    good.frame = 3;
    good.position = {Vec3(1, 2, 3), Vec3(0, -3.4e38, 0)};
    good.theta = good.position;
    good.stress = {1, 2};
    CHECK(beyond_floats(good) == "");
    const auto with = [&](const Vec3& value) {
        MotionFrame frame = good;
        frame.theta[1] = value;
        return beyond_floats(frame);
    };
    CHECK(with({0, -1e39, 0}) ==
          "frame 3: the theta of body 1 comes to 1e+39, expected at most 3.4e38, as a float can say");
    CHECK(with({0, 0, INFINITY}).find("the theta of body 1 comes to inf, ") != std::string::npos);
    for (const Vec3& value : {Vec3(1e39, NAN, 0), Vec3(0, NAN, 0), Vec3(NAN, 1e39, 0), Vec3(0, 0, NAN)})
        CHECK(with(value).find("the theta of body 1 comes to nan, ") != std::string::npos);
    for (const double stress : {1e39, -1e39, double(NAN)}) {
        MotionFrame frame = good;
        frame.stress[1] = stress;
        CHECK(beyond_floats(frame).find("frame 3: the stress of body 1 comes to ") == 0);
    }
}

TEST_CASE("a motion as JSON may stand on one line") {
    Random random;
    const Motion motion = random_motion({}, 3, 4, random);
    std::string text = motion_text(motion, MotionForm::json);
    std::replace(text.begin(), text.end(), '\n', ' ');
    CHECK(same(read_motion(text, "m"), motion));
}

TEST_CASE("saved states come back from both forms") {
    Random random;
    SavedState state;
    state.frame = 299;
    state.fps = 59.94;
    state.substeps = 4;
    state.precision = "float";
    state.solver = "articulated-reference";
    state.articulated_step = 0.1 / 3;
    state.fingerprint = 0xfedcba9876543210u;
    state.free_bodies = {0.1 / 3, -1, 1e300};
    for (int i = 0; i < 20; ++i) {
        state.theta.push_back(random.vector());
        state.theta_dot.push_back(random.vector());
        state.scaled_rate.push_back(random.vector());
    }
    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = written([&](Output& o) { write_state(o, state, form); });
        CHECK(is_state(text));
        const SavedState read = read_state(text, "s");
        CHECK(read.frame == state.frame);
        CHECK(same(read.fps, state.fps));
        CHECK(read.substeps == state.substeps);
        CHECK(read.precision == state.precision);
        CHECK(read.solver == state.solver);
        CHECK(read.fingerprint == state.fingerprint);
        CHECK(same(read.theta, state.theta));
        CHECK(same(read.theta_dot, state.theta_dot));
        CHECK(same(read.scaled_rate, state.scaled_rate));
        CHECK(same(read.articulated_step, state.articulated_step));
        CHECK(same(read.free_bodies, state.free_bodies));
        CHECK(read.scheme.empty());
        CHECK(read.theta_change.empty());
        CHECK(read.theta_dot_change.empty());
    }
    // The coupled solver carries its last changes instead.
    state.solver = "coupled";
    state.scheme = "P.25";
    state.articulated_step = 0;
    state.theta_change = state.scaled_rate;
    state.scaled_rate.clear();
    for (std::size_t i = 0; i < state.theta.size(); ++i) state.theta_dot_change.push_back(random.vector());
    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = written([&](Output& o) { write_state(o, state, form); });
        CHECK(text.find("scaled_rate") == std::string::npos);
        const SavedState read = read_state(text, "s");
        CHECK(read.solver == state.solver);
        CHECK(read.scheme == state.scheme);
        CHECK(same(read.theta, state.theta));
        CHECK(same(read.theta_dot, state.theta_dot));
        CHECK(same(read.theta_change, state.theta_change));
        CHECK(same(read.theta_dot_change, state.theta_dot_change));
        CHECK(read.scaled_rate.empty());
    }
}

TEST_CASE("rigid bodies come back from both forms, and are left out where there are none") {
    Random random;
    Tree tree = random_tree(5000, random);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) tree.rigid.push_back(std::uint8_t(random.below(2)));
    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = written([&](Output& o) { write_tree(o, tree, form); });
        const Tree read = read_tree(text, "t");
        CHECK(read.rigid == tree.rigid);
        CHECK(same(read, tree));
    }
    tree.rigid.clear();
    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = written([&](Output& o) { write_tree(o, tree, form); });
        CHECK(text.find("rigid") == std::string::npos);
        CHECK(read_tree(text, "t").rigid.empty());
    }
}

TEST_CASE("a tree written by hand is read as it says") {
    const Tree tree = read_tree(one_body, "t");
    REQUIRE(tree.size_bodies() == 1);
    CHECK(tree.kind[0] == Kind::branch);
    CHECK(tree.damping[0] == 0);
    CHECK(tree.joint_rotation[0].y() == 0.6);
    CHECK(tree.joint_rotation[0].w() == 0.8);
    CHECK(tree.inertia[0](2, 2) == 0.01);
    CHECK(tree.inertia[0](0, 1) == 0.001);
    CHECK(tree.inertia[0](2, 0) == 0.002);
    CHECK(tree.inertia[0](1, 2) == 0.003);
    CHECK(same(read_tree(std::string("\xef\xbb\xbf \r\n") + one_body, "t"), tree)); // as Windows programs save it
}

TEST_CASE("content decides which form it is") {
    Random random;
    const Tree tree = random_tree(3, random);
    const std::string indented = "        " + tree_text(tree, Form::json); // '{' where a safetensors header has it
    CHECK(is_tree(indented));
    CHECK(same(read_tree(indented, "t.safetensors"), tree));
    for (const char* other :
         {"", "{", "<xml/>", "{}", "[]", "{\"format\": 3}", "{\"a\": {\"format\": \"bough-tree\"}}"})
        CHECK_FALSE(is_tree(other));
}

TEST_CASE("numbers do not depend on the locale") {
    const char* old = std::setlocale(LC_ALL, nullptr);
    const std::string before = old;
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name)) break;
    Random random;
    const Tree tree = random_tree(20, random);
    const std::string text = tree_text(tree, Form::json);
    const bool equal = same(read_tree(text, "t"), tree);
    if (std::string(std::setlocale(LC_ALL, nullptr)) == before) WARN("no locale with a decimal comma is installed");
    std::setlocale(LC_ALL, before.c_str());
    CHECK(equal);
    CHECK(text == tree_text(tree, Form::json));
}

TEST_CASE("what cannot be read again is not written") {
    Random random;
    Tree tree = random_tree(3, random);
    tree.com[1].y() = std::numeric_limits<double>::quiet_NaN();
    for (const Form form : {Form::json, Form::safetensors}) {
        const Folder folder;
        Output output(folder / "t");
        CHECK_THROWS_WITH(write_tree(output, tree, form), Catch::Contains("/com/4") && Catch::Contains("not finite"));
    }
}

TEST_CASE("the examples of the pages on documents and parameters are documents") {
    const std::string page = read_input(BOUGH_DATA_DIR "/../formats/documents/README.md") +
                             read_input(BOUGH_DATA_DIR "/../formats/parameters/README.md");
    std::size_t examples = 0;
    for (std::size_t at = page.find("\n    {\"format\""); at != std::string::npos;
         at = page.find("\n    {\"format\"", at)) {
        std::string text;
        for (std::size_t line = at + 1; page.compare(line, 4, "    ") == 0; line = at + 1) {
            at = page.find('\n', line);
            text += page.substr(line + 4, at + 1 - line - 4);
        }
        INFO(text);
        ++examples;
        if (is_splines(text))
            CHECK_NOTHROW(read_splines(text, "README.md"));
        else if (is_tree(text))
            CHECK_NOTHROW(read_tree(text, "README.md"));
        else if (is_scene(text))
            CHECK_NOTHROW(read_scene_document(text, "README.md"));
        else if (document_format(text) == "bough-motion")
            CHECK(read_motion(text, "README.md").frame.size() == 1);
        else if (is_state(text))
            CHECK_NOTHROW(read_state(text, "README.md"));
        else if (document_format(text) == "bough-material")
            CHECK_NOTHROW(read_material(text, "README.md"));
        else if (is_species(text))
            CHECK_NOTHROW(grow(read_species(text, "README.md").growth, 1, {true, true, true}));
        else
            CHECK_NOTHROW(read_wind(text, "README.md"));
    }
    CHECK(examples == 16);
}

TEST_CASE("a motion's JSON is written with the digits asked for") {
    MotionHeader header;
    header.bodies = 500;
    MotionFrame frame;
    std::mt19937_64 random(3);
    for (int k = 0; k < header.bodies; ++k) {
        const auto number = [&] { return std::ldexp(double(random() % 2000001) - 1e6, -int(random() % 60)); };
        frame.position.push_back({number(), number(), number()});
        frame.rotation.push_back(Quat(number(), number(), number(), number()).normalized());
    }
    const auto read_with = [&](const Digits& digits) {
        const std::string text = written([&](Output& o) {
            MotionWriter writer(o, header, MotionForm::jsonl, digits);
            writer.write(frame);
            writer.finish();
        });
        return read_motion(text, "f").frame.at(0);
    };
    const MotionFrame single = read_with({true, 0}), six = read_with({false, 6}), all = read_with({});
    for (std::size_t k = 0; k < frame.position.size(); ++k)
        for (int j = 0; j < 3; ++j) {
            const double value = frame.position[k][j];
            CHECK(all.position[k][j] == value);
            CHECK(float(single.position[k][j]) == float(value)); // the same float, and the shortest text of it:
            char text[40];
            std::snprintf(text, sizeof text, "%.9g", value);
            CHECK(std::abs(single.position[k][j] - value) <= std::abs(std::strtod(text, nullptr)) * 6e-8);
            std::snprintf(text, sizeof text, "%.6g", value);
            CHECK(six.position[k][j] == std::strtod(text, nullptr));
        }
}
