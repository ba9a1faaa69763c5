#include "import.h"
#include "error.h"
#include "plain_text.h"
#include "splines.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

// Tried in this order.
constexpr std::array<const SplineFormat*, 7> formats{
    &speedtree_format, &ply_format,  &sapling_curves_format, &sapling_table_format,
    &treetools_format, &swc_format, &obj_format};

constexpr const char* raw_xml = "; export it from SpeedTree as Raw XML with spines or bones";
constexpr const char* readable =
    "expected bough-splines (JSON or safetensors), SpeedTree raw XML, a treetools tree file, an SWC or PLY skeleton, OBJ "
    "lines or curves, or curves of Blender (CSV or JSON)";

// Files that people have and that hold no skeleton we can read: how they begin, what they are, what to do.
struct Refused {
    std::string_view begins;
    const char* is;
    const char* advice;
};
constexpr std::array<Refused, 16> refused{{
    {"SRT ", "a compiled SpeedTree tree (.srt), which holds no skeleton", raw_xml},
    {"SpeedTree", "a compiled SpeedTree tree, which holds no skeleton", raw_xml},
    {"Ogawa", "an Alembic cache", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"\x89HDF", "an Alembic (HDF5) cache or another HDF5 file",
     "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"PXR-USDC", "a USD file", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"#usda", "a USD file", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"PK\x03\x04", "a ZIP or USDZ archive", "; unpack it or export the tree as SpeedTree raw XML"},
    {"\x1F\x8B", "compressed by gzip", "; unpack it first"},
    {"glTF", "a glTF mesh", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"Kaydara FBX", "an FBX model", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"; FBX", "an FBX model", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"BLENDER", "a Blender scene", "; export the tree as SWC or a treetools tree file"},
    {"MATLAB", "a MATLAB file", "; write the cylinders as an SWC skeleton or a treetools tree file"},
    {"xof ", "a DirectX model", "; export the tree as SpeedTree raw XML, SWC or a treetools tree file"},
    {"\xFF\xFE", "UTF-16 text", "; save it as UTF-8"},
    {"\xFE\xFF", "UTF-16 text", "; save it as UTF-8"},
}};

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return out;
}

bool ends_with(const std::string& name, std::string_view ending) {
    return name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::string what_xml(std::string_view head) {
    if (head.find("<arbaro") != std::string_view::npos || head.find("<species") != std::string_view::npos)
        return "is an Arbaro species, parameters of a generator and no tree, ";
    if (head.find("<COLLADA") != std::string_view::npos) return "is a COLLADA model, ";
    return "is XML, but not SpeedTree raw XML (<SpeedTreeRaw>), ";
}

[[noreturn]] void refuse(std::string_view content, const std::string& name) {
    const std::string file = lower(name);
    for (const char* ending : {".srt", ".spm", ".st", ".st9", ".stsdk"})
        if (ends_with(file, ending))
            throw InputError(name, std::string("is a SpeedTree file (") + ending + ") that holds no readable skeleton" +
                                       raw_xml);
    for (const Refused& r : refused)
        if (content.substr(0, r.begins.size()) == r.begins)
            throw InputError(name, std::string("is ") + r.is + r.advice);
    const std::string_view head = content.substr(0, 4096);
    const std::size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string_view::npos) throw InputError(name, std::string("is blank, ") + readable);
    const std::size_t document = head.find("\"bough-");
    if (document != std::string_view::npos)
        throw InputError(name, "is a document of kind " +
                                   quoted(head.substr(document + 1, head.find('"', document + 1) - document - 1)) +
                                   ", expected bough-splines or a foreign tree");
    if (head[first] == '<') throw InputError(name, what_xml(head) + readable);
    if (head.find('\0') != std::string_view::npos)
        throw InputError(name, std::string("is binary data of an unknown format, ") + readable);
    throw InputError(name, std::string("is of an unknown format, ") + readable);
}

} // namespace

Splines import_splines(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    if (content.empty()) throw InputError(options.name, std::string("is empty, ") + readable);
    if (is_splines(content)) return read_splines(content, options.name);
    for (const SplineFormat* format : formats)
        if (format->recognizes(content)) return format->read(content, options, notes);
    // A damaged file of a known ending is better described by its own reader than by "unknown format".
    if (ends_with(lower(options.name), ".swc") && content.find('\0') == std::string_view::npos)
        return swc_format.read(content, options, notes);
    if (ends_with(lower(options.name), ".obj") && content.find('\0') == std::string_view::npos)
        return obj_format.read(content, options, notes);
    refuse(content, options.name);
}

} // namespace bough
