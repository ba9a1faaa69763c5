#include "motion_fields.h"
#include <algorithm>
#include <cstring>

namespace bough {
namespace {

void put_words(MotionHeader& header, const std::vector<std::string>& words, const std::string& place) {
    header.fields = {false, false, false, false};
    for (std::size_t i = 0; i < words.size(); ++i) {
        bool* wanted = nullptr;
        if (words[i] == "pose") wanted = &header.fields.pose;
        if (words[i] == "velocity") wanted = &header.fields.velocity;
        if (words[i] == "torque") wanted = &header.fields.torque;
        if (words[i] == "angles") wanted = &header.fields.angles;
        const std::string at = place + "/fields/" + std::to_string(i);
        if (!wanted) throw InputError(at, "is " + in_quotes(words[i]) + ", expected pose, velocity, torque or angles");
        if (*wanted) throw InputError(at, "is " + in_quotes(words[i]) + ", which stands there twice");
        *wanted = true;
    }
}

// `place`: "FILE: " and the header's JSON pointer.
void check_header(const MotionHeader& header, const std::string& place) {
    if (!std::isfinite(header.fps) || header.fps <= 0)
        throw InputError(place + "/fps", "is not above 0, expected frames a second");
    if (header.bodies < 0)
        throw InputError(place + "/bodies", "is " + std::to_string(header.bodies) + ", expected 0 or more");
    if (header.balls < 0 || header.balls > header.bodies)
        throw InputError(place + "/balls", "is " + std::to_string(header.balls) + ", expected 0 to " +
                                               std::to_string(header.bodies) + ", the number of bodies");
}

void check_frame(const MotionHeader& header, const MotionFrame& frame, const std::string& place) {
    for (const FrameArray& array : frame_arrays) {
        const bool wanted = header.fields.*array.wanted;
        const std::size_t expected = wanted ? std::size_t(header.bodies) : 0;
        if (array.size(frame) == expected) continue;
        const std::string has = "has " + std::to_string(array.size(frame) * array.components()) + " numbers, expected ";
        throw InputError(place + "/" + array.name, wanted ? has + std::to_string(expected * array.components()) + " (" +
                                                                std::to_string(array.components()) + " for each of " +
                                                                std::to_string(expected) + " bodies)"
                                                          : has + "none: /fields does not name it");
    }
}

void check_events(const MotionHeader& header, const MotionEvents& events, const std::string& place) {
    const std::size_t count = events.what.size();
    for (const auto& [name, size] : {std::pair{"event_body", events.body.size()},
                                     {"event_on", events.on.size()},
                                     {"event_value", events.value.size()}})
        if (size != count)
            throw InputError(place + "/" + name, "has " + std::to_string(size) + " numbers, expected one for each of " +
                                                     std::to_string(count) + " events");
    for (std::size_t k = 0; k < count; ++k) {
        const std::string entry = "/" + std::to_string(k);
        if (std::find(event_words.begin(), event_words.end(), events.what[k]) == event_words.end())
            throw InputError(place + "/event" + entry,
                             "is " + in_quotes(events.what[k]) + ", expected broke, hit or landed");
        if (events.body[k] < 0 || events.body[k] >= header.bodies)
            throw InputError(place + "/event_body" + entry, "is " + std::to_string(events.body[k]) +
                                                                ", expected a body, 0 to less than " +
                                                                std::to_string(header.bodies));
        if (events.on[k] < -1 || events.on[k] >= header.bodies)
            throw InputError(place + "/event_on" + entry,
                             "is " + std::to_string(events.on[k]) + ", expected a body, or -1");
    }
}

// Whether the text up to `end` is one whole object: the header of JSON lines.
bool is_whole_object(std::string_view text) {
    std::int64_t depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"')
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        else if (text[i] == '{' || text[i] == '[')
            ++depth;
        else if (text[i] == '}' || text[i] == ']')
            --depth;
    }
    return depth == 0;
}

class MotionReader {
public:
    explicit MotionReader(const std::string& name) : name_(name) {}

    Motion read(std::string_view content) {
        if (is_binary(content, name_, motion_type)) return read_binary(content);
        const std::size_t start = text_start(content), end = std::min(content.find('\n', start), content.size());
        if (is_whole_object(content.substr(start, end - start))) return read_lines(content, start);
        return read_whole(content);
    }

private:
    std::vector<Field> whole_fields() {
        std::vector<Field> fields = header_fields(motion_.header, words_);
        Objects frames;
        frames.begin = [this] { return frame_fields(motion_.frame.emplace_back()); };
        fields.push_back({"frames", std::move(frames)});
        return fields;
    }

    Motion read_whole(std::string_view content) {
        std::vector<Field> fields = whole_fields();
        read_json(content, name_, &motion_type, fields);
        return finish([&](std::size_t i) { return name_ + ": /frames/" + std::to_string(i); });
    }

    // The header's line, then a frame a line. A JSON document that happens to be one line has its frames in it.
    Motion read_lines(std::string_view content, std::size_t start) {
        std::vector<std::size_t> lines;
        std::size_t number = 0;
        for (std::size_t first = 0; first < content.size(); ++number) {
            const std::size_t end = std::min(content.find('\n', first), content.size());
            const std::string_view text = content.substr(first, end - first);
            first = end + 1;
            if (text_start(text) == text.size()) continue;
            if (first > start && lines.empty()) {
                std::vector<Field> fields = whole_fields();
                fields.back() = optional(std::move(fields.back()));
                read_json(text, name_, &motion_type, fields, number + 1);
                if (fields.back().seen) return motion_ = {}, words_.clear(), read_whole(content);
                lines.push_back(number + 1);
                continue;
            }
            std::vector<Field> fields = frame_fields(motion_.frame.emplace_back());
            read_json(text, name_, nullptr, fields, number + 1);
            lines.push_back(number + 1);
            check_complete(fields, name_ + ":" + std::to_string(number + 1), "");
        }
        return finish([&](std::size_t i) { return name_ + ":" + std::to_string(lines[i + 1]) + ": "; });
    }

    template <class Place> Motion finish(Place place_of) {
        put_words(motion_.header, words_, name_ + ": ");
        check_header(motion_.header, name_ + ": ");
        for (std::size_t i = 0; i < motion_.frame.size(); ++i) {
            check_frame(motion_.header, motion_.frame[i], place_of(i));
            check_events(motion_.header, motion_.frame[i].events, place_of(i));
        }
        return std::move(motion_);
    }

    const Tensor& tensor(const Safetensors& file, const std::string& key, Dtype dtype,
                         const std::vector<std::int64_t>& shape) {
        const auto found = file.tensors.find(key);
        if (found == file.tensors.end()) missing_field(name_, "", key);
        check_tensor(name_, key, found->second, dtype, shape);
        return found->second;
    }

    std::vector<double> reals(const Safetensors& file, const std::string& key, const std::vector<std::int64_t>& shape) {
        const Tensor& from = tensor(file, key, Dtype::f64, shape);
        std::vector<double> values(from.bytes / sizeof(double));
        if (!values.empty()) std::memcpy(values.data(), from.data.data(), from.bytes);
        check_finite(name_, key, values.data(), values.size());
        return values;
    }

    void read_frames(const Safetensors& file, const FrameArray& array) {
        const std::int64_t components = std::int64_t(array.components());
        const std::vector<double> values =
            reals(file, array.name, {std::int64_t(motion_.frame.size()), motion_.header.bodies, components});
        const std::size_t bodies = std::size_t(motion_.header.bodies);
        const double* v = values.data();
        for (MotionFrame& frame : motion_.frame) {
            if (array.vectors) {
                (frame.*array.vectors).reserve(bodies);
                for (std::size_t i = 0; i < bodies; ++i, v += 3) (frame.*array.vectors).emplace_back(v[0], v[1], v[2]);
            } else {
                (frame.*array.rotations).reserve(bodies);
                for (std::size_t i = 0; i < bodies; ++i, v += 4)
                    (frame.*array.rotations).emplace_back(v[3], v[0], v[1], v[2]);
            }
        }
    }

    std::vector<std::int64_t> integers(const Safetensors& file, const std::string& key, std::int64_t count) {
        const Tensor& from = tensor(file, key, Dtype::i64, {count});
        std::vector<std::int64_t> values(from.bytes / sizeof(std::int64_t));
        if (!values.empty()) std::memcpy(values.data(), from.data.data(), from.bytes);
        return values;
    }

    void read_events(const Safetensors& file) {
        if (!file.tensors.contains("event")) return;
        const std::vector<std::int64_t> what = integers(file, "event", -1);
        const auto count = std::int64_t(what.size());
        const std::vector<std::int64_t> frame = integers(file, "event_frame", count),
                                        body = integers(file, "event_body", count),
                                        on = integers(file, "event_on", count);
        const std::vector<double> value = reals(file, "event_value", {count});
        motion_.header.events = true;
        for (std::size_t k = 0; k < what.size(); ++k) {
            const auto to = std::find_if(motion_.frame.begin(), motion_.frame.end(),
                                         [&](const MotionFrame& f) { return f.frame == frame[k]; });
            const std::string entry = "/" + std::to_string(k);
            if (to == motion_.frame.end())
                throw InputError(name_ + ": /event_frame" + entry,
                                 "is " + std::to_string(frame[k]) + ", expected one of /frame");
            if (what[k] < 0 || std::size_t(what[k]) >= event_words.size())
                throw InputError(name_ + ": /event" + entry,
                                 "is " + std::to_string(what[k]) + ", expected 0 (broke), 1 (hit) or 2 (landed)");
            to->events.add(event_words[std::size_t(what[k])].c_str(), body[k], on[k], value[k]);
        }
        for (const MotionFrame& f : motion_.frame) check_events(motion_.header, f.events, name_ + ": ");
    }

    void check_names(const Safetensors& file) {
        std::vector<std::string> known{"frame", "time", "event_value"};
        known.insert(known.end(), event_integers.begin(), event_integers.end());
        for (const FrameArray& array : frame_arrays) known.push_back(array.name);
        for (const auto& [key, value] : file.tensors) {
            if (std::find(known.begin(), known.end(), key) == known.end()) unknown_field(name_, "", key, known);
            for (const FrameArray& array : frame_arrays)
                if (key == array.name && !(motion_.header.fields.*array.wanted))
                    throw InputError(name_ + ": /" + key,
                                     "is there, expected none: /__metadata__/fields does not name it");
        }
    }

    Motion read_binary(std::string_view content) {
        const Safetensors file = parse_safetensors(content, name_);
        std::vector<Field> fields = header_fields(motion_.header, words_);
        read_metadata(file, name_, motion_type, fields);
        check_complete(fields, name_, "/__metadata__");
        put_words(motion_.header, words_, name_ + ": /__metadata__");
        check_header(motion_.header, name_ + ": /__metadata__");
        check_names(file);
        const Tensor& number = tensor(file, "frame", Dtype::i64, {-1});
        motion_.frame.resize(number.bytes / sizeof(std::int64_t));
        const std::vector<double> time = reals(file, "time", {std::int64_t(motion_.frame.size())});
        for (std::size_t i = 0; i < motion_.frame.size(); ++i) {
            std::memcpy(&motion_.frame[i].frame, number.data.data() + i * sizeof(std::int64_t), sizeof(std::int64_t));
            motion_.frame[i].time = time[i];
        }
        for (const FrameArray& array : frame_arrays)
            if (motion_.header.fields.*array.wanted) read_frames(file, array);
        read_events(file);
        return std::move(motion_);
    }

    std::string name_;
    Motion motion_;
    std::vector<std::string> words_;
};

} // namespace

bool is_motion(std::string_view content) {
    return document_format(content) == motion_type.format;
}

Motion read_motion(std::string_view content, const std::string& name) {
    return MotionReader(name).read(content);
}

} // namespace bough
