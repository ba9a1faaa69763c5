#include "saved_tree.h"
#include "exits.h"
#include "formats/documents/tree.h"
#include "formats/open.h"
#include "lib/plan/posed_tree.h"

namespace bough {

void require_one_tree(const Setting& setting) {
    if (setting.ranges.size() != 1)
        throw UsageError("--save-tree: the scene has " + std::to_string(setting.ranges.size()) +
                         " trees, expected one: a document holds one tree");
}

template <class T>
void save_tree(const std::string& file, const Setting& setting, Run<T>& run, const CommonOptions& common) {
    if (!run.world.broken.empty())
        throw OutputError(file, "--save-tree: " + std::to_string(run.world.broken.size()) +
                                    " joints broke in this run, expected a whole tree");
    present(run.plan, run.state);
    Tree tree = posed_tree(run.plan, run.state, setting.tree);
    tree.source = with_command_line(setting.source, common);
    Output output(file);
    write_tree(output, tree, form_of_name(file));
    output.finish();
}

template void save_tree(const std::string&, const Setting&, Run<float>&, const CommonOptions&);
template void save_tree(const std::string&, const Setting&, Run<double>&, const CommonOptions&);

} // namespace bough
