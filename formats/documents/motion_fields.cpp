#include "motion_fields.h"
#include "lib/base/shortest_text.h"
#include <cmath>
#include <limits>

namespace bough {

const std::vector<FrameArray> frame_arrays{
    {"position", &MotionFields::pose, &MotionFrame::position, nullptr, nullptr},
    {"rotation", &MotionFields::pose, nullptr, &MotionFrame::rotation, nullptr},
    {"velocity", &MotionFields::velocity, &MotionFrame::velocity, nullptr, nullptr},
    {"angular_velocity", &MotionFields::velocity, &MotionFrame::angular_velocity, nullptr, nullptr},
    {"torque", &MotionFields::torque, &MotionFrame::torque, nullptr, nullptr},
    {"theta", &MotionFields::angles, &MotionFrame::theta, nullptr, nullptr},
    {"theta_dot", &MotionFields::angles, &MotionFrame::theta_dot, nullptr, nullptr},
    {"stress", &MotionFields::stress, nullptr, nullptr, &MotionFrame::stress}};

const char* const field_words_text = "pose, velocity, torque, angles or stress";

bool MotionFields::*field_of(const std::string& word) {
    for (const FieldWord& known : field_words)
        if (word == known.word) return known.field;
    return nullptr;
}

std::string beyond_floats(const MotionFrame& frame) {
    const auto text = [&](const char* name, std::size_t body, double largest) {
        return "frame " + std::to_string(frame.frame) + ": the " + name + " of body " + std::to_string(body) +
               " comes to " + four_digits(largest) + ", expected at most 3.4e38, as a float can say";
    };
    constexpr auto most = double(std::numeric_limits<float>::max());
    for (const auto& [name, values] : {std::pair("position", &frame.position),
                                       {"velocity", &frame.velocity},
                                       {"angular velocity", &frame.angular_velocity},
                                       {"torque", &frame.torque},
                                       {"theta", &frame.theta},
                                       {"theta_dot", &frame.theta_dot}})
        for (std::size_t i = 0; i < values->size(); ++i)
            if (const Vec3 sizes = (*values)[i].cwiseAbs(); !(sizes.array() <= most).all()) // as NaN does not
                return text(name, i, sizes.maxCoeff<Eigen::PropagateNaN>());
    for (std::size_t i = 0; i < frame.stress.size(); ++i)
        if (const double value = std::abs(frame.stress[i]); !(value <= most)) return text("stress", i, value);
    return "";
}

std::vector<std::string> words_of(const MotionFields& fields) {
    std::vector<std::string> words;
    for (const FieldWord& known : field_words)
        if (fields.*known.field) words.push_back(known.word);
    return words;
}

std::vector<Field> header_fields(MotionHeader& header, std::vector<std::string>& words) {
    return {{"fps", &header.fps},
            {"bodies", &header.bodies},
            optional({"balls", &header.balls}),
            {"fields", &words},
            optional({"name", &header.name}),
            optional({"source", &header.source}),
            optional({"part", &header.part}),
            optional({"parts", &header.parts}),
            optional({"first_body", &header.first_body}),
            optional({"whole", &header.whole})};
}

std::vector<Field> frame_fields(MotionFrame& frame) {
    std::vector<Field> fields{{"frame", &frame.frame}, {"time", &frame.time}};
    for (const FrameArray& a : frame_arrays)
        fields.push_back(optional(a.vectors     ? array(a.name, frame.*a.vectors, {})
                                  : a.rotations ? array(a.name, frame.*a.rotations, {})
                                                : array(a.name, frame.*a.numbers, {})));
    const Per event{"event in /event", [&frame] { return frame.events.what.size(); }};
    fields.push_back(optional({"event", &frame.events.what}));
    for (Field field : {array("event_body", frame.events.body, event), array("event_on", frame.events.on, event),
                        array("event_value", frame.events.value, event)})
        fields.push_back(optional(std::move(field)));
    return fields;
}

} // namespace bough
