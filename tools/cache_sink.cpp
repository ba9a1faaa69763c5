#include "exits.h"
#include "formats/exports/float_range.h"
#include "formats/exports/own_mover.h"
#include "formats/exports/point_cache.h"
#include "frame_sink.h"
#include "skin_mover.h"

namespace bough {
namespace {

// A skin that was made: moved whole, as leaves that rustle need their neighbours.
class SkinVertices {
public:
    SkinVertices(Skin skin, const Tree& tree, const RustleMaker& rustle)
        : skin_(std::move(skin)), mover_(skin_, tree, rustle(skin_, false)) {}
    std::size_t count() const { return skin_.position.size(); }
    bool floats_suffice() const { return bough::floats_suffice(skin_.position); }
    void go_to(const MotionFrame& frame) { mover_.move(frame, position_, normal_); }
    void positions(std::size_t first, std::span<Vec3> to) const {
        std::copy_n(position_.begin() + std::ptrdiff_t(first), to.size(), to.begin());
    }

private:
    Skin skin_;
    SkinMover mover_;
    std::vector<Vec3> position_, normal_;
};

// A mesh of its own, which may be a hundred times larger than its file's text where shapes are placed: moved some vertices at a time.
class OwnVertices {
public:
    OwnVertices(OwnMesh mesh, const Tree& tree) : mesh_(std::move(mesh)), mover_(mesh_, tree) {}
    std::size_t count() const { return mover_.vertices(); }
    bool floats_suffice() const {
        std::vector<Vec3> seen; // where shapes are placed stands for all of them
        for (const OwnPart& part : mesh_.part) {
            for (const Eigen::Vector3f& p : part.standing.position) widen(seen, p);
            for (const OwnPlace& place : part.placed) widen(seen, place.place);
        }
        return bough::floats_suffice(seen);
    }
    void go_to(const MotionFrame& frame) { mover_.go_to(frame); }
    void positions(std::size_t first, std::span<Vec3> to) const { mover_.positions(first, to); }

private:
    // Two corners of a box about all points.
    static void widen(std::vector<Vec3>& box, const Eigen::Vector3f& p) {
        const Vec3 point = p.cast<double>();
        if (box.empty()) box = {point, point};
        box[0] = box[0].cwiseMin(point);
        box[1] = box[1].cwiseMax(point);
    }

    OwnMesh mesh_;
    OwnMover mover_;
};

// A model's own mesh, moved by its bones.
class DrivenVertices {
public:
    explicit DrivenVertices(DrivenMesh mesh) : mesh_(std::move(mesh)) {}
    std::size_t count() const { return mesh_.vertices(); }
    bool floats_suffice() const {
        std::vector<Vec3> drawn(mesh_.vertices());
        mesh_.positions(0, drawn);
        return bough::floats_suffice(drawn);
    }
    void go_to(const MotionFrame& frame) { mesh_.go_to(frame); }
    void positions(std::size_t first, std::span<Vec3> to) const { mesh_.positions(first, to); }

private:
    DrivenMesh mesh_;
};

// A mesh whose pieces move in ways of their own.
class MovedVertices {
public:
    explicit MovedVertices(MovedMesh mesh) : skin_(std::move(mesh.skin)), mover_(mesh.mover(skin_, {})) {}
    std::size_t count() const { return skin_.position.size(); }
    bool floats_suffice() const { return bough::floats_suffice(skin_.position); }
    void go_to(const MotionFrame& frame) { mover_(frame, position_, normal_); }
    void positions(std::size_t first, std::span<Vec3> to) const {
        std::copy_n(position_.begin() + std::ptrdiff_t(first), to.size(), to.begin());
    }

private:
    Skin skin_;
    Mover mover_;
    std::vector<Vec3> position_, normal_;
};

template <class Vertices> class CacheSink : public FrameSink {
public:
    template <class... From>
    CacheSink(const std::string& file, PointCache kind, PointCacheShape shape, std::vector<std::string>& notes,
              From&&... from)
        : output_(file), vertices_(std::forward<From>(from)...), writer_(output_, kind, with_vertices(shape)) {
        if (!vertices_.floats_suffice())
            notes.push_back("-o: the tree stands so far from the origin that the cache's floats are coarser than 1e-6 "
                            "of its size");
    }
    void write(const MotionFrame& frame) override {
        vertices_.go_to(frame);
        writer_.write([this](std::size_t first, std::span<Vec3> to) { vertices_.positions(first, to); });
    }
    void finish() override {
        writer_.finish();
        output_.finish();
    }
    std::uint64_t bytes() const override { return output_.bytes(); }

private:
    PointCacheShape with_vertices(PointCacheShape shape) const {
        shape.vertices = vertices_.count();
        return shape;
    }

    Output output_;
    Vertices vertices_;
    PointCacheWriter writer_;
};

template <class Vertices, class... From>
std::unique_ptr<FrameSink> cache_of(const std::string& file, const std::string& format, const CacheFrames& frames,
                                    std::vector<std::string>& notes, From&&... from) {
    PointCacheShape shape;
    shape.frames = frames.count;
    shape.first = frames.first;
    shape.fps = frames.fps;
    const PointCache kind = format == "mdd" ? PointCache::mdd : PointCache::pc2;
    try {
        return std::make_unique<CacheSink<Vertices>>(file, kind, shape, notes, std::forward<From>(from)...);
    } catch (const std::length_error& error) {
        throw UsageError("-o is '" + file + "': " + error.what());
    }
}

} // namespace

std::unique_ptr<FrameSink> cache_sink(const std::string& file, const std::string& format, const Tree& tree, Skin skin,
                                      const RustleMaker& rustle, const CacheFrames& frames,
                                      std::vector<std::string>& notes) {
    return cache_of<SkinVertices>(file, format, frames, notes, std::move(skin), tree, rustle);
}

std::unique_ptr<FrameSink> own_cache_sink(const std::string& file, const std::string& format, const Tree& tree,
                                          OwnMesh mesh, const CacheFrames& frames, std::vector<std::string>& notes) {
    return cache_of<OwnVertices>(file, format, frames, notes, std::move(mesh), tree);
}

std::unique_ptr<FrameSink> moved_cache_sink(const std::string& file, const std::string& format, MovedMesh mesh,
                                            const CacheFrames& frames, std::vector<std::string>& notes) {
    return cache_of<MovedVertices>(file, format, frames, notes, std::move(mesh));
}

std::unique_ptr<FrameSink> driven_cache_sink(const std::string& file, const std::string& format, DrivenMesh mesh,
                                             const CacheFrames& frames, std::vector<std::string>& notes) {
    return cache_of<DrivenVertices>(file, format, frames, notes, std::move(mesh));
}

} // namespace bough
