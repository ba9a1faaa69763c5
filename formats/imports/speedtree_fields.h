// speedtree_fields.h: attributes and number lists of a SpeedTree XML node, strict, with FILE:LINE in every error.
#pragma once
#include "lib/base/math.h"
#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace bough::speedtree {

class Fields {
public:
    // Of nodes read from the content's bytes from `begin` on.
    Fields(std::string_view content, const std::string& name, std::size_t begin = 0)
        : content_(content), name_(name), begin_(begin) {}

    std::size_t offset(const pugi::xml_node&) const; // in the content
    std::size_t line(const pugi::xml_node&) const;
    [[noreturn]] void refuse(const pugi::xml_node&, const std::string& message) const; // "<Bone> ..." at its line
    [[noreturn]] void refuse(const char* element, std::size_t offset, const std::string& message) const;

    // Attributes. A missing one is an error unless a fallback is given.
    double number(const pugi::xml_node&, const char* attribute) const;
    double number(const pugi::xml_node&, const char* attribute, double fallback) const;
    std::int64_t integer(const pugi::xml_node&, const char* attribute) const;
    std::int64_t integer(const pugi::xml_node&, const char* attribute, std::int64_t fallback) const;
    Vec3 vector(const pugi::xml_node&, const char* prefix) const;                       // prefixX, prefixY, prefixZ
    Vec3 vector(const pugi::xml_node&, const char* prefix, const Vec3& fallback) const; // absent components only
    Vec3 vector_of(const pugi::xml_node& node, const char* x, const char* y, const char* z) const {
        return {number(node, x), number(node, y), number(node, z)};
    }

    // Child elements that hold blank-separated numbers. A missing child is an empty list.
    std::vector<double> numbers(const pugi::xml_node& parent, const char* child) const;
    std::vector<std::int64_t> integers(const pugi::xml_node& parent, const char* child) const;
    std::vector<float> floats(const pugi::xml_node& parent, const char* child) const;
    // Whole numbers from 0 to `end` - 1, of what messages call `things`.
    std::vector<std::int32_t> indices(const pugi::xml_node& parent, const char* child, std::size_t end,
                                      const char* things) const;
    // Points from prefixX, prefixY, prefixZ children, which must be there and equally long.
    std::vector<Vec3> points(const pugi::xml_node& parent, const char* prefix) const;
    // Refuses a list that is not `expected` long.
    void expect_length(const pugi::xml_node& parent, const char* child, std::size_t found, std::size_t expected) const;

private:
    template <class T, class Parse>
    std::vector<T> list(const pugi::xml_node& parent, const char* child, const char* what, Parse parse) const;
    template <class T, class Parse>
    T attribute(const pugi::xml_node&, const char* attribute, const char* what, Parse parse) const;

    std::string_view content_;
    std::string name_;
    std::size_t begin_;
};

} // namespace bough::speedtree
