// A run's size is told after its first frame, where it is large.
#include "tools/sized_sink.h"
#include <catch2/catch.hpp>

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

std::vector<std::string> said(std::uint64_t each, std::int64_t frames, const std::string& format) {
    std::vector<std::string> lines;
    const auto sink = sized_sink(std::make_unique<Counter>(each), format, frames,
                                 [&lines](const std::string& text) { lines.push_back(text); });
    for (int k = 0; k < 3; ++k) {
        sink->write(MotionFrame());
        CHECK(sink->bytes() == each * std::uint64_t(k + 1));
    }
    sink->finish();
    return lines;
}

} // namespace

TEST_CASE("More than 2 GB are told once, after the first frame, with what is smaller") {
    CHECK(said(20'000'000, 100, "obj").empty());
    const std::vector<std::string> lines = said(20'000'001, 100, "obj");
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find("about 2.0 GB, 20 MB a frame") != std::string::npos);
    CHECK(lines[0].find(".pc2") != std::string::npos);
    CHECK(said(1'000'000'000, 3, "jsonl").at(0).find(".safetensors") != std::string::npos);
}

TEST_CASE("What is written at the end is not told of") {
    CHECK(said(0, 1'000'000, "glb").empty());
}
