// What a child process may take that reads a model: by the file, the machine and the user.
#include "formats/models/reader_limits.h"
#include "formats/free_memory.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("a reader's limits grow with the file, up to what the machine has free, unless the user says") {
    constexpr std::size_t megabyte = std::size_t(1) << 20;
    const ChildLimits small = reader_limits(3000);
    CHECK(small.bytes <= 1000 * megabyte + 64 * 3000);
    CHECK(small.seconds == 120);
    const ChildLimits large = reader_limits(400 * megabyte);
    CHECK(large.seconds == 520);
    CHECK(large.bytes >= small.bytes);
    if (const std::optional<std::size_t> free = free_memory()) {
        // The machine is used by others meanwhile.
        const ChildLimits huge = reader_limits(*free);
        CHECK(huge.bytes < *free);
        CHECK(huge.bytes_from.find("free on this machine") != std::string::npos);
    }
    reader_choice() = {5000, 7};
    const ChildLimits chosen = reader_limits(3000);
    reader_choice() = {};
    CHECK(chosen.bytes == 5000 * megabyte);
    CHECK(chosen.seconds == 7);
    CHECK(chosen.bytes_from == "--reader-memory");
    CHECK(chosen.seconds_from == "--reader-seconds");
    CHECK(reader_limits(3000).seconds == 120);
}
