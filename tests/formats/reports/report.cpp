// What `treeprofile compare` reads.
#include "formats/reports/report.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("a report with a number beyond any double is refused by name") { // found by tests/fuzz report
    CHECK_THROWS_WITH(read_report(R"({"format": "bough-report", "bodies": 1e616})", "r.json"),
                      Catch::Contains("r.json: has a number beyond any double"));
    CHECK_THROWS_AS(read_report("1e616{}", "r.json"), InputError);
}
