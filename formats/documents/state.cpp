#include "document_parts.h"
#include "motion.h"
#include <charconv>

namespace bough {
namespace {

constexpr DocumentType state_document{"bough-state", 1};

// Absent, the array is empty.
Field without_filling(Field field) {
    std::get<Array>(field.value).fill = [](std::size_t) {};
    return field;
}

// What one solver carries and another does not: may be absent (check_carried says when), and is then empty.
Field carried(const std::string& name, std::vector<Vec3>& values, const Per& per) {
    return without_filling(optional(array(name, values, per)));
}

// `fingerprint`: 16 hexadecimal digits, because JSON's numbers do not hold 64 bits everywhere.
std::vector<Field> fields_of(SavedState& state, std::string& fingerprint) {
    const Per body{"body in /theta", [&state] { return state.theta.size(); }};
    return {{"frame", &state.frame},
            {"fps", &state.fps},
            {"substeps", &state.substeps},
            {"precision", &state.precision},
            {"solver", &state.solver},
            optional({"scheme", &state.scheme}),
            {"fingerprint", &fingerprint},
            optional({"part", &state.part}),
            optional({"parts", &state.parts}),
            optional({"whole", &state.whole}),
            optional({"source", &state.source}),
            array("theta", state.theta, {}),
            array("theta_dot", state.theta_dot, body),
            carried("theta_change", state.theta_change, body),
            carried("theta_dot_change", state.theta_dot_change, body),
            carried("scaled_rate", state.scaled_rate, body),
            carried("spin_dot", state.spin_dot, body),
            optional({"articulated_step", &state.articulated_step}),
            without_filling(optional(array("free_bodies", state.free_bodies, {}))),
            without_filling(optional(array("sleep", state.sleep, {}))),
            without_filling(optional(array("attachments", state.attachments, {}))),
            without_filling(optional(array("step_change", state.step_change, {})))};
}

std::string hexadecimal(std::uint64_t value) {
    std::string digits(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15u];
    return digits;
}

bool read_hexadecimal(const std::string& text, std::uint64_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    return text.size() == 16 && text[0] != '-' && error == std::errc() && end == text.data() + text.size();
}

// What is carried from step to step is the solver's own: all of it, and nothing of another's.
void check_carried(const SavedState& state, const std::string& name) {
    const bool coupled = state.solver == "coupled";
    const auto check = [&](const char* field, bool there, bool wanted) {
        if (there && !wanted)
            throw InputError(name + ": /" + field, "is there, but solver " + in_quotes(state.solver) + " has none");
        if (!there && wanted) missing_field(name, "", field);
    };
    const bool bodies = !state.theta.empty();
    check("scheme", !state.scheme.empty(), coupled);
    check("theta_change", !state.theta_change.empty(), coupled && bodies);
    check("theta_dot_change", !state.theta_dot_change.empty(), coupled && bodies);
    check("scaled_rate", !state.scaled_rate.empty(), !coupled && bodies);
    check("spin_dot", !state.spin_dot.empty(), !state.spin_dot.empty() && state.solver == "analytic");
}

} // namespace

bool is_state(std::string_view content) {
    return document_format(content) == state_document.format;
}

SavedState read_state(std::string_view content, const std::string& name) {
    SavedState state;
    std::string fingerprint;
    const std::vector<Field> fields = fields_of(state, fingerprint);
    read_document(content, name, state_document, fields);
    if (!read_hexadecimal(fingerprint, state.fingerprint))
        throw InputError(name + ": /fingerprint", "is not 16 hexadecimal digits");
    refuse(check(state), name, fields);
    check_carried(state, name);
    return state;
}

void write_state(Output& output, const SavedState& state, Form form) {
    std::string fingerprint = hexadecimal(state.fingerprint);
    std::vector<Field> fields = fields_of(const_cast<SavedState&>(state), fingerprint); // a writer only looks
    if (state.parts == 1) // as it was before there were any
        std::erase_if(fields, [](const Field& field) { return field.name == "part" || field.name == "parts"; });
    if (state.attachments.empty())
        std::erase_if(fields, [](const Field& field) { return field.name == "attachments"; });
    if (state.step_change.empty())
        std::erase_if(fields, [](const Field& field) { return field.name == "step_change"; });
    write_document(output, form, state_document, fields);
}

} // namespace bough
