#include "refused.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr const char* readable = "expected bough-splines or a tree file of another program (see treegen --help)";
constexpr const char* raw_xml = "export it from SpeedTree as Raw XML with spines or bones";
constexpr const char* skeleton =
    "export the tree as glTF or FBX with its armature, as an SWC skeleton or as SpeedTree raw XML";
constexpr const char* cylinders = "write the cylinders as text (TreeQSM: save_model_text.m) or as CSV";
constexpr const char* scene = "export the tree's skeleton from its program as SWC or another text format";
constexpr const char* unpack = "unpack it first";

// A file that is known and not read: what tells it, what it is, what to do.
struct Known {
    std::string_view mark;
    const char* is;
    const char* advice;
};
// How it begins, with '?' for any byte.
constexpr std::array<Known, 28> begins{{
    {"SRT ", "a compiled SpeedTree tree (.srt), which holds no skeleton", raw_xml},
    {"SpeedTree", "a compiled SpeedTree tree, which holds no skeleton", raw_xml},
    {"????SpeedTree", "a compiled SpeedTree tree, which holds no skeleton", raw_xml},
    {"Ogawa", "an Alembic cache", skeleton},
    {"\x89HDF", "an Alembic cache or another HDF5 file", skeleton},
    {"PXR-USDC", "a USD file", skeleton},
    {"#usda", "a USD file", skeleton},
    {"PK\x03\x04", "a ZIP or USDZ archive", unpack},
    {"\x1F\x8B", "compressed by gzip", unpack},
    {"BZh", "compressed by bzip2", unpack},
    {"\xFD"
     "7zXZ",
     "compressed by xz", unpack},
    {"7z\xBC\xAF", "a 7-Zip archive", unpack},
    {"\x28\xB5\x2F\xFD", "compressed by zstd", unpack},
    {"BLENDER", "a Blender scene", scene},
    {"//Maya ASCII", "a Maya scene", scene},
    {"FOR4", "a Maya scene", scene},
    {"FOR8", "a Maya scene", scene},
    {"\xD0\xCF\x11\xE0", "an OLE file (a 3ds Max scene or an office document)", scene},
    {"HOUNC", "a Houdini scene or geometry", scene},
    {"HouNC", "a Houdini scene or geometry", scene},
    {"QC4DC4D", "a Cinema 4D scene", scene},
    {"MATLAB", "a MATLAB file", cylinders},
    {"LASF", "a LAS point cloud, which holds no skeleton",
     "reconstruct it (TreeQSM, SimpleForest, rayextract, AdTree)"},
    {"xof ", "a DirectX model", skeleton},
    {"MM??", "a 3D Studio model", skeleton},
    {"solid ", "an STL model, which holds no skeleton", skeleton},
    {"\xFF\xFE", "UTF-16 text", "save it as UTF-8"},
    {"\xFE\xFF", "UTF-16 text", "save it as UTF-8"},
}};

// What its name ends with, where the content says nothing.
constexpr std::array<Known, 29> known_endings{{
    {".srt", "a compiled SpeedTree tree (.srt), which holds no readable skeleton", raw_xml},
    {".spm", "a SpeedTree Modeler file (.spm), which holds no readable skeleton", raw_xml},
    {".st", "a SpeedTree file (.st), which holds no readable skeleton", raw_xml},
    {".st9", "a SpeedTree file (.st9), which holds no readable skeleton", raw_xml},
    {".stsdk", "a SpeedTree file (.stsdk), which holds no readable skeleton", raw_xml},
    {".mat", "a MATLAB file", cylinders},
    {".rdata", "an R workspace", "write the cylinders as CSV"},
    {".rds", "an R object", "write the cylinders as CSV"},
    {".parquet", "a Parquet table", "write the cylinders as CSV"},
    {".abc", "an Alembic cache", skeleton},
    {".usd", "a USD file", skeleton},
    {".usda", "a USD file", skeleton},
    {".usdc", "a USD file", skeleton},
    {".usdz", "a USD archive", skeleton},
    {".ma", "a Maya scene", scene},
    {".mb", "a Maya scene", scene},
    {".max", "a 3ds Max scene", scene},
    {".blend", "a Blender scene", scene},
    {".c4d", "a Cinema 4D scene", scene},
    {".hip", "a Houdini scene", scene},
    {".lwo", "a LightWave model", skeleton},
    {".grove", "a document of The Grove", scene},
    {".3ds", "a 3D Studio model", skeleton},
    {".x", "a DirectX model", skeleton},
    {".stl", "an STL model, which holds no skeleton", skeleton},
    {".las", "a LAS point cloud, which holds no skeleton",
     "reconstruct it (TreeQSM, SimpleForest, rayextract, AdTree)"},
    {".laz", "a LAS point cloud, which holds no skeleton",
     "reconstruct it (TreeQSM, SimpleForest, rayextract, AdTree)"},
    {".bin", "a buffer of other data", "name the .gltf that it belongs to"},
    {".mtl", "the materials of a Wavefront OBJ and no tree", "name the .obj that it belongs to"},
}};

bool matches(std::string_view content, std::string_view pattern) {
    if (content.size() < pattern.size()) return false;
    for (std::size_t k = 0; k < pattern.size(); ++k)
        if (pattern[k] != '?' && pattern[k] != content[k]) return false;
    return true;
}

const Known* known_begin(std::string_view content) {
    for (const Known& begin : begins)
        if (matches(content, begin.mark)) return &begin;
    return nullptr;
}

const Known* known_ending(const std::string& name) {
    const std::string file = lower_case(name);
    for (const Known& ending : known_endings)
        if (file.ends_with(ending.mark)) return &ending;
    return nullptr;
}

[[noreturn]] void refuse(const std::string& name, const std::string& is, const std::string& advice) {
    throw InputError(name, "is " + is + "; " + advice);
}

bool holds(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

void refuse_xml(std::string_view head, const std::string& name) {
    if (holds(head, "<arbaro") || holds(head, "<species"))
        refuse(name, "an Arbaro species, parameters of a generator and no tree", "treegen --params grows it");
    if (holds(head, "<html") || holds(head, "<HTML") || holds(head, "<!DOCTYPE html"))
        refuse(name, "a web page", "download the file itself");
    refuse(name, "XML, but neither SpeedTree raw XML (<SpeedTreeRaw>) nor an Arbaro species", raw_xml);
}

void refuse_json(std::string_view head, const std::string& name) {
    const std::size_t document = head.find("\"bough-");
    if (document != std::string_view::npos && holds(head, "\"bough-tree\""))
        refuse(name, "a document of kind \"bough-tree\", a tree that was converted already",
               "convert what it was made of again, which its \"source\" names; roots alone become softer by --set "
               "material.root_stiffness=K of treesim and treeprofile");
    if (document != std::string_view::npos)
        throw InputError(name,
                         "is a document of kind " +
                             in_ascii_quotes(head.substr(document + 1, head.find('"', document + 1) - document - 1)) +
                             ", expected bough-splines or a foreign tree");
    for (const char* key : {"\"gnarliness\"", "\"curveRes\"", "\"g_scale\"", "\"levels\""})
        if (holds(head, key)) refuse(name, "parameters of a generator and no tree", "treegen --params grows them");
}

} // namespace

bool is_known_unread(std::string_view content, const std::string& name) {
    if (known_begin(content)) return true;
    const std::size_t first = text_start(content.substr(0, 4096));
    return first < content.size() && content[first] != '{' && known_ending(name);
}

void refuse_unread(std::string_view content, const std::string& name) {
    if (content.empty()) throw InputError(name, std::string("is empty, ") + readable);
    if (const Known* begin = known_begin(content)) refuse(name, begin->is, begin->advice);
    const std::string_view head = content.substr(0, 4096);
    const std::size_t first = text_start(head);
    if (first == head.size()) throw InputError(name, std::string("is blank, ") + readable);
    if (const Known* ending = known_ending(name)) refuse(name, ending->is, ending->advice);
    if (head[first] == '<') refuse_xml(head, name);
    refuse_json(head, name);
    if (holds(head, std::string_view("\0", 1)))
        throw InputError(name, std::string("is binary data of an unknown format, ") + readable);
    throw InputError(name, std::string("is of an unknown format, ") + readable);
}

} // namespace bough
