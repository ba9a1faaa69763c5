#include "formats/exports/point_cache.h"
#include <catch2/catch.hpp>
#include <filesystem>
#include <unistd.h>

using namespace bough;

namespace {

struct CacheFile {
    std::string path =
        (std::filesystem::temp_directory_path() / ("bough_test_cache_" + std::to_string(getpid()))).string();
    ~CacheFile() { std::filesystem::remove(path); }
};

std::string bytes_of(const char* hex) {
    std::string bytes;
    for (const char* p = hex; *p; p += 2) {
        while (*p == ' ') ++p;
        bytes.push_back(char(std::stoi(std::string(p, 2), nullptr, 16)));
    }
    return bytes;
}

const std::vector<Vec3> first = {{1, 2, 3}, {-0.5, 0, 1e-3}}, second = {{1, 2.5, 3}, {0, 0, 0}};

void write(PointCacheWriter& writer, const std::vector<Vec3>& frame) {
    writer.write([&](std::size_t from, std::span<Vec3> to) {
        std::copy_n(frame.begin() + std::ptrdiff_t(from), to.size(), to.begin());
    });
}

std::string written(PointCache kind, std::int64_t promised, const std::vector<std::vector<Vec3>>& frames,
                    double fps = 25, std::int64_t number = 3) {
    const CacheFile file;
    Output output(file.path);
    PointCacheShape shape;
    shape.vertices = frames.empty() ? 2 : frames[0].size();
    shape.frames = promised;
    shape.first = number;
    shape.fps = fps;
    PointCacheWriter writer(output, kind, shape);
    for (const std::vector<Vec3>& frame : frames) write(writer, frame);
    writer.finish();
    output.finish();
    return read_input(file.path);
}

} // namespace

// Laid out by Python: struct.pack('>2i2f', 2, 2, 3 / 25, 4 / 25) + struct.pack('>6f', 1, 2, 3, -.5, 0, 1e-3) + ...;
// struct.pack('<12siiffi', b'POINTCACHE2\0', 1, 2, 3, 1, 2) + ..., as Blender's own exporters pack them.
TEST_CASE("both forms, byte by byte") {
    CHECK(written(PointCache::mdd, 2, {first, second}) ==
          bytes_of("00000002 00000002 3df5c28f 3e23d70a 3f800000 40000000 40400000 bf000000 00000000 3a83126f "
                   "3f800000 40200000 40400000 00000000 00000000 00000000"));
    CHECK(written(PointCache::pc2, 2, {first, second}) ==
          bytes_of("504f494e5443414348453200 01000000 02000000 00004040 0000803f 02000000 "
                   "0000803f 00000040 00004040 000000bf 00000000 6f12833a "
                   "0000803f 00002040 00004040 00000000 00000000 00000000"));
}

TEST_CASE("fewer frames than promised make the file of so many") {
    for (const PointCache kind : {PointCache::mdd, PointCache::pc2})
        for (const std::int64_t promised : {3, 1000, 2000000}) {
            CHECK(written(kind, promised, {first, second}) == written(kind, 2, {first, second}));
            CHECK(written(kind, promised, {}) == written(kind, 0, {}));
        }
}

TEST_CASE("an end that does not fit a block is moved up whole") {
    const CacheFile file;
    Output output(file.path);
    std::string all;
    for (int i = 0; all.size() < 5000000; ++i) all += std::to_string(i) + ",";
    output.write(all);
    output.take_out(1234, 777777);
    output.write("more");
    output.finish();
    CHECK(read_input(file.path) == all.substr(0, 1234) + all.substr(1234 + 777777) + "more");
}

TEST_CASE("many vertices come block after block in their order") {
    std::vector<Vec3> row;
    for (int v = 0; v < 150001; ++v) row.emplace_back(v, 2 * v, -v);
    const std::string bytes = written(PointCache::pc2, 1, {row});
    REQUIRE(bytes.size() == 32 + 12 * row.size());
    for (std::size_t v = 0; v < row.size(); ++v) {
        float at[3];
        std::memcpy(at, bytes.data() + 32 + 12 * v, 12);
        REQUIRE((at[0] == float(v) && at[1] == 2 * float(v) && at[2] == -float(v)));
    }
}

TEST_CASE("what does not fit is refused") {
    CHECK_THROWS_AS(written(PointCache::pc2, 1, {{Vec3(0, 1e39, 0)}}), OutputError);
    CHECK_THROWS_AS(written(PointCache::pc2, std::int64_t(1) << 31, {first}), std::length_error);
    Output device("/dev/null"); // its head cannot be mended
    PointCacheShape shape;
    shape.vertices = 2;
    shape.frames = 3;
    PointCacheWriter writer(device, PointCache::mdd, shape);
    write(writer, first);
    CHECK_THROWS_WITH(writer.finish(), Catch::Contains("1 of 3 frames"));
    write(writer, second);
    write(writer, second);
    CHECK_NOTHROW(writer.finish());
}
