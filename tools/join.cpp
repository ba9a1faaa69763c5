#include "join.h"
#include "formats/documents/motion.h"
#include "formats/mapped.h"
#include "frame_sink.h"
#include "lib/base/counted.h"
#include "lib/base/shortest_text.h"
#include "lib/plan/state.h"
#include "signals.h"
#include "simulation.h"
#include <deque>
#include <map>

namespace bough {
namespace {

struct MotionPart {
    std::string name;
    MotionFrames frames;
    MotionFrame frame;
};

// Of "PART: /field": what both must have.
void same(const std::string& name, const char* field, const std::string& found, const std::string& expected,
          const std::string& first) {
    if (found != expected)
        throw InputError(name, std::string("/") + field + ": is " + found + ", but " + first + " has " + expected);
}

// Each part once, in the scene's order. part, parts: of one of them.
template <class Item, class PartOf> void put_in_order(std::vector<Item*>& items, PartOf part_of) {
    const std::int64_t parts = part_of(*items.front()).second;
    if (parts == 1) throw InputError(items.front()->name, "/parts: is 1, expected a part of a scene (--shard)");
    if (items.size() > std::size_t(parts))
        throw UsageError("--join: has " + std::to_string(items.size()) + " files, but " + items.front()->name +
                         " is of " + std::to_string(parts) + " parts");
    std::map<std::int64_t, Item*> place; // by part
    for (Item* item : items) {
        const auto [part, of] = part_of(*item);
        same(item->name, "parts", std::to_string(of), std::to_string(parts), items.front()->name);
        const auto [at, first] = place.emplace(part, item);
        if (!first)
            throw InputError(item->name,
                             "/part: is " + std::to_string(part) + ", which " + at->second->name + " is already");
    }
    std::int64_t missing = 1;
    while (place.count(missing) > 0) ++missing;
    if (missing <= parts)
        throw UsageError("--join: part " + std::to_string(missing) + " of " + std::to_string(parts) + " is missing");
    items.clear();
    for (const auto& [part, item] : place) items.push_back(item);
}

std::string fields_text(const MotionFields& f) {
    std::string text;
    for (const auto& [on, word] :
         {std::pair{f.pose, "pose"}, {f.velocity, "velocity"}, {f.torque, "torque"}, {f.angles, "angles"}})
        if (on) text += (text.empty() ? "" : ", ") + std::string(word);
    return text.empty() ? "none" : text;
}

MotionHeader joined_header(const std::vector<MotionPart*>& parts, const CommonOptions& common) {
    MotionHeader whole = parts.front()->frames.header();
    whole.bodies = 0;
    whole.part = whole.parts = 1;
    whole.first_body = 0;
    for (const MotionPart* part : parts) {
        const MotionHeader& h = part->frames.header();
        const std::string& first = parts.front()->name;
        same(part->name, "fps", shortest_text(h.fps), shortest_text(whole.fps), first);
        same(part->name, "fields", fields_text(h.fields), fields_text(whole.fields), first);
        same(part->name, "whole", h.whole, whole.whole, first);
        if (h.balls != 0)
            throw InputError(part->name, "/balls: is " + std::to_string(h.balls) + ", expected none in a part");
        if (h.first_body != whole.bodies)
            throw InputError(part->name, "/first_body: is " + std::to_string(h.first_body) +
                                             ", but the parts before hold " + std::to_string(whole.bodies) +
                                             " bodies: it is of another scene");
        whole.bodies += h.bodies;
        if (part != parts.front() && whole.source.find(h.source) == std::string::npos) whole.source += "\n" + h.source;
    }
    whole.whole.clear();
    whole.source = with_command_line(whole.source, common);
    return whole;
}

template <class List> void append(List& to, const List& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void add_part(MotionFrame& whole, const MotionFrame& part) {
    append(whole.position, part.position);
    append(whole.rotation, part.rotation);
    append(whole.velocity, part.velocity);
    append(whole.angular_velocity, part.angular_velocity);
    append(whole.torque, part.torque);
    append(whole.theta, part.theta);
    append(whole.theta_dot, part.theta_dot);
}

void join_motions(std::deque<MotionPart>& read, const CommonOptions& common, const std::string& format) {
    std::vector<MotionPart*> parts;
    for (MotionPart& part : read) parts.push_back(&part);
    put_in_order(parts, [](const MotionPart& part) {
        return std::pair{part.frames.header().part, part.frames.header().parts};
    });
    const std::unique_ptr<FrameSink> sink = motion_sink(common.output, format, joined_header(parts, common));
    const std::string& first = parts.front()->name;
    for (std::int64_t count = 0;; ++count) {
        if (interrupted()) throw Interrupted("interrupted after " + counted(count, "frame", "frames"));
        const bool more = parts.front()->frames.next(parts.front()->frame);
        MotionFrame whole;
        if (more) {
            whole.frame = parts.front()->frame.frame;
            whole.time = parts.front()->frame.time;
        }
        for (MotionPart* part : parts) {
            if (part != parts.front() && part->frames.next(part->frame) != more)
                throw InputError(part->name, "has " + std::string(more ? "only " : "more than ") +
                                                 std::to_string(count) + " frames, " + first +
                                                 (more ? " has more" : " has no more"));
            if (!more) continue;
            if (!part->frame.events.what.empty())
                throw InputError(part->name, "/event: has events in frame " + std::to_string(part->frame.frame) +
                                                 ", expected none in a part");
            same(part->name, "frame", std::to_string(part->frame.frame), std::to_string(whole.frame), first);
            same(part->name, "time", shortest_text(part->frame.time), shortest_text(whole.time), first);
            add_part(whole, part->frame);
        }
        if (!more) break;
        sink->write(whole);
    }
    sink->finish();
}

struct StatePart {
    std::string name;
    SavedState state;
};

template <class T> std::uint64_t hash_of(const std::vector<StatePart*>& parts) {
    State<T> whole;
    for (const StatePart* part : parts) {
        for (const Vec3& theta : part->state.theta) whole.theta.push_back(theta.template cast<T>());
        for (const Vec3& rate : part->state.theta_dot) whole.theta_dot.push_back(rate.template cast<T>());
    }
    return state_hash(whole);
}

std::string join_states(std::deque<StatePart>& read) {
    std::vector<StatePart*> parts;
    for (StatePart& part : read) parts.push_back(&part);
    put_in_order(parts, [](const StatePart& part) { return std::pair{part.state.part, part.state.parts}; });
    const StatePart& first = *parts.front();
    for (const StatePart* part : parts) {
        const SavedState &s = part->state, &f = first.state;
        same(part->name, "whole", s.whole, f.whole, first.name);
        same(part->name, "frame", std::to_string(s.frame), std::to_string(f.frame), first.name);
        same(part->name, "fps", shortest_text(s.fps), shortest_text(f.fps), first.name);
        same(part->name, "substeps", std::to_string(s.substeps), std::to_string(f.substeps), first.name);
        same(part->name, "precision", s.precision, f.precision, first.name);
        same(part->name, "solver", s.solver, f.solver, first.name);
        same(part->name, "scheme", s.scheme, f.scheme, first.name);
    }
    return hash_text(first.state.precision == "float" ? hash_of<float>(parts) : hash_of<double>(parts));
}

} // namespace

std::string join_parts(const JoinOptions& o, const CommonOptions& common, const std::string& format, bool output) {
    std::deque<MappedInput> files;
    std::deque<MotionPart> motions;
    std::deque<StatePart> states;
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
        if (o.hash) throw UsageError("--hash: a motion has none; join the parts' saved states (--save-state)");
        if (!output) throw UsageError("--no-output: motions are joined into one; give -o");
        join_motions(motions, common, format);
        return {};
    }
    if (output && common.output != "-")
        throw UsageError("-o: not with saved states, which are resumed part by part; their join is a hash (--hash)");
    return "hash " + join_states(states);
}

} // namespace bough
