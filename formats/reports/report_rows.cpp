#include "report_rows.h"
#include "formats/documents/document_parts.h"
#include "formats/plain_text.h"
#include <array>
#include <charconv>
#include <cmath>

namespace bough {
namespace {

// valid_utf8 that keeps line ends.
std::string valid_lines(std::string_view text) {
    std::string valid;
    for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
        valid += valid_utf8(std::string(text.substr(0, end))) + "\n";
    return valid + valid_utf8(std::string(text));
}

std::string json_text(const ReportValue& value) {
    std::string text;
    if (const auto* string = std::get_if<std::string>(&value)) {
        append_string(text, valid_lines(*string));
    } else if (const auto* real = std::get_if<double>(&value)) {
        if (!std::isfinite(*real)) return "null";
        append_number(text, *real);
    } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        text = std::to_string(*whole);
    } else {
        text = std::get<bool>(value) ? "true" : "false";
    }
    return text;
}

std::string json_members(const ReportRow& row, const char* separator) {
    std::string text;
    for (const auto& [name, value] : row) {
        if (!text.empty()) text += separator;
        append_string(text, name);
        text += ": " + json_text(value);
    }
    return text;
}

std::string csv_text(const ReportValue& value) {
    const auto* string = std::get_if<std::string>(&value);
    if (!string) {
        const std::string text = json_text(value);
        return text == "null" ? "" : text;
    }
    if (string->find_first_of(",\"\r\n") == std::string::npos) return *string;
    std::string text = "\"";
    for (const char c : *string) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

} // namespace

void write_rows_json(Output& output, const char* format, const ReportMeta& meta, const ReportRow& head,
                     const char* rows_name, const std::vector<ReportRow>& rows) {
    write_lists_json(output, format, meta, head, {{rows_name, rows}});
}

void write_lists_json(Output& output, const char* format, const ReportMeta& meta, const ReportRow& head,
                      const std::vector<ReportList>& lists) {
    const ReportRow top = {{"format", std::string(format)},        {"version", std::int64_t(1)}, {"tool", meta.tool},
                           {"tool_version", meta.version},         {"compiler", meta.compiler},  {"flags", meta.flags},
                           {"threads", std::int64_t(meta.threads)}};
    output.write("{\n" + json_members(top, ",\n") + ",\n" + json_members(head, ",\n"));
    for (const auto& [name, rows] : lists) {
        output.write(std::string(",\n\"") + name + "\": [");
        for (std::size_t i = 0; i < rows.size(); ++i)
            output.write((i == 0 ? "\n{" : ",\n{") + json_members(rows[i], ", ") + "}");
        output.write(rows.empty() ? "]" : "\n]");
    }
    if (!meta.source.empty()) output.write(",\n" + json_members({{"source", meta.source}}, ","));
    output.write("\n}\n");
}

void write_rows_csv(Output& output, const ReportRow& names, const std::vector<ReportRow>& rows) {
    const auto line = [&](const ReportRow& row, auto&& cell) {
        std::string text;
        for (const auto& entry : row) text += (text.empty() && &entry == &row.front() ? "" : ",") + cell(entry);
        output.write(text + "\n");
    };
    line(names, [](const auto& entry) { return std::string(entry.first); });
    for (const ReportRow& row : rows) line(row, [](const auto& entry) { return csv_text(entry.second); });
}

std::string known(std::string text, double value) {
    return std::isfinite(value) ? text : "-";
}

std::string figure(double value) {
    if (!std::isfinite(value)) return "non-finite";
    std::array<char, 32> digits;
    char* const last = digits.data() + digits.size();
    const bool whole = std::abs(value) >= 100 && std::abs(value) < 1e6; // 1020, not 1.02e+03
    const auto end = whole ? std::to_chars(digits.data(), last, value, std::chars_format::fixed, 0)
                           : std::to_chars(digits.data(), last, value, std::chars_format::general, 3);
    return {digits.data(), end.ptr};
}

std::string percent(double share) {
    return std::isfinite(share) ? figure(100 * share) + "%" : figure(share);
}

std::string padded(std::string text, int width) {
    std::size_t shown_length = 0; // columns: bytes that do not continue a UTF-8 sequence
    for (const char c : text) shown_length += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    const std::size_t wanted = std::size_t(width < 0 ? -width : width);
    const std::string blank(wanted > shown_length ? wanted - shown_length : 0, ' ');
    return width < 0 ? text + blank : blank + text;
}

std::string steps_text(double steps_per_frame) {
    const double inverse = 1 / steps_per_frame;
    if (steps_per_frame < 1 && inverse == std::round(inverse)) return "1/" + figure(inverse);
    return figure(steps_per_frame);
}

std::string escaped_markup(std::string_view raw) {
    std::string text;
    for (const char c : valid_lines(raw)) {
        switch (c) {
        case '&':
            text += "&amp;";
            break;
        case '<':
            text += "&lt;";
            break;
        case '>':
            text += "&gt;";
            break;
        case '"':
            text += "&quot;";
            break;
        case '\'':
            text += "&#39;";
            break;
        default:
            text += c;
        }
    }
    return text;
}

} // namespace bough
