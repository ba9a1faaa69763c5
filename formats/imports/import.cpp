#include "import.h"
#include "formats/documents/splines.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "line_ends.h"
#include "placed_import.h"
#include "refused.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

// Tried in this order.
constexpr std::array formats{&armature_format,        // FBX, glTF, COLLADA
                             &speedtree_format,       // <SpeedTreeRaw
                             &ply_format,             // ply
                             &sapling_curves_format,  // JSON of splines
                             &eztree_branches_format, // JSON of origin, orientation, length, radius
                             &sapling_table_format,   // spline,point,x,y,z
                             &treetools_format,       // x,y,z,radius,parent_id
                             &mtg_format,             // CODE:, CLASSES:
                             &cylinder_table_format,  // names of columns: start, end or axis, parent
                             &swc_format,             // seven numbers
                             &obj_format};            // v, l, curv ...

// A file of a known ending that no reader recognizes is damaged: its own reader says best how.
struct Ending {
    std::string_view ends;
    const SplineFormat* format;
};
constexpr std::array endings{Ending{".swc", &swc_format}, Ending{".mtg", &mtg_format}, Ending{".obj", &obj_format}};

const SplineFormat* format_of(std::string_view content, const std::string& name) {
    if (content.starts_with("\xFF\xFE") || content.starts_with("\xFE\xFF")) return nullptr; // UTF-16 (refused.h)
    for (const SplineFormat* format : formats)
        if (format->recognizes(content)) return format;
    if (content.substr(0, 65536).find('\0') != std::string_view::npos) return nullptr;
    const std::string file = lower_case(name);
    for (const Ending& e : endings)
        if (file.ends_with(e.ends)) return e.format;
    return nullptr;
}

} // namespace

bool is_importable(std::string_view content, const std::string& name) {
    if (is_splines(content)) return true;
    const std::string_view head = content.substr(0, std::size_t(1) << 20);
    const std::optional<std::string> lines = with_line_feeds(head);
    return !head.empty() && format_of(lines ? std::string_view(*lines) : content, name);
}

Splines import_splines(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    if (is_splines(content)) {
        notes.format = "bough-splines";
        Splines splines = read_splines(content, options.name);
        refuse_too_far(splines, 0, options.name);
        find_outlier(splines, options.name, notes);
        return splines;
    }
    const std::optional<std::string> lines = with_line_feeds(content);
    if (lines) content = *lines;
    const SplineFormat* format = content.empty() ? nullptr : format_of(content, options.name);
    if (!format) refuse_unread(content, options.name);
    notes.format = format->name;
    Splines splines = format->read(content, options, notes);
    find_outlier(splines, options.name, notes);
    return splines;
}

} // namespace bough
