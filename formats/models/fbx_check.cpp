#include "fbx_check.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>
#include <zlib.h>

namespace bough {
namespace {

constexpr std::string_view magic("Kaydara FBX Binary  \0", 21);
constexpr std::size_t head = 27; // with the version, its last four bytes

[[noreturn]] void fail(std::size_t byte, const std::string& what) {
    throw std::runtime_error("byte " + std::to_string(byte) + ": " + what);
}

// A record's name in a message: as it is where it is a word, else in quotes.
std::string said(std::string_view name) {
    const bool word = std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
    return word && name.size() <= 40 ? std::string(name) : in_ascii_quotes(name);
}

struct Record {
    std::string_view name;
    std::size_t properties = 0, first = 0,
                end = 0; // [bytes] where its properties, its records and what comes behind it begin
};

class FbxFile {
public:
    explicit FbxFile(std::string_view content) : content_(content), wide_(number<std::uint32_t>(23) >= 7500) {}

    // take(record) for those that lie from `first` to `end`.
    template <class Take> void each(std::size_t first, std::size_t end, Take&& take) const {
        while (first < end) {
            const std::optional<Record> record = at(first, end);
            if (!record) return; // the list's end mark
            take(*record);
            first = record->end;
        }
    }
    std::size_t size() const { return content_.size(); }

    // "" where it has none. The first property is an id, the second the name, a zero and the kind.
    std::string name_of(const Record& record) const {
        std::size_t p = record.properties;
        if (p + 9 > record.first || content_[p] != 'L' || content_[p + 9] != 'S' || p + 14 > record.first) return "";
        const std::size_t length = number<std::uint32_t>(p + 10);
        const std::string_view text = content_.substr(p + 14, std::min(length, record.first - (p + 14)));
        return std::string(text.substr(0, text.find('\0')));
    }

    // The record's first property, where it is an array of this type: what has one number for each.
    template <class T> std::optional<std::vector<T>> array(const Record& record, char type) const {
        const std::size_t p = record.properties;
        if (p + 13 > record.first || content_[p] != type) return {};
        const std::uint64_t count = number<std::uint32_t>(p + 1), packed = number<std::uint32_t>(p + 9);
        const bool is_packed = number<std::uint32_t>(p + 5) == 1;
        const std::string what = said(record.name) + " ";
        if (packed > record.first - (p + 13)) fail(p, what + "ends beyond its record");
        if (is_packed ? count * sizeof(T) > 1100 * packed + 1100 : count * sizeof(T) > packed)
            fail(p, what + "has room for fewer than the " + std::to_string(count) + " numbers that it says it holds");
        std::vector<T> numbers(static_cast<std::size_t>(count));
        if (count == 0) return numbers;
        if (!is_packed) {
            std::memcpy(numbers.data(), content_.data() + p + 13, numbers.size() * sizeof(T));
            return numbers;
        }
        auto size = static_cast<uLongf>(numbers.size() * sizeof(T));
        const int status = ::uncompress(reinterpret_cast<Bytef*>(numbers.data()), &size,
                                        reinterpret_cast<const Bytef*>(content_.data() + p + 13), uLong(packed));
        if (status != Z_OK || size != numbers.size() * sizeof(T)) fail(p, what + "cannot be unpacked");
        return numbers;
    }

private:
    template <class T> T number(std::size_t at) const {
        if (at + sizeof(T) > content_.size()) fail(content_.size(), "the file ends within a record");
        T value;
        std::memcpy(&value, content_.data() + at, sizeof(T));
        return value;
    }

    std::optional<Record> at(std::size_t first, std::size_t within) const {
        const auto field = [&](int k) {
            return std::size_t(wide_ ? number<std::uint64_t>(first + 8 * std::size_t(k))
                                     : number<std::uint32_t>(first + 4 * std::size_t(k)));
        };
        const std::size_t behind = first + (wide_ ? 25 : 13);
        Record record;
        record.end = field(0);
        if (record.end == 0) return {};
        const std::size_t length = field(2), name = number<std::uint8_t>(behind - 1);
        record.properties = behind + name;
        if (record.end > content_.size())
            fail(first, "a record ends at byte " + std::to_string(record.end) + ", the file at " +
                            std::to_string(content_.size()));
        if (record.end > within || record.end < record.properties || length > record.end - record.properties)
            fail(first, "a record does not fit the one that holds it");
        record.first = record.properties + length;
        record.name = content_.substr(behind, name);
        return record;
    }

    std::string_view content_;
    bool wide_;
};

class Checker {
public:
    explicit Checker(std::string_view content) : file_(content) {}

    void run() {
        std::vector<Record> deformers; // behind all geometries, whose vertices they name
        file_.each(head, file_.size(), [&](const Record& top) {
            if (top.name != "Objects") return;
            file_.each(top.first, top.end, [&](const Record& object) {
                if (object.name == "Geometry") check_geometry(object);
                if (object.name == "Deformer") deformers.push_back(object);
            });
        });
        for (const Record& deformer : deformers) check_deformer(deformer);
    }

private:
    void require_finite(const Record& record) const {
        const std::optional<std::vector<double>> numbers = file_.array<double>(record, 'd');
        for (std::size_t k = 0; numbers && k < numbers->size(); ++k)
            if (!std::isfinite((*numbers)[k]))
                throw std::runtime_error(place_ + said(record.name) + " has a number that is not finite, number " +
                                         std::to_string(k));
    }

    void require_indices(const Record& record, const std::vector<std::int32_t>& indices, bool ends,
                         std::size_t vertices) const {
        for (std::size_t k = 0; k < indices.size(); ++k) {
            const std::int64_t named = ends && indices[k] < 0 ? -1 - std::int64_t(indices[k]) : indices[k];
            if (named < 0 || named >= std::int64_t(vertices))
                throw std::runtime_error(place_ + said(record.name) + " names vertex " + std::to_string(named) +
                                         " as number " + std::to_string(k) + ", expected 0 to less than " +
                                         std::to_string(vertices));
        }
    }

    void check_geometry(const Record& geometry) {
        place_ = "geometry " + in_ascii_quotes(file_.name_of(geometry)) + ": ";
        std::size_t vertices = 0;
        std::optional<Record> polygons;
        file_.each(geometry.first, geometry.end, [&](const Record& part) {
            if (part.name == "Vertices") {
                require_finite(part);
                if (const auto numbers = file_.array<double>(part, 'd')) vertices = numbers->size() / 3;
            }
            if (part.name == "PolygonVertexIndex") polygons = part;
            if (part.name.starts_with("LayerElement"))
                file_.each(part.first, part.end, [&](const Record& layer) { require_finite(layer); });
        });
        if (vertices > most_vertices_) most_vertices_ = vertices;
        if (!polygons) return;
        if (const auto indices = file_.array<std::int32_t>(*polygons, 'i')) {
            if (vertices == 0 && !indices->empty())
                throw std::runtime_error(place_ + "has no vertices, but polygons of them");
            require_indices(*polygons, *indices, true, vertices);
        }
    }

    void check_deformer(const Record& deformer) {
        place_ = "deformer " + in_ascii_quotes(file_.name_of(deformer)) + ": ";
        std::optional<std::size_t> indices, weights;
        file_.each(deformer.first, deformer.end, [&](const Record& part) {
            require_finite(part);
            if (part.name == "Indexes") {
                if (const auto named = file_.array<std::int32_t>(part, 'i')) {
                    require_indices(part, *named, false, most_vertices_);
                    indices = named->size();
                }
            }
            if (part.name == "Weights")
                if (const auto shares = file_.array<double>(part, 'd')) weights = shares->size();
        });
        if (indices && weights && *indices != *weights)
            throw std::runtime_error(place_ + "has " + std::to_string(*weights) + " Weights for " +
                                     std::to_string(*indices) + " Indexes");
    }

    FbxFile file_;
    std::string place_;
    std::size_t most_vertices_ = 0; // of one geometry
};

} // namespace

void check_fbx(std::string_view content) {
    if (content.substr(0, magic.size()) == magic && content.size() >= head) Checker(content).run();
}

} // namespace bough
