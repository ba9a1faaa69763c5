// baked_sinks.h: treesim's frames as engines and film pipelines want them: OpenVAT (formats/exports/vat.h) and USD (formats/exports/usda.h).
#pragma once
#include "frame_sink.h"

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

inline double height_of(const Skin& skin) {
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& p : skin.position) low = std::min(low, p.y()), high = std::max(high, p.y());
    return high - low;
}

struct VatFrames {
    double fps = 30;
    std::int64_t count = 0; // promised
    bool looping = false;
    bool of_file = false; // they show a file's own mesh
};

// Written by finish(). own: what the skin was made of. Keeps references to the tree and the notes. Throws UsageError for more vertices or frames than a texture holds.
std::unique_ptr<FrameSink> vat_sink(const std::string& folder, const Tree&, Skin, std::optional<OwnMesh> own,
                                    const RustleMaker&, const VatFrames&, const VatChoice&, const std::string& source,
                                    std::vector<std::string>& notes);

// The same of a model's own mesh, moved by its bones.
std::unique_ptr<FrameSink> driven_vat_sink(const std::string& folder, const Tree&, DrivenMesh, const VatFrames&,
                                           const VatChoice&, const std::string& source,
                                           std::vector<std::string>& notes);

// One .usda, written by finish(), and its images in a folder beside it. Keeps references to the tree and the notes. Throws UsageError for images beside stdout, and for one that would replace a file of `read`.
std::unique_ptr<FrameSink> usda_sink(const std::string& file, const Tree&, Skin, std::optional<OwnMesh> own, double fps,
                                     const GltfChoice&, const std::string& source, const std::vector<NamedFile>& read,
                                     std::vector<std::string>& notes);

} // namespace bough
