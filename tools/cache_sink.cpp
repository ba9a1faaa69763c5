#include "exits.h"
#include "formats/exports/float_range.h"
#include "formats/exports/point_cache.h"
#include "frame_sink.h"
#include "skin_mover.h"

namespace bough {
namespace {

class CacheSink : public FrameSink {
public:
    CacheSink(const std::string& file, PointCache kind, const Tree& tree, Skin skin, const RustleMaker& rustle,
              PointCacheShape shape, std::vector<std::string>& notes)
        : output_(file), skin_(std::move(skin)), mover_(skin_, tree, rustle(skin_, false)),
          writer_(output_, kind, with_vertices(shape)) {
        if (!floats_suffice(skin_.position))
            notes.push_back("-o: the tree stands so far from the origin that the cache's floats are coarser than 1e-6 "
                            "of its size");
    }
    void write(const MotionFrame& frame) override {
        mover_.move(frame, position_, normal_);
        writer_.write(position_);
    }
    void finish() override {
        writer_.finish();
        output_.finish();
    }
    std::uint64_t bytes() const override { return output_.bytes(); }

private:
    PointCacheShape with_vertices(PointCacheShape shape) const {
        shape.vertices = skin_.position.size();
        return shape;
    }

    Output output_;
    Skin skin_;
    SkinMover mover_;
    PointCacheWriter writer_;
    std::vector<Vec3> position_, normal_;
};

} // namespace

std::unique_ptr<FrameSink> cache_sink(const std::string& file, const std::string& format, const Tree& tree, Skin skin,
                                      const RustleMaker& rustle, double fps, std::int64_t first, std::int64_t frames,
                                      std::vector<std::string>& notes) {
    PointCacheShape shape;
    shape.frames = frames;
    shape.first = first;
    shape.fps = fps;
    const PointCache kind = format == "mdd" ? PointCache::mdd : PointCache::pc2;
    try {
        return std::make_unique<CacheSink>(file, kind, tree, std::move(skin), rustle, shape, notes);
    } catch (const std::length_error& error) {
        throw UsageError("-o is '" + file + "': " + error.what());
    }
}

} // namespace bough
