#include "motion_fields.h"

namespace bough {

const std::vector<FrameArray> frame_arrays{
    {"position", &MotionFields::pose, &MotionFrame::position, nullptr},
    {"rotation", &MotionFields::pose, nullptr, &MotionFrame::rotation},
    {"velocity", &MotionFields::velocity, &MotionFrame::velocity, nullptr},
    {"angular_velocity", &MotionFields::velocity, &MotionFrame::angular_velocity, nullptr},
    {"torque", &MotionFields::torque, &MotionFrame::torque, nullptr},
    {"theta", &MotionFields::angles, &MotionFrame::theta, nullptr},
    {"theta_dot", &MotionFields::angles, &MotionFrame::theta_dot, nullptr}};

std::vector<std::string> words_of(const MotionFields& fields) {
    std::vector<std::string> words;
    if (fields.pose) words.push_back("pose");
    if (fields.velocity) words.push_back("velocity");
    if (fields.torque) words.push_back("torque");
    if (fields.angles) words.push_back("angles");
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
        fields.push_back(
            optional(a.vectors ? array(a.name, frame.*a.vectors, {}) : array(a.name, frame.*a.rotations, {})));
    const Per event{"event in /event", [&frame] { return frame.events.what.size(); }};
    fields.push_back(optional({"event", &frame.events.what}));
    for (Field field : {array("event_body", frame.events.body, event), array("event_on", frame.events.on, event),
                        array("event_value", frame.events.value, event)})
        fields.push_back(optional(std::move(field)));
    return fields;
}

} // namespace bough
