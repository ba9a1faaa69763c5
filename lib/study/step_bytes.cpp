#include "step_bytes.h"
#include "../analytic/analytic_rows.h"

namespace bough::fast {
namespace {

constexpr std::uint64_t line = 64; // [bytes] of a row of one quantity

Moved operator+(const Moved& a, const Moved& b) {
    return {a.in + b.in, a.out + b.out};
}

// [bytes] of constants that are shared and stay in a cache from block to block.
constexpr std::uint64_t stays_in_cache = std::uint64_t(32) << 20;

constexpr std::uint64_t index = sizeof(std::uint32_t);

// Constants of a step, in rows: how many there are, how many come in if `visits` rows are worked at, and the table that says which.
struct Constants {
    std::uint64_t held, in, table;
};
Constants constants_of(const Layout& layout, std::uint64_t visits, std::uint64_t quantities, std::uint64_t shared) {
    if (shared == 0) return {layout.rows, visits, 0};
    const bool stay = shared * quantities * line <= stays_in_cache;
    return {shared, stay ? shared : visits, index * (std::uint64_t(layout.rows) + 1)};
}

} // namespace

Moved StepBytes::total() const {
    return constants + now + next + solved + records + indices;
}

StepBytes coupled_step_bytes(const Layout& layout, bool wind, bool gravity, std::size_t real, bool streamed,
                             std::uint64_t shared) {
    std::uint64_t rows = 0, waiting = 0, bases = 0, waiting_bases = 0;
    for (const Block& block : layout.blocks) {
        const std::uint64_t own = block.end_row - block.first_row;
        const std::uint64_t own_bases =
            std::uint64_t(block.end_group - block.first_group) * std::uint64_t(layout.lanes);
        rows += own;
        bases += own_bases;
        if (block.whole) continue;
        waiting += own;
        waiting_bases += own_bases;
    }
    const std::uint64_t quantities = std::uint64_t(constant::count) - (wind ? 0 : 4) - (gravity ? 0 : 3);
    const std::uint64_t record_reals = record(outward::count, layout.lanes) + record(inward::count, layout.lanes) +
                                       record(accelerated::count, layout.lanes);
    const std::uint64_t records = layout.joints * record_reals * real;
    StepBytes bytes;
    const Constants constants = constants_of(layout, rows, constant::count, shared);
    bytes.constants.in = constants.in * quantities * line;
    bytes.now.in = (rows * motion::count + waiting * motion::theta_change) * line;
    bytes.next.in = (rows - waiting) * motion::count * line; // a waiting row's stands where its `solved` was just read
    bytes.next.out = rows * motion::count * line;
    bytes.solved.out = waiting * solved::count * line;
    bytes.solved.in = bytes.solved.out * (streamed ? 1 : 2);
    bytes.records.in = bytes.records.out = records;
    const std::uint64_t forks = layout.fork.size();
    bytes.indices.in = index * (rows + waiting + 2 * bases + waiting_bases + forks) + constants.table;
    const auto columns = std::uint64_t(coupled_columns(waiting > 0, 1));
    bytes.tables = (constants.held * constant::count + rows * columns) * line + records +
                   index * (rows + 2 * bases + forks) + constants.table;
    return bytes;
}

StepBytes analytic_step_bytes(const Layout& layout, bool wind, bool pulls, bool gravity, std::size_t real, bool field,
                              std::uint64_t shared) {
    const std::uint64_t rows = layout.rows, top = layout.blocks[0].end_row - layout.blocks[0].first_row;
    const auto own = std::uint64_t(analytic::constants(wind)), left = std::uint64_t(gravity ? 0 : 1),
               motion = std::uint64_t(analytic::motion::count);
    const std::uint64_t records = layout.joints * real *
                                  (record(analytic::outward_count(field), layout.lanes) +
                                   record(analytic::inward_count(wind, pulls), layout.lanes));
    const std::uint64_t lanes = layout.base.size() + layout.landing.size() + layout.fork.size();
    StepBytes bytes;
    const Constants constants = constants_of(layout, rows + top, own, shared);
    bytes.constants.in = constants.in * (own - left) * line;
    bytes.now.in = (rows + top) * motion * line;
    bytes.next.out = rows * motion * line;
    bytes.records.in = bytes.records.out = records;
    bytes.indices.in = index * (rows + top + lanes) + constants.table;
    bytes.tables = (constants.held * own + rows * motion) * line + records + index * (rows + lanes) + constants.table;
    return bytes;
}

} // namespace bough::fast
