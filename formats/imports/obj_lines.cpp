#include "obj_lines.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>
#include <utility>

namespace bough {
namespace {

constexpr std::array<std::string_view, 44> keywords{
    "v",        "vt",         "vn",        "vp",     "p",      "l",      "f",   "fo",   "o",     "g",    "s",
    "mg",       "usemtl",     "mtllib",    "usemap", "maplib", "cstype", "deg", "bmat", "step",  "curv", "curv2",
    "surf",     "parm",       "trim",      "hole",   "scrv",   "sp",     "end", "con",  "bevel", "lod",  "c_interp",
    "d_interp", "shadow_obj", "trace_obj", "ctech",  "stech",  "call",   "csh", "bsp",  "bzp",   "cdc",  "res"};

class LineReader {
public:
    LineReader(std::string_view content, const std::string& name) : content_(content), name_(name) {}

    ObjLines read() {
        for (std::size_t at = bom_size(content_); at < content_.size();) {
            ++line_;
            std::string_view line = next_line(at);
            if (!line.empty() && line.back() == '\\') line = continued(line, at);
            take(line);
            line_ += std::exchange(more_lines_, 0);
        }
        finish_curve();
        if (highest_ >= std::int64_t(obj_.lines.point.size())) refuse_index(highest_ + 1, highest_line_);
        return std::move(obj_);
    }

private:
    std::string_view next_line(std::size_t& at) const {
        const std::size_t end = std::min(content_.find('\n', at), content_.size());
        std::string_view line = content_.substr(at, end - at);
        at = end + 1;
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        return line;
    }

    // A backslash at the end of a line joins the next one to it.
    std::string_view continued(std::string_view line, std::size_t& at) {
        joined_.clear();
        for (;;) {
            const bool more = !line.empty() && line.back() == '\\';
            if (more) line.remove_suffix(1);
            joined_.append(line).append(" ");
            if (!more || at >= content_.size()) return joined_;
            line = next_line(at);
            ++more_lines_;
        }
    }

    [[noreturn]] void refuse(const std::string& message) const { throw InputError(file_line(name_, line_), message); }
    [[noreturn]] void refuse_index(std::int64_t index, std::size_t line) const {
        throw InputError(file_line(name_, line), "vertex " + std::to_string(index) + " does not exist, expected 1 to " +
                                                     std::to_string(obj_.lines.point.size()));
    }

    double number(std::string_view token, const char* what) const {
        const auto value = parse_number(token);
        if (!value) refuse(in_ascii_quotes(token) + " is not " + what + ", expected a finite number");
        return *value;
    }

    void take(std::string_view line) {
        std::size_t at = 0;
        const std::string_view key = next_token(line, at);
        if (key.empty() || key.front() == '#') return;
        if (key == "v") return take_vertex(line, at);
        if (key == "l") return take_line(line, at);
        if (key == "f" || key == "fo") {
            ++obj_.faces;
        } else if (key == "p") {
            ++obj_.other_points;
        } else if (key == "surf") {
            finish_curve();
            ++obj_.surfaces;
        } else if (key == "cstype") {
            take_type(line, at);
        } else if (key == "deg") {
            const auto degree = parse_integer(next_token(line, at));
            if (!degree || *degree < 1 || *degree > 32) refuse("deg is not a degree, expected an integer 1 to 32");
            degree_ = int(*degree);
        } else if (key == "curv") {
            take_curve(line, at);
        } else if (key == "parm" && open_ && next_token(line, at) == "u") {
            for (std::string_view t = next_token(line, at); !t.empty(); t = next_token(line, at))
                obj_.curve_knot.push_back(number(t, "a knot"));
        } else if (key == "end") {
            finish_curve();
        }
    }

    void take_vertex(std::string_view line, std::size_t at) {
        std::array<std::string_view, 5> token;
        std::size_t n = 0;
        while (n < token.size() && !(token[n] = next_token(line, at)).empty() && token[n].front() != '#') ++n;
        if (n < 3) refuse("v has " + counted(n, "number", "numbers") + ", expected x y z");
        std::vector<Vec3>& point = obj_.lines.point;
        point.emplace_back(number(token[0], "a vertex's x"), number(token[1], "a vertex's y"),
                           number(token[2], "a vertex's z"));
        if (n != 4) { // six are x y z and a colour
            if (!obj_.weight.empty()) obj_.weight.push_back(1);
            return;
        }
        if (obj_.weight.empty()) obj_.weight.assign(point.size() - 1, 1);
        obj_.weight.push_back(number(token[3], "a vertex's weight"));
    }

    // The index of a vertex from "7", "-1", "7/2" or "7//3".
    std::int32_t vertex(std::string_view token) {
        const auto index = parse_integer(token.substr(0, token.find('/')));
        const std::int64_t count = std::int64_t(obj_.lines.point.size());
        if (!index) refuse(in_ascii_quotes(token) + " is not a vertex's index, expected an integer");
        if (*index == 0 || *index < -count || *index > 0x7fffffff) refuse_index(*index, line_);
        const std::int64_t i = *index > 0 ? *index - 1 : count + *index;
        if (i > highest_) {
            highest_ = i;
            highest_line_ = line_;
        }
        return std::int32_t(i);
    }

    void take_line(std::string_view line, std::size_t at) {
        std::int32_t before = -1;
        std::size_t n = 0;
        for (std::string_view t = next_token(line, at); !t.empty() && t.front() != '#'; t = next_token(line, at), ++n) {
            const std::int32_t i = vertex(t);
            if (n > 0) obj_.lines.edge.push_back({before, i});
            before = i;
        }
        if (n < 2) refuse("l has " + counted(n, "vertex", "vertices") + ", expected 2 or more");
    }

    void take_type(std::string_view line, std::size_t at) {
        std::string_view type = next_token(line, at);
        rational_ = type == "rat";
        if (rational_) type = next_token(line, at);
        type_ = std::string(type);
    }

    void take_curve(std::string_view line, std::size_t at) {
        finish_curve();
        curve_.point = obj_.curve_point.size();
        curve_.knot = obj_.curve_knot.size();
        if (type_ == "bspline" || type_.empty())
            curve_.kind = ObjCurve::Kind::bspline;
        else if (type_ == "bezier")
            curve_.kind = ObjCurve::Kind::bezier;
        else if (type_ == "cardinal")
            curve_.kind = ObjCurve::Kind::cardinal;
        else
            refuse("curv of cstype " + in_ascii_quotes(type_) + ", expected bspline, bezier or cardinal");
        for (int k = 0; k < 2; ++k) number(next_token(line, at), "an end of the curve's range");
        for (std::string_view t = next_token(line, at); !t.empty() && t.front() != '#'; t = next_token(line, at))
            obj_.curve_point.push_back(vertex(t));
        if (obj_.curve_point.size() == curve_.point) refuse("curv names no vertex, expected u0 u1 and vertices");
        curve_.degree = degree_;
        curve_.rational = rational_;
        open_ = true;
    }

    void finish_curve() {
        if (open_) {
            curve_.points = obj_.curve_point.size() - curve_.point;
            curve_.knots = obj_.curve_knot.size() - curve_.knot;
            obj_.curves.push_back(curve_);
        }
        curve_ = {};
        open_ = false;
    }

    std::string_view content_;
    const std::string& name_;
    std::string joined_, type_;
    std::size_t line_ = 0, more_lines_ = 0, highest_line_ = 0;
    std::int64_t highest_ = -1;
    ObjLines obj_;
    ObjCurve curve_;
    int degree_ = 1;
    bool rational_ = false, open_ = false;
};

} // namespace

ObjLines read_obj_lines(std::string_view content, const std::string& name) {
    return LineReader(content, name).read();
}

bool looks_like_obj(std::string_view content) {
    content = without_bom(content);
    const std::string_view head = content.substr(0, 65536);
    for (std::size_t at = 0; at < head.size();) {
        const std::size_t end = std::min(head.find('\n', at), head.size());
        const std::string_view line = head.substr(at, end - at);
        at = end + 1;
        std::size_t in = 0;
        const std::string_view key = next_token(line, in);
        if (key.empty() || key.front() == '#') continue;
        if (std::find(keywords.begin(), keywords.end(), key) == keywords.end()) return false;
        if (key != "v") continue;
        for (int k = 0; k < 3; ++k)
            if (!parse_number(next_token(line, in))) return false;
        return true;
    }
    return false;
}

} // namespace bough
