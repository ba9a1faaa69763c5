// files.h: the door of bough's files: species, documents and motions by file name (bough::files). With bough.h all that a program needs:
//
//   bough::Scene scene = bough::read_scene("park.json");          // and its trees, each file once
//   bough::Simulation simulation(scene);
//   bough::MotionFile motion("park.jsonl", simulation);
//   for (int frame = 0; frame < 90; ++frame) {
//       if (!simulation.step().finite()) return 3;
//       motion.write(simulation);
//   }
//   motion.finish();
//
// A name of "-" is stdin or stdout. A document is told by its content, .safetensors as an output's name asks for the binary form.
// Errors. InputError: a file that is missing, broken or refused, "PLACE: what is wrong, what was expected". OutputError: one that cannot be
// written; what is not finished does not appear under its name. SceneError: what a call asks for and is not there.
#pragma once
#include "bough.h"
#include "error.h"
#include <memory>
#include <string>
#include <vector>

namespace bough {

struct GrowOptions {
    // Of the tree that convert() makes of it, within 10 %, foliage included; 0: as many as the species has
    std::int64_t bodies = 0;
    std::uint64_t seed = 0;
    double age = 0; // [years], 0.1 or more; 0: a mature tree
    bool leaves = false, petals = false, fruit = false;
};
std::vector<std::string> species_names();
// Grows a tree of a species that comes with bough, as does `treegen --species NAME`. Throws SceneError for another name.
Splines grow(const std::string& species, const GrowOptions& = {});
// Makes rigid bodies of the splines' own wood, by treeconvert's defaults. Throws SceneError for splines without length.
Tree convert(const Splines&);

Splines read_splines(const std::string& file); // a bough-splines document
Tree read_tree(const std::string& file);       // a bough-tree document
// Reads a bough-scene document with its trees in memory. Where it has /material, these are no longer the files' trees, and Placement::file is empty.
Scene read_scene(const std::string& file);
void write_splines(const std::string& file, const Splines&);
void write_tree(const std::string& file, const Tree&);
// Writes a scene as a bough-scene document. The scene's document names its trees' files and does not hold them. Give each place the name of a file
// (Placement::file, relative to the document's folder), and write its tree there by write_tree. read_scene has put /material into the trees: write
// those again under names of their own. Throws OutputError for a place without a file, and for two trees of one file.
void write_scene(const std::string& file, const Scene&);
SavedState read_state(const std::string& file); // as `treesim --save-state` and write_state write it
void write_state(const std::string& file, const SavedState&);

// Writes a run's motion as a bough-motion document: .jsonl, .json or .safetensors.
class MotionFile {
public:
    // Writes no frame yet. fps [1/s]: of the frames that will be written; 0: one a step. Throws SceneError for an fps below 0 or not finite.
    MotionFile(const std::string& file, const Simulation&, double fps = 0);
    MotionFile(MotionFile&&) noexcept;
    ~MotionFile(); // what is not finished is removed
    // Writes the run's present state as the next frame. Throws SceneError, and writes nothing, for a run of other bodies or fields than the first's.
    // Throws OutputError, and writes nothing, for a number above 3.4e38, which no float can say: who reads the file may keep floats.
    void write(const Simulation&);
    void finish();

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

} // namespace bough
