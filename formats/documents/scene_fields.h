// scene_fields.h: one object of a document that people write: its fields taken by name and type, each once, and what is
// left over refused. (A scene is small, so it is read as a tree of values, nested where that reads best.)
#pragma once
#include "document_parts.h"

namespace bough {

class ObjectReader {
public:
    // Throws unless the value is an object. `at`: its JSON pointer.
    ObjectReader(const nlohmann::json& value, const std::string& name, const std::string& at);

    bool has(const std::string& key); // and makes it known
    const nlohmann::json& need(const std::string& key);

    // Into the target if the field is there.
    void read(const std::string& key, double&);
    void read(const std::string& key, std::int32_t&);
    void read(const std::string& key, std::int64_t&);
    void read(const std::string& key, std::uint64_t&);
    void read(const std::string& key, bool&);
    void read(const std::string& key, std::string&);
    void read(const std::string& key, Vec3&); // [x, y, z]
    void read(const std::string& key, std::vector<double>&);
    void read(const std::string& key, std::vector<Vec3>&); // [[x, y, z], ...] or flat
    void read(const std::string& key, std::vector<Quat>&); // [[x, y, z, w], ...] or flat
    // One of the words, its place in the list.
    std::size_t word(const std::string& key, const std::vector<std::string>& words, std::size_t fallback);

    const nlohmann::json& list(const std::string& key); // an array, or an empty one if the field is not there
    void finish();                                      // throws for a field that nobody asked for

    [[noreturn]] void fail(const std::string& key, const std::string& message) const;
    std::string at(const std::string& key) const { return pointer(at_, key); }

private:
    const nlohmann::json* find(const std::string& key);
    double real(const nlohmann::json& value, const std::string& key) const;
    // The numbers of rows that are `parts.size()` long each, nested or flat; false if the field is not there.
    bool read_rows(const std::string& key, const std::vector<std::string>& parts, std::vector<double>&);

    const nlohmann::json& value_;
    std::string name_, at_;
    std::vector<std::string> known_;
};

} // namespace bough
