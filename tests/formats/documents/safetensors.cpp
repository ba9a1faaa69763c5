// The binary form against readers that share no code with ours: a few lines here, and numpy in tests/formats/documents/safetensors.cpp.py.
#include "formats/documents/motion.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "tests/support/random_documents.h"
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace bough;
using namespace bough::test;

namespace {

// What safetensors' own description says of the layout, and no more.
struct Layout {
    nlohmann::json header;
    std::string data;
    explicit Layout(const std::string& file) {
        std::uint64_t length = 0;
        for (std::size_t i = 8; i-- > 0;) length = length * 256 + static_cast<unsigned char>(file[i]);
        header = nlohmann::json::parse(file.substr(8, length));
        data = file.substr(8 + length);
        CHECK(length % 8 == 0);
    }
    template <class T> T number(const std::string& name, std::size_t index) const {
        const std::size_t begin = header[name]["data_offsets"][0].get<std::size_t>();
        CHECK(begin % sizeof(T) == 0);
        T value;
        std::memcpy(&value, data.data() + begin + index * sizeof(T), sizeof(T));
        return value;
    }
};

} // namespace

TEST_CASE("a tree as safetensors is what the layout says") {
    Random random;
    const Tree tree = random_tree(33, random);
    const Layout file(written([&](Output& o) { write_tree(o, tree, Form::safetensors); }));
    CHECK(file.header["__metadata__"]["format"] == "bough-tree");
    CHECK(file.header["__metadata__"]["version"] == "1");
    CHECK(file.header["__metadata__"]["name"] == tree.name);
    CHECK(file.header["mass"]["dtype"] == "F64");
    CHECK(file.header["mass"]["shape"] == nlohmann::json({33}));
    CHECK(file.header["inertia"]["shape"] == nlohmann::json({33, 6}));
    CHECK(file.header["joint_rotation"]["shape"] == nlohmann::json({33, 4}));
    CHECK(file.header["parent"]["dtype"] == "I32");
    CHECK(file.header["kind"]["dtype"] == "U8");
    for (std::size_t i = 0; i < 33; ++i) {
        CHECK(same(file.number<double>("mass", i), tree.mass[i]));
        CHECK(same(file.number<double>("com", 3 * i + 1), tree.com[i].y()));
        CHECK(same(file.number<double>("joint_rotation", 4 * i), tree.joint_rotation[i].x()));
        CHECK(same(file.number<double>("joint_rotation", 4 * i + 3), tree.joint_rotation[i].w()));
        CHECK(same(file.number<double>("inertia", 6 * i + 2), tree.inertia[i](2, 2)));
        CHECK(same(file.number<double>("inertia", 6 * i + 4), tree.inertia[i](0, 2)));
        CHECK(file.number<std::int32_t>("parent", i) == tree.parent[i]);
        CHECK(file.number<std::uint8_t>("kind", i) == std::uint8_t(tree.kind[i]));
    }
}

TEST_CASE("a motion as safetensors has one array over frames and bodies") {
    Random random;
    const Motion motion = random_motion({true, false, true, false}, 5, 3, random);
    const Layout file(written([&](Output& o) {
        MotionWriter writer(o, motion.header, MotionForm::safetensors);
        for (const MotionFrame& frame : motion.frame) writer.write(frame);
        writer.finish();
    }));
    CHECK(file.header["__metadata__"]["fields"] == "[\"pose\",\"torque\"]");
    CHECK(file.header["position"]["shape"] == nlohmann::json({3, 5, 3}));
    CHECK(file.header["rotation"]["shape"] == nlohmann::json({3, 5, 4}));
    CHECK_FALSE(file.header.contains("velocity"));
    CHECK(file.number<std::int64_t>("frame", 2) == 7);
    for (std::size_t f = 0; f < 3; ++f) {
        CHECK(same(file.number<double>("torque", (f * 5 + 4) * 3 + 2), motion.frame[f].torque[4].z()));
        CHECK(same(file.number<double>("rotation", (f * 5 + 1) * 4 + 3), motion.frame[f].rotation[1].w()));
    }
}

TEST_CASE("both forms of a document, for another program to compare") {
    const char* folder = std::getenv("BOUGH_DOCUMENTS_OUT");
    if (!folder) return;
    Random random;
    const Tree tree = random_tree(500, random);
    const Splines splines = random_splines(200, random);
    const Motion motion = random_motion({true, true, true, true}, 30, 4, random);
    for (const std::string ending : {".json", ".safetensors"}) {
        Output t(std::string(folder) + "/tree" + ending), s(std::string(folder) + "/splines" + ending),
            m(std::string(folder) + "/motion" + ending);
        write_tree(t, tree, form_of_name(t.name()));
        t.finish();
        write_splines(s, splines, form_of_name(s.name()));
        s.finish();
        MotionWriter writer(m, motion.header, ending == ".json" ? MotionForm::json : MotionForm::safetensors);
        for (const MotionFrame& frame : motion.frame) writer.write(frame);
        writer.finish();
        m.finish();
    }
}
