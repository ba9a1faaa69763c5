// A SpeedTree file's own mesh, bound to the tree that is made of the same file.
#include "formats/models/speedtree_model.h"
#include "fuzzing.h"
#include "lib/growth/segment.h"
#include "lib/model/wood.h"
#include <stdexcept>

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        if (!has_speedtree_mesh(content)) return;
        ImportOptions options;
        options.name = "file";
        ImportNotes notes;
        const Splines splines = speedtree_format.read(content, options, notes);
        std::vector<std::string> lines;
        Tree tree;
        try {
            tree = segment(splines, wood_presets().front(), {});
        } catch (const std::invalid_argument&) {
            return; // wood that cannot stand, say: the mesh is not reached
        }
        const OwnMesh mesh =
            bound_to(read_speedtree_model(content, "", notes, notes), tree, Eigen::Affine3d::Identity(), lines);
        for (const std::string& line : lines) fuzzing::check_message(line, content);
        if (mesh.part.empty() && lines.empty()) fuzzing::fail("nothing is bound, and nothing is said");
    });
    return 0;
}
