#include "point_cache.h"
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

void add_word(std::string& text, std::uint32_t word, PointCache kind) {
    for (int k = 0; k < 4; ++k) text.push_back(char(word >> (kind == PointCache::mdd ? 24 - 8 * k : 8 * k) & 255));
}

void add_float(std::string& text, float value, PointCache kind) {
    add_word(text, std::bit_cast<std::uint32_t>(value), kind);
}

constexpr std::uint64_t mdd_times = 8, pc2_count = 28; // where they stand

} // namespace

PointCacheWriter::PointCacheWriter(Output& output, PointCache kind, const PointCacheShape& shape)
    : output_(output), kind_(kind), shape_(shape) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    if (shape.frames > most || shape.vertices > std::size_t(most))
        throw std::length_error(std::to_string(shape.frames) + " frames of " + std::to_string(shape.vertices) +
                                " vertices, but a point cache counts either to 2^31 - 1");
    const auto frames = std::uint32_t(shape.frames), vertices = std::uint32_t(shape.vertices);
    std::string head;
    if (kind == PointCache::mdd) {
        add_word(head, frames, kind);
        add_word(head, vertices, kind);
        for (std::int64_t f = 0; f < shape.frames; ++f) {
            add_float(head, float(double(shape.first + f) / shape.fps), kind);
            if (head.size() < 4096) continue;
            output_.write(head);
            head.clear();
        }
    } else {
        head.assign("POINTCACHE2", 12);
        add_word(head, 1, kind);
        add_word(head, vertices, kind);
        add_float(head, float(shape.first), kind);
        add_float(head, 1, kind);
        add_word(head, frames, kind);
    }
    output_.write(head);
}

void PointCacheWriter::write(const std::function<void(std::size_t, std::span<Vec3>)>& fill) {
    assert(written_ < shape_.frames);
    constexpr std::size_t block = 65536; // vertices
    std::string bytes;
    for (std::size_t first = 0; first < shape_.vertices; first += block) {
        position_.resize(std::min(block, shape_.vertices - first));
        fill(first, position_);
        bytes.clear();
        for (std::size_t v = 0; v < position_.size(); ++v)
            for (int k = 0; k < 3; ++k) {
                const float value = float(position_[v][k]);
                if (!std::isfinite(value))
                    throw OutputError(output_.name(),
                                      "frame " + std::to_string(shape_.first + written_) + ": vertex " +
                                          std::to_string(first + v) +
                                          " lies farther out than a float, which the format has, can say");
                add_float(bytes, value, kind_);
            }
        output_.write(bytes);
    }
    ++written_;
}

void PointCacheWriter::finish() {
    if (written_ == shape_.frames) return;
    if (!output_.changeable())
        throw OutputError(output_.name(), "ended after " + std::to_string(written_) + " of " +
                                              std::to_string(shape_.frames) +
                                              " frames, whose number its head has told the reader already");
    std::string count;
    add_word(count, std::uint32_t(written_), kind_);
    output_.replace(kind_ == PointCache::mdd ? 0 : pc2_count, count);
    if (kind_ == PointCache::mdd)
        output_.take_out(mdd_times + 4 * std::uint64_t(written_), 4 * std::uint64_t(shape_.frames - written_));
}

} // namespace bough
