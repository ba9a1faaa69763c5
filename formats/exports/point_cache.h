// point_cache.h: a mesh's moving vertices as a point cache, for programs that move a mesh of their own by it: MDD
// (LightWave) and PC2 (3ds Max), both read by Blender's modifier Mesh Cache.
//
// A cache holds no mesh: only where each vertex is in each frame, in the order of the mesh that it goes with (the one that
// write_obj writes). Coordinates are floats [m], axes those of the mesh (Y up).
//   MDD  big-endian: int32 frames, int32 vertices; float32 time [s] of each frame; then x y z of each vertex, frame after
//        frame.
//   PC2  little-endian: "POINTCACHE2\0", int32 version 1, int32 vertices, float32 number of the first frame, float32
//        frames a sample (1), int32 frames; then as above.
// The head is written first, for as many frames as are promised, so that a pipe can take it; of fewer frames (an interrupt)
// finish() mends it, where the output is a file.
// Cost: O(vertices) a frame, memory 2.3 MB however many frames and vertices.
// Errors  OutputError for coordinates beyond floats, for what the Output cannot take, and for fewer frames than promised in
//         a pipe; std::length_error for more frames or vertices than an int32 counts.
#pragma once
#include "formats/open.h"
#include "lib/base/math.h"
#include <functional>
#include <span>
#include <vector>

namespace bough {

enum class PointCache { mdd, pc2 };

struct PointCacheShape {
    std::size_t vertices = 0;
    std::int64_t frames = 0; // promised
    std::int64_t first = 0;  // number of the first; its time is first / fps
    double fps = 30;
};

class PointCacheWriter {
public:
    // Keeps a reference to the Output and writes the head.
    PointCacheWriter(Output&, PointCache, const PointCacheShape&);
    // The next frame: fill(first, to) gives the positions of the vertices from `first` on, as many as `to` holds, and is called for one block after
    // the other, up to as many as promised.
    void write(const std::function<void(std::size_t first, std::span<Vec3> to)>& fill);
    // Once; the caller finishes the Output.
    void finish();

private:
    Output& output_;
    PointCache kind_;
    PointCacheShape shape_;
    std::int64_t written_ = 0;
    std::vector<Vec3> position_; // of a block
};

} // namespace bough
