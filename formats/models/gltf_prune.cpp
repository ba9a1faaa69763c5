#include "gltf_prune.h"
#include "gltf_references.h"
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;
using gltf_references::each_accessor_index, gltf_references::each_place, gltf_references::each_view_index,
    gltf_references::extension;

struct Range {
    std::size_t begin, end;
};

Range range_of(const Json& place) {
    const std::size_t begin = whole_number(place, "byteOffset", "a view", 0);
    return {begin, begin + whole_number(place, "byteLength", "a view")};
}

// The entries of a list that are left, and of each its new index.
std::vector<std::size_t> leave_out(Json& list, const std::vector<char>& gone) {
    std::vector<std::size_t> index(gone.size());
    Json kept = Json::array();
    for (std::size_t i = 0; i < gone.size(); ++i) {
        if (gone[i]) continue;
        index[i] = kept.size();
        kept.push_back(std::move(list[i]));
    }
    list = std::move(kept);
    return index;
}

// Takes the ranges out of the binary, each from a multiple of 4 to one, but for what other views have of them.
void cut_bytes(GltfDocument& document, std::vector<Range> gone) {
    std::vector<Range> kept;
    each_place(document.json, [&](Json& place) { kept.push_back(range_of(place)); });
    const auto by_begin = [](const Range& a, const Range& b) { return a.begin < b.begin; };
    std::sort(kept.begin(), kept.end(), by_begin);
    std::sort(gone.begin(), gone.end(), by_begin);
    std::vector<Range> cut;
    std::size_t from = 0; // no range before this is cut
    std::size_t k = 0;
    for (const Range& range : gone) {
        std::size_t at = std::max(range.begin, from);
        const auto take = [&](std::size_t end) {
            const std::size_t first = (at + 3) / 4 * 4, last = end / 4 * 4;
            if (first < last) cut.push_back({first, last});
        };
        for (; k < kept.size() && kept[k].begin < range.end; ++k) {
            if (at < kept[k].begin) take(kept[k].begin);
            at = std::max(at, kept[k].end);
        }
        if (at < range.end) take(range.end), at = range.end;
        from = at;
    }
    std::string left;
    std::size_t copied = 0;
    for (const Range& range : cut) {
        left.append(document.binary, copied, range.begin - copied);
        copied = range.end;
    }
    if (cut.empty()) return;
    left.append(document.binary, copied);
    document.binary = std::move(left);
    std::vector<std::size_t> before{0}; // bytes cut before each of them, in all
    for (const Range& range : cut) before.push_back(before.back() + range.end - range.begin);
    each_place(document.json, [&](Json& place) {
        const std::size_t begin = range_of(place).begin;
        const auto next = std::partition_point(cut.begin(), cut.end(), [&](const Range& r) { return r.begin < begin; });
        if (const std::size_t less = before[std::size_t(next - cut.begin())]; less > 0)
            place["byteOffset"] = begin - less;
    });
}

} // namespace

std::string prune(GltfDocument& document, const std::vector<std::size_t>& accessors) {
    Json& json = document.json;
    if (accessors.empty()) return "";
    if (std::string unknown = gltf_references::unknown_extension(json); !unknown.empty()) return unknown;
    std::vector<char> gone(json.at("accessors").size(), false);
    const auto accessor_of = [&](const Json& index) { return checked_index(index, "an accessor", gone.size()); };
    for (const std::size_t i : accessors) gone.at(i) = true;
    each_accessor_index(json, [&](Json& index) { gone[accessor_of(index)] = false; });
    const std::size_t views = entries_of(json, "bufferViews");
    const auto view_of = [&](const Json& index) { return checked_index(index, "a bufferView", views); };
    std::vector<char> before(views, false), gone_view(views, false);
    each_view_index(json, [&](Json& index) { before[view_of(index)] = true; });
    const std::vector<std::size_t> accessor = leave_out(json["accessors"], gone);
    each_accessor_index(json, [&](Json& index) { index = accessor[accessor_of(index)]; });
    gone_view = before; // that were named, and are not any more
    each_view_index(json, [&](Json& index) { gone_view[view_of(index)] = false; });
    std::vector<Range> bytes;
    for (std::size_t v = 0; v < views; ++v) {
        if (!gone_view[v]) continue;
        Json& view = json["bufferViews"][v];
        if (whole_number(view, "buffer", "a view") == 0) bytes.push_back(range_of(view));
        if (Json* packed = extension(view, "EXT_meshopt_compression");
            packed && whole_number(*packed, "buffer", "a view") == 0)
            bytes.push_back(range_of(*packed));
    }
    if (views > 0) {
        const std::vector<std::size_t> view = leave_out(json["bufferViews"], gone_view);
        each_view_index(json, [&](Json& index) { index = view[view_of(index)]; });
    }
    cut_bytes(document, std::move(bytes));
    return "";
}

} // namespace bough
