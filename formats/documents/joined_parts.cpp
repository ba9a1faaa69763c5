#include "joined_parts.h"
#include "lib/base/shortest_text.h"
#include "lib/simulation/scene_error.h"
#include <map>

namespace bough {
namespace {

// Of "PART: /field": what both must have.
void same(const std::string& name, const char* field, const std::string& found, const std::string& expected,
          const std::string& first) {
    if (found != expected)
        throw InputError(name, std::string("/") + field + ": is " + found + ", but " + first + " has " + expected);
}

std::pair<std::int64_t, std::int64_t> place_of(const MotionPart& part) {
    return {part.frames.header().part, part.frames.header().parts};
}
std::pair<std::int64_t, std::int64_t> place_of(const StatePart& part) {
    return {part.state.part, part.state.parts};
}

// Each part once, in the scene's order.
template <class Item> void put_in_order(std::vector<Item>& items) {
    const Item& front = items.front();
    const std::int64_t parts = place_of(front).second;
    if (parts == 1) throw InputError(front.name, "/parts: is 1, expected a part of a scene (--shard)");
    if (items.size() > std::size_t(parts))
        throw SceneError("has " + std::to_string(items.size()) + " files, but " + front.name + " is of " +
                         std::to_string(parts) + " parts");
    std::map<std::int64_t, Item*> known; // by part
    for (Item& item : items) {
        const auto [part, of] = place_of(item);
        same(item.name, "parts", std::to_string(of), std::to_string(parts), front.name);
        const auto [at, first] = known.emplace(part, &item);
        if (!first)
            throw InputError(item.name,
                             "/part: is " + std::to_string(part) + ", which " + at->second->name + " is already");
    }
    std::int64_t missing = 1;
    while (known.count(missing) > 0) ++missing;
    if (missing <= parts)
        throw SceneError("part " + std::to_string(missing) + " of " + std::to_string(parts) + " is missing");
    std::vector<Item> ordered;
    for (const auto& [part, item] : known) ordered.push_back(std::move(*item));
    items = std::move(ordered);
}

std::string fields_text(const MotionFields& f) {
    std::string text;
    for (const FieldWord& known : field_words)
        if (f.*known.field) text += (text.empty() ? "" : ", ") + std::string(known.word);
    return text.empty() ? "none" : text;
}

MotionHeader joined_header(const std::vector<MotionPart>& parts) {
    MotionHeader whole = parts.front().frames.header();
    const std::string& first = parts.front().name;
    whole.bodies = 0;
    whole.part = whole.parts = 1;
    whole.first_body = 0;
    for (const MotionPart& part : parts) {
        const MotionHeader& h = part.frames.header();
        same(part.name, "fps", shortest_text(h.fps), shortest_text(whole.fps), first);
        same(part.name, "fields", fields_text(h.fields), fields_text(whole.fields), first);
        same(part.name, "whole", h.whole, whole.whole, first);
        if (h.balls != 0)
            throw InputError(part.name, "/balls: is " + std::to_string(h.balls) + ", expected none in a part");
        if (h.first_body != whole.bodies)
            throw InputError(part.name, "/first_body: is " + std::to_string(h.first_body) +
                                            ", but the parts before hold " + std::to_string(whole.bodies) +
                                            " bodies: it is of another scene");
        whole.bodies += h.bodies;
        if (&part != &parts.front() && whole.source.find(h.source) == std::string::npos)
            whole.source += "\n" + h.source;
    }
    whole.whole.clear();
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
    append(whole.stress, part.stress);
}

} // namespace

JoinedMotion::JoinedMotion(std::vector<MotionPart> parts) : parts_(std::move(parts)) {
    put_in_order(parts_);
    header_ = joined_header(parts_);
}

bool JoinedMotion::next(MotionFrame& whole) {
    MotionPart& first = parts_.front();
    const bool more = first.frames.next(first.frame);
    whole = {};
    if (more) {
        whole.frame = first.frame.frame;
        whole.time = first.frame.time;
    }
    for (MotionPart& part : parts_) read(part, more, whole);
    count_ += more;
    return more;
}

// The next frame of a part, beside the first's, which has been read.
void JoinedMotion::read(MotionPart& part, bool more, MotionFrame& whole) {
    const std::string& first = parts_.front().name;
    if (&part != &parts_.front() && part.frames.next(part.frame) != more)
        throw InputError(part.name, "has " + std::string(more ? "only " : "more than ") + std::to_string(count_) +
                                        " frames, " + first + (more ? " has more" : " has no more"));
    if (!more) return;
    if (!part.frame.events.what.empty())
        throw InputError(part.name, "/event: has events in frame " + std::to_string(part.frame.frame) +
                                        ", expected none in a part");
    same(part.name, "frame", std::to_string(part.frame.frame), std::to_string(whole.frame), first);
    same(part.name, "time", shortest_text(part.frame.time), shortest_text(whole.time), first);
    add_part(whole, part.frame);
}

std::vector<StatePart> in_order(std::vector<StatePart> parts) {
    put_in_order(parts);
    const StatePart& first = parts.front();
    for (const StatePart& part : parts) {
        const SavedState &s = part.state, &f = first.state;
        same(part.name, "whole", s.whole, f.whole, first.name);
        same(part.name, "frame", std::to_string(s.frame), std::to_string(f.frame), first.name);
        same(part.name, "fps", shortest_text(s.fps), shortest_text(f.fps), first.name);
        same(part.name, "substeps", std::to_string(s.substeps), std::to_string(f.substeps), first.name);
        same(part.name, "precision", s.precision, f.precision, first.name);
        same(part.name, "solver", s.solver, f.solver, first.name);
        same(part.name, "scheme", s.scheme, f.scheme, first.name);
    }
    return parts;
}

} // namespace bough
