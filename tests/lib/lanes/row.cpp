// Rows are zeros though nobody fills them: new ones, more of them, and those that were written before.
#include "lib/lanes/row.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>

using namespace bough::fast;

namespace {

bool all_zero(const RowVector<float>& rows) {
    return std::all_of(rows.begin(), rows.end(), [](const Row<float>& row) {
        return std::all_of(std::begin(row.lane), std::end(row.lane), [](float x) { return x == 0; });
    });
}

void write(RowVector<float>& rows) {
    for (Row<float>& row : rows) std::fill(std::begin(row.lane), std::end(row.lane), 7.0f);
}

std::uintptr_t address(const RowVector<float>& rows) {
    return reinterpret_cast<std::uintptr_t>(rows.data());
}

} // namespace

TEST_CASE("Rows: an array of them begins as zeros, at a cache line, or at a huge page where it is large") {
    for (const std::size_t count : {1, 3, 1000, 65536, 200000}) { // 64 bytes to 12.8 MB
        for (int again = 0; again < 3; ++again) {                 // memory that was given back before
            RowVector<float> rows;
            set_zero_rows(rows, count);
            CAPTURE(count, again);
            CHECK(rows.size() == count);
            CHECK(all_zero(rows));
            CHECK(address(rows) % row_alignment(count * 64) == 0);
            write(rows);
            set_zero_rows(rows, count);
            CHECK(all_zero(rows));
            write(rows);
            set_zero_rows(rows, count / 2);
            CHECK(rows.size() == count / 2);
            CHECK(all_zero(rows));
        }
    }
}

TEST_CASE("Rows: what grows keeps what it has, and the rest is zero") {
    RowVector<float> rows(100);
    write(rows);
    rows.resize(70000);
    CHECK(rows[99].lane[3] == 7);
    CHECK(std::all_of(rows.begin() + 100, rows.end(),
                      [](const Row<float>& row) { return row.lane[0] == 0 && row.lane[15] == 0; }));
    const RowVector<float> copy = rows;
    CHECK(copy[99].lane[3] == 7);
    CHECK(copy[100].lane[3] == 0);
    rows.insert(rows.end(), copy.begin(), copy.begin() + 50);
    CHECK(rows.back().lane[0] == 7);
}
