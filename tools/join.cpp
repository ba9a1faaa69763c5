#include "join.h"
#include "formats/documents/joined_parts.h"
#include "formats/mapped.h"
#include "frame_sink.h"
#include "lib/base/counted.h"
#include "lib/base/hash_text.h"
#include "lib/simulation/parts.h"
#include "signals.h"
#include <deque>

namespace bough {
namespace {

void join_motions(std::vector<MotionPart> parts, const CommonOptions& common, const std::string& format) {
    JoinedMotion whole(std::move(parts));
    MotionHeader header = whole.header();
    header.source = with_command_line(header.source, common);
    const std::unique_ptr<FrameSink> sink = motion_sink(common.output, format, header);
    MotionFrame frame;
    for (std::int64_t count = 0;; ++count) {
        if (interrupted()) throw Interrupted("interrupted after " + counted(count, "frame", "frames"));
        if (!whole.next(frame)) break;
        sink->write(frame);
    }
    sink->finish();
}

std::string join_states(std::vector<StatePart> parts) {
    parts = in_order(std::move(parts));
    std::vector<const SavedState*> states;
    for (const StatePart& part : parts) states.push_back(&part.state);
    return hash_text(hash_of_parts(states));
}

} // namespace

std::string join_parts(const JoinOptions& o, const CommonOptions& common, const std::string& format) try {
    std::deque<MappedInput> files;
    std::vector<MotionPart> motions;
    std::vector<StatePart> states;
    for (const std::string& file : o.parts) {
        const std::string name = input_name(file);
        const std::string_view content = files.emplace_back(file).content();
        if (is_state(content))
            states.push_back({name, read_state(content, name)});
        else
            motions.push_back({name, MotionFrames(content, name), {}});
        if (!states.empty() && !motions.empty())
            throw InputError(name, "is a " + std::string(is_state(content) ? "state" : "motion") +
                                       ", but what comes before it is not; expected motions or states alone");
    }
    if (states.empty()) {
        if (o.hash) throw UsageError("--report hash: a motion has none; join the parts' saved states (--save-state)");
        join_motions(std::move(motions), common, format);
        return {};
    }
    if (common.output != "-")
        throw UsageError(
            "-o: not with saved states, which are resumed part by part; their join is a hash (--report hash)");
    return "hash " + join_states(std::move(states));
} catch (const SceneError& error) {
    throw UsageError(std::string("join: ") + error.what());
}

} // namespace bough
