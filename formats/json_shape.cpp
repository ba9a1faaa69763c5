#include "json_shape.h"
#include <algorithm>
#include <vector>

namespace bough {

JsonShape json_shape(std::string_view text) {
    JsonShape shape;
    std::vector<std::size_t> names; // of each object or list that is open
    for (std::size_t i = 0; i < text.size(); ++i) {
        switch (text[i]) {
        case '"':
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
            break;
        case '{':
        case '[':
            names.push_back(0);
            shape.depth = std::max(shape.depth, names.size());
            break;
        case '}':
        case ']':
            if (!names.empty()) names.pop_back();
            break;
        case ':':
            if (!names.empty()) shape.names = std::max(shape.names, ++names.back());
            break;
        default:
            break;
        }
    }
    return shape;
}

} // namespace bough
