#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "motion_fields.h"
#include <algorithm>
#include <cstring>

namespace bough {
namespace {

void put_words(MotionHeader& header, const std::vector<std::string>& words, const std::string& place) {
    header.fields = no_fields;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto field = field_of(words[i]);
        const std::string at = place + "/fields/" + std::to_string(i);
        if (!field) throw InputError(at, "is " + in_quotes(words[i]) + ", expected " + field_words_text);
        bool& wanted = header.fields.*field;
        if (wanted) throw InputError(at, "is " + in_quotes(words[i]) + ", which stands there twice");
        wanted = true;
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

void check_part(std::int32_t part, std::int32_t parts, const std::string& place) {
    if (parts >= 1 && part >= 1 && part <= parts) return;
    throw InputError(place + "/part", "is " + std::to_string(part) + " of " + std::to_string(parts) +
                                          ", expected 1 to the number of /parts");
}

void check_frame(const MotionHeader& header, const MotionFrame& frame, const std::string& place) {
    for (const FrameArray& array : frame_arrays) {
        const bool wanted = header.fields.*array.wanted;
        const std::size_t expected = wanted ? std::size_t(header.bodies) : 0;
        if (array.size(frame) == expected) continue;
        const std::string has =
            "has " + counted(array.size(frame) * array.components(), "number", "numbers") + ", expected ";
        throw InputError(place + "/" + array.name, wanted ? has + std::to_string(expected * array.components()) + " (" +
                                                                std::to_string(array.components()) + " for each of " +
                                                                counted(expected, "body", "bodies") + ")"
                                                          : has + "none: /fields does not name it");
    }
}

void check_events(const MotionHeader& header, const MotionEvents& events, const std::string& place) {
    const std::size_t count = events.what.size();
    for (const auto& [name, size] : {std::pair{"event_body", events.body.size()},
                                     {"event_on", events.on.size()},
                                     {"event_value", events.value.size()}})
        if (size != count)
            throw InputError(place + "/" + name, "has " + counted(size, "number", "numbers") +
                                                     ", expected one for each of " + counted(count, "event", "events"));
    for (std::size_t k = 0; k < count; ++k) {
        const std::string entry = "/" + std::to_string(k);
        if (std::find(event_words.begin(), event_words.end(), events.what[k]) == event_words.end())
            throw InputError(place + "/event" + entry,
                             "is " + in_quotes(events.what[k]) + ", expected broke, hit, landed or leapt");
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

const Tensor& tensor(const Safetensors& file, const std::string& name, const std::string& key, Dtype dtype,
                     const std::vector<std::int64_t>& shape) {
    const auto found = file.tensors.find(key);
    if (found == file.tensors.end()) missing_field(name, "", key);
    check_tensor(name, key, found->second, dtype, shape);
    return found->second;
}

std::vector<double> reals(const Safetensors& file, const std::string& name, const std::string& key,
                          const std::vector<std::int64_t>& shape) {
    const Tensor& from = tensor(file, name, key, Dtype::f64, shape);
    std::vector<double> values(from.data.size() / sizeof(double));
    if (!values.empty()) std::memcpy(values.data(), from.data.data(), from.data.size());
    check_finite(name, key, values.data(), values.size());
    return values;
}

std::vector<std::int64_t> integers(const Safetensors& file, const std::string& name, const std::string& key,
                                   std::int64_t count) {
    const Tensor& from = tensor(file, name, key, Dtype::i64, {count});
    std::vector<std::int64_t> values(from.data.size() / sizeof(std::int64_t));
    if (!values.empty()) std::memcpy(values.data(), from.data.data(), from.data.size());
    return values;
}

void check_names(const Safetensors& file, const std::string& name, const MotionFields& fields) {
    std::vector<std::string> known{"frame", "time", "event_value"};
    known.insert(known.end(), event_integers.begin(), event_integers.end());
    for (const FrameArray& array : frame_arrays) known.push_back(array.name);
    for (const auto& [key, value] : file.tensors) {
        if (std::find(known.begin(), known.end(), key) == known.end()) unknown_field(name, "", key, known);
        for (const FrameArray& array : frame_arrays)
            if (key == array.name && !(fields.*array.wanted))
                throw InputError(name + ": /" + key, "is there, expected none: /__metadata__/fields does not name it");
    }
}

} // namespace

// One of three: lines, a binary file, or a JSON document, which is read whole.
struct MotionFrames::Implementation {
    std::string_view content;
    std::string name;
    MotionHeader header;
    std::vector<std::string> words;
    std::size_t next_frame = 0;
    std::size_t first = 0, line = 0; // of what is left of the lines
    std::vector<MotionFrame> whole;
    bool is_whole = false;
    std::optional<Safetensors> binary;
    std::vector<std::int64_t> number;
    std::vector<double> time;
    std::vector<MotionEvents> events; // of each frame of a binary file that has some

    void open() {
        if (is_binary(content, name, motion_type)) return open_binary();
        const std::size_t start = text_start(content), end = std::min(content.find('\n', start), content.size());
        if (!is_whole_object(content.substr(start, end - start))) return read_whole();
        read_header_line();
    }

    bool next(MotionFrame& frame) {
        if (is_whole) {
            if (next_frame == whole.size()) return false;
            frame = std::move(whole[next_frame++]);
            return true;
        }
        return binary ? next_binary(frame) : next_line(frame);
    }

    std::vector<Field> whole_fields() {
        std::vector<Field> fields = header_fields(header, words);
        Objects frames;
        frames.begin = [this] { return frame_fields(whole.emplace_back()); };
        fields.push_back({"frames", std::move(frames)});
        return fields;
    }

    void finish_header(const std::string& place) {
        put_words(header, words, place);
        check_header(header, place);
        check_part(header.part, header.parts, place);
    }

    void read_whole() {
        is_whole = true;
        std::vector<Field> fields = whole_fields();
        read_json(content, name, &motion_type, fields);
        finish_header(name + ": ");
        for (std::size_t i = 0; i < whole.size(); ++i) check(whole[i], name + ": /frames/" + std::to_string(i));
    }

    void check(const MotionFrame& frame, const std::string& place) {
        check_frame(header, frame, place);
        check_events(header, frame.events, place);
        header.events = header.events || !frame.events.what.empty();
    }

    // The next line that holds something; none: empty.
    std::string_view next_text() {
        while (first < content.size()) {
            const std::size_t end = std::min(content.find('\n', first), content.size());
            const std::string_view text = content.substr(first, end - first);
            first = end + 1;
            ++line;
            if (text_start(text) != text.size()) return text;
        }
        return {};
    }

    // A JSON document that happens to be one line has its frames in it.
    void read_header_line() {
        const std::string_view text = next_text();
        std::vector<Field> fields = whole_fields();
        fields.back() = optional(std::move(fields.back()));
        read_json(text, name, &motion_type, fields, line);
        if (fields.back().seen) {
            header = {};
            words.clear();
            whole.clear();
            return read_whole();
        }
        finish_header(name + ": ");
    }

    bool next_line(MotionFrame& frame) {
        const std::string_view text = next_text();
        if (text.empty()) return false;
        const std::string place = name + ":" + std::to_string(line);
        frame = {};
        std::vector<Field> fields = frame_fields(frame);
        read_json(text, name, nullptr, fields, line);
        check_complete(fields, place, "");
        check(frame, place + ": ");
        return true;
    }

    void open_binary() {
        binary = parse_safetensors(content, name);
        std::vector<Field> fields = header_fields(header, words);
        read_metadata(*binary, name, motion_type, fields);
        check_complete(fields, name, "/__metadata__");
        finish_header(name + ": /__metadata__");
        check_names(*binary, name, header.fields);
        number = integers(*binary, name, "frame", -1);
        const auto frames = std::int64_t(number.size());
        time = reals(*binary, name, "time", {frames});
        for (const FrameArray& array : frame_arrays)
            if (header.fields.*array.wanted)
                tensor(*binary, name, array.name, Dtype::f64, array.shape(frames, header.bodies));
        if (binary->tensors.contains("event")) read_events();
    }

    void read_events() {
        const std::vector<std::int64_t> what = integers(*binary, name, "event", -1);
        const auto count = std::int64_t(what.size());
        const std::vector<std::int64_t> frame = integers(*binary, name, "event_frame", count),
                                        body = integers(*binary, name, "event_body", count),
                                        on = integers(*binary, name, "event_on", count);
        const std::vector<double> value = reals(*binary, name, "event_value", {count});
        header.events = true;
        events.resize(number.size());
        for (std::size_t k = 0; k < what.size(); ++k) {
            const auto to = std::find(number.begin(), number.end(), frame[k]);
            const std::string entry = "/" + std::to_string(k);
            if (to == number.end())
                throw InputError(name + ": /event_frame" + entry,
                                 "is " + std::to_string(frame[k]) + ", expected one of /frame");
            if (what[k] < 0 || std::size_t(what[k]) >= event_words.size())
                throw InputError(name + ": /event" + entry,
                                 "is " + std::to_string(what[k]) +
                                     ", expected 0 (broke), 1 (hit), 2 (landed) or 3 (leapt)");
            events[std::size_t(to - number.begin())].add(event_words[std::size_t(what[k])].c_str(), body[k], on[k],
                                                         value[k]);
        }
        for (const MotionEvents& of_frame : events) check_events(header, of_frame, name + ": ");
    }

    void read_array(const FrameArray& array, MotionFrame& frame) {
        const std::size_t bodies = std::size_t(header.bodies), count = bodies * array.components();
        std::vector<double> values(count);
        const Tensor& from = binary->tensors.find(array.name)->second;
        if (count > 0)
            std::memcpy(values.data(), from.data.data() + next_frame * count * sizeof(double), count * sizeof(double));
        check_finite(name, array.name, values.data(), count);
        const double* v = values.data();
        if (array.numbers) {
            frame.*array.numbers = std::move(values);
        } else if (array.vectors) {
            (frame.*array.vectors).reserve(bodies);
            for (std::size_t i = 0; i < bodies; ++i, v += 3) (frame.*array.vectors).emplace_back(v[0], v[1], v[2]);
        } else {
            (frame.*array.rotations).reserve(bodies);
            for (std::size_t i = 0; i < bodies; ++i, v += 4)
                (frame.*array.rotations).emplace_back(v[3], v[0], v[1], v[2]);
        }
    }

    bool next_binary(MotionFrame& frame) {
        if (next_frame == number.size()) return false;
        frame = {};
        frame.frame = number[next_frame];
        frame.time = time[next_frame];
        for (const FrameArray& array : frame_arrays)
            if (header.fields.*array.wanted) read_array(array, frame);
        if (!events.empty()) frame.events = events[next_frame];
        ++next_frame;
        return true;
    }
};

MotionFrames::MotionFrames(std::string_view content, const std::string& name)
    : implementation_(new Implementation{content, name, {}, {}, 0, 0, 0, {}, false, {}, {}, {}, {}}) {
    implementation_->open();
}
MotionFrames::~MotionFrames() = default;
MotionFrames::MotionFrames(MotionFrames&&) noexcept = default;

const MotionHeader& MotionFrames::header() const {
    return implementation_->header;
}

bool MotionFrames::next(MotionFrame& frame) {
    return implementation_->next(frame);
}

Motion read_motion(std::string_view content, const std::string& name) {
    MotionFrames frames(content, name);
    Motion motion;
    for (MotionFrame frame; frames.next(frame);) motion.frame.push_back(std::move(frame));
    motion.header = frames.header();
    return motion;
}

} // namespace bough
