// A run's size is told after its second frame, where it is large.
#include "tools/sized_sink.h"
#include "lib/growth/skin.h"
#include "tests/support/make_tree.h"
#include "tools/baked_sinks.h"
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

using namespace bough;

namespace {

// Each frame takes so many bytes.
class Counter : public FrameSink {
public:
    explicit Counter(std::uint64_t each) : each_(each) {}
    void write(const MotionFrame&) override { bytes_ += each_; }
    void finish() override {}
    std::uint64_t bytes() const override { return bytes_; }

private:
    std::uint64_t each_, bytes_ = 0;
};

std::vector<std::string> said(std::uint64_t each, std::int64_t frames, const std::string& smaller) {
    std::vector<std::string> lines;
    const auto sink = sized_sink(std::make_unique<Counter>(each), smaller, frames,
                                 [&lines](const std::string& text) { lines.push_back(text); });
    for (int k = 0; k < 3; ++k) {
        sink->write(MotionFrame());
        CHECK(sink->bytes() == each * std::uint64_t(k + 1));
    }
    sink->finish();
    return lines;
}

} // namespace

TEST_CASE("More than 2 GB are told once, after the second frame, with what is smaller") {
    CHECK(said(20'000'000, 100, "less").empty());
    CHECK(said(20'000'001, 100, "less") ==
          std::vector<std::string>{"the output will be about 2.0 GB, 20 MB a frame; less"});
    CHECK(said(1'000'000'000, 3, "") == std::vector<std::string>{"the output will be about 3.0 GB, 1.0 GB a frame"});
}

TEST_CASE("What is told to be smaller is what the options have not done already") {
    const std::string text = smaller_output("jsonl", false, true);
    for (const char* part : {".safetensors takes less than half", "--digits 6", "--fields"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(smaller_output("jsonl", true, false) == ".safetensors takes less");
    CHECK(smaller_output("safetensors", false, true) == "--fields names what is wanted");
    CHECK(smaller_output("safetensors", false, false).empty());
    CHECK(smaller_output("obj", false, false).find(".pc2") != std::string::npos);
    for (const char* format : {"mdd", "pc2", "usda", "vat"})
        CHECK(smaller_output(format, false, false) == ".glb holds the joints' turns alone");
}

TEST_CASE("What is written at the end is not told of") {
    CHECK(said(0, 1'000'000, "glb").empty());
}

TEST_CASE("What is told of a real output is what is written in the end") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("sized_sink_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const Tree tree = make_tree::random_tree(300, 4);
    const Skin skin = build_skin(tree, {3});
    const RustleMaker still = [](const Skin&, bool) { return std::unique_ptr<Rustle>(); };
    constexpr std::int64_t frames = 400;
    std::vector<std::string> notes, lines;
    const std::string format = GENERATE("mdd", "pc2", "safetensors", "jsonl", "usda"),
                      file = (folder / ("moved." + format)).string();
    CAPTURE(format);
    std::unique_ptr<FrameSink> sink;
    if (format == "usda") {
        sink = usda_sink(file, tree.name, rigged(tree, skin, std::nullopt, GltfChoice(), notes), 30, "", {});
    } else if (format == "mdd" || format == "pc2") {
        Skin one = skin;
        one.position.resize(1), one.normal.resize(1), one.joint.resize(1), one.weight.resize(1);
        sink = cache_sink(file, format, tree, std::move(one), still, {30, 1, frames}, notes);
    } else {
        MotionHeader header;
        header.bodies = std::int64_t(tree.size_bodies());
        sink = motion_sink(file, format, header);
    }
    sink = sized_sink(
        std::move(sink), "", frames, [&](const std::string& text) { lines.push_back(text); }, 1);
    make_tree::Dice dice{std::mt19937(3)};
    for (std::int64_t f = 1; f <= frames; ++f) {
        MotionFrame frame;
        frame.frame = f;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            frame.position.push_back(tree.parent[i] < 0 ? tree.joint_position[i]
                                                        : Vec3(dice(-1, 1), dice(0, 9), dice(-1, 1)));
            frame.rotation.push_back(Quat(dice(-1, 1), dice(-1, 1), dice(-1, 1), dice(-1, 1)).normalized());
        }
        sink->write(frame);
    }
    sink->finish();
    REQUIRE(lines.size() == 1);
    const std::string about = lines[0].substr(lines[0].find("about ") + 6);
    const double unit = about.find(" kB") < about.find(',') ? 1e3 : 1e6;
    CHECK(std::atof(about.c_str()) * unit == Approx(double(fs::file_size(file))).epsilon(0.12));
    fs::remove_all(folder);
}
