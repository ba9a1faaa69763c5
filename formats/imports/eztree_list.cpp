#include "eztree_list.h"
#include "formats/error.h"
#include "json_pull.h"
#include <array>
#include <cmath>

namespace bough::eztree {

void refuse(const std::string& name, std::size_t at, const std::string& message) {
    throw InputError(name, "/branches/" + std::to_string(at) + message);
}

namespace {

// [x, y, z] or {"x": ..}; three.js keeps Euler angles as _x, _y, _z.
Vec3 vector(JsonPull& json) {
    std::array<double, 3> v{};
    unsigned given = 0; // a bit a component
    const auto take = [&](std::size_t k) {
        v[k] = json.number();
        given |= 1u << k;
    };
    if (json.peek() == '[') {
        json.begin_array();
        for (std::size_t k = 0; json.next_item(); ++k)
            if (k < v.size())
                take(k);
            else
                json.skip(); // of Euler angles, their order
    } else {
        std::string_view key;
        for (json.begin_object(); json.next_key(key);) {
            if (key.substr(0, 1) == "_") key.remove_prefix(1);
            if (key == "x" || key == "y" || key == "z")
                take(std::size_t(key.front() - 'x'));
            else
                json.skip();
        }
    }
    if (given != 7) json.refuse("has not all of x, y and z, expected three numbers");
    return {v[0], v[1], v[2]};
}

std::int64_t whole(JsonPull& json, const char* what, double low, double high) {
    const double value = json.number();
    if (value != std::floor(value) || value < low || value > high)
        json.refuse(std::string("is no ") + what + ", expected a whole number from " + std::to_string(int(low)));
    return std::int64_t(value);
}

double not_negative(JsonPull& json) {
    const double value = json.number();
    if (value < 0) json.refuse("is below 0, expected 0 or more");
    return value;
}

Listed listed(JsonPull& json, std::size_t at) {
    constexpr std::array<std::string_view, 5> needed{"level", "origin", "orientation", "length", "radius"};
    Listed b;
    unsigned given = 0;
    std::string_view key;
    for (json.begin_object(); json.next_key(key);) {
        for (std::size_t k = 0; k < needed.size(); ++k)
            if (key == needed[k]) given |= 1u << k;
        if (key == "level") {
            b.level = whole(json, "level", 0, 100);
        } else if (key == "origin") {
            b.origin = vector(json);
        } else if (key == "orientation") {
            b.orientation = vector(json);
        } else if (key == "length") {
            b.length = not_negative(json);
        } else if (key == "radius") {
            b.radius = not_negative(json);
        } else if (key == "parent" && json.peek() != 'n') {
            b.parent = whole(json, "number of a branch before, or -1", -1, double(at) - 1);
            b.has_parent = true;
        } else {
            json.skip();
        }
    }
    for (std::size_t k = 0; k < needed.size(); ++k)
        if (!(given & 1u << k))
            json.refuse("branch " + std::to_string(at) + " has no " + std::string(needed[k]) +
                        ", expected level, origin, orientation, length and radius");
    return b;
}

void take_branches(JsonPull& json, Dump& dump) {
    for (json.begin_array(); json.next_item();) dump.branches.push_back(listed(json, dump.branches.size()));
}

} // namespace

Dump read_dump(std::string_view content, const std::string& name) {
    Dump dump;
    JsonPull json(content, name);
    std::string_view key;
    if (json.peek() == '[') {
        take_branches(json, dump);
    } else {
        for (json.begin_object(); json.next_key(key);) {
            if (key == "branches") {
                take_branches(json, dump);
                continue;
            }
            const std::size_t start = json.offset();
            json.skip();
            if (key == "options") dump.options = content.substr(start, json.offset() - start);
        }
    }
    json.end();
    if (dump.branches.empty())
        throw InputError(name, "holds no branch, expected an array of {level, origin, orientation, length, radius}");
    return dump;
}

} // namespace bough::eztree
