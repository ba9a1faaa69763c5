// baked_sinks.h: treesim's frames as engines and film pipelines want them: OpenVAT (formats/exports/vat.h) and USD (formats/exports/usda.h).
#pragma once
#include "frame_sink.h"
#include "rigged_mesh.h"
#include "skin_mover.h"

namespace bough {

// --vat-vertices and --vat-image.
struct VatChoice {
    std::optional<int> vertices; // at most; none: as many as the mesh has
    std::string image;           // "exr", "png"; empty: exr
    const char* given() const { return vertices ? "--vat-vertices" : !image.empty() ? "--vat-image" : nullptr; }
    bool png() const { return image == "png"; }
};
void add_vat_options(OptionList&, VatChoice&);

// "oak" of oak_vat/. Throws UsageError for a folder that is called otherwise.
std::string vat_name(const std::string& folder);
// The files that are written there, with the folder.
std::vector<std::string> vat_outputs(const std::string& folder, const VatChoice&);

struct VatFrames {
    double fps = 30;
    std::int64_t count = 0; // promised
    bool looping = false;
    bool of_file = false; // they show a file's own mesh
};

// Written by finish(). Notes: what --vat-vertices left out. Throws UsageError for more vertices or frames than a texture holds.
std::unique_ptr<FrameSink> vat_sink(const std::string& folder, const Tree&, MovedMesh, const VatFrames&,
                                    const VatChoice&, const std::string& source, std::vector<std::string>& notes);

// One .usda, written by finish(), and its images in a folder beside it. name: the tree's. Throws UsageError for images beside stdout, and for one
// that would replace a file of `read`.
std::unique_ptr<FrameSink> usda_sink(const std::string& file, const std::string& name, RiggedMesh, double fps,
                                     const std::string& source, const std::vector<NamedFile>& read);

} // namespace bough
