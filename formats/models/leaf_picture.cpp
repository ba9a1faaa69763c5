#include "lib/growth/blade.h"
#include "picture.h"
#include "picture_noise.h"
#include <functional>
#include <numbers>

namespace bough {
namespace {

struct Vein {
    Vec2 from, to;
    double half; // [1] its half width at its foot, of the leaf's length
};

// A leaf laid flat: its margin, and its veins.
struct FlatLeaf {
    std::vector<Vec2> margin; // closed, around both halves
    std::vector<Vein> veins;
    std::vector<double> needles;
    double petiole, narrow;
};

// Where a ray from `from` leaves the half outline.
double reach_of(const std::vector<Vec2>& half, const Vec2& from, const Vec2& way) {
    double farthest = 0;
    for (std::size_t k = 0; k + 1 < half.size(); ++k) {
        const Vec2 edge = half[k + 1] - half[k], to = half[k] - from;
        const double turn = way.x() * edge.y() - way.y() * edge.x();
        if (std::abs(turn) < 1e-12) continue;
        const double t = (to.x() * edge.y() - to.y() * edge.x()) / turn,
                     s = (to.x() * way.y() - to.y() * way.x()) / turn;
        if (t > 1e-6 && s >= 0 && s <= 1 && (farthest == 0 || t < farthest)) farthest = t;
    }
    return farthest;
}

void add_both(std::vector<Vein>& veins, const Vec2& from, const Vec2& to, double half) {
    veins.push_back({from, to, half});
    veins.push_back({Vec2(-from.x(), from.y()), Vec2(-to.x(), to.y()), half});
}

FlatLeaf flat_leaf(const LeafForm& form, double width) {
    FlatLeaf leaf;
    leaf.petiole = form.petiole;
    leaf.needles = needle_angles(form);
    const std::vector<Vec2> half = leaf_half(form, width, 7);
    LeafForm plain = form;
    plain.teeth = 0;
    const std::vector<Vec2> smooth = leaf_half(plain, width, 7);
    leaf.margin = half;
    for (std::size_t k = half.size(); k-- > 0;)
        if (half[k].x() > 0) leaf.margin.emplace_back(-half[k].x(), half[k].y());
    const Vec2 foot(0, form.petiole);
    const double narrow = leaf.narrow = std::min(1.0, width / 0.5); // thinner veins in a narrow blade
    leaf.veins.push_back({Vec2(0, 0), Vec2(0, 1), 0.011 * narrow});
    if (form.veins == "parallel") {
        for (const double x : {0.25, 0.5, 0.75})
            add_both(leaf.veins, Vec2(x * width / 2, form.petiole), Vec2(0.3 * x * width / 2, 1), 0.003 * narrow);
        return leaf;
    }
    if (form.veins == "palmate")
        for (std::size_t k = 2; k + 2 < smooth.size(); ++k) {
            const double r = (smooth[k] - foot).norm();
            bool tip = r > 0.2 && smooth[k].x() > 0.05 * width;
            for (std::size_t j = k < 6 ? 0 : k - 6; j < std::min(k + 7, smooth.size()); ++j)
                tip &= (smooth[j] - foot).norm() <= r;
            if (!tip) continue;
            add_both(leaf.veins, foot, foot + 0.97 * (smooth[k] - foot), 0.008);
            for (int n = 2; n < 6; ++n) // its own side veins
                for (const double side : {0.8, -0.8}) {
                    const Vec2 at = foot + n / 6.5 * (smooth[k] - foot),
                               way = Eigen::Rotation2Dd(side) * Vec2((smooth[k] - foot) / r);
                    add_both(leaf.veins, at, at + 0.9 * std::min(0.2, reach_of(smooth, at, way)) * way, 0.0025);
                }
        }
    const int pairs = form.veins == "palmate" ? 5 : 8;
    for (int k = 0; k < pairs; ++k) {
        const double along = form.veins == "palmate" ? 0.35 + 0.5 * k / pairs : 0.04 + 0.82 * k / pairs;
        const Vec2 at(0, form.petiole + (1 - form.petiole) * along);
        const double angle = 0.95 - 0.35 * along;
        const Vec2 way(std::sin(angle), std::cos(angle));
        add_both(leaf.veins, at, at + 0.93 * reach_of(smooth, at, way) * way, 0.0045 * narrow);
    }
    return leaf;
}

// Colours of a leaf's faces, and of its stalk.
struct Paint {
    Vec3 leaf, bark;
};

// What is seen at a place of the leaf.
Vec3 color_at(const FlatLeaf& leaf, const Paint& paint, const Vec2& p, bool lower, double shade) {
    const double spots = octaves(0.37 + 0.5 * p.x(), 0.11 + 0.5 * p.y(), 6, 6, 3, 5);
    Vec3 color = paint.leaf * (0.92 + 0.10 * spots) * shade;
    double vein = 0, beside = 0;
    for (const Vein& v : leaf.veins) {
        const Vec2 way = v.to - v.from;
        const double t = std::clamp((p - v.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double d = (p - v.from - t * way).norm(), half = v.half * (1 - 0.75 * t);
        vein = std::max(vein, 1 - smooth_step(0.5 * half, 1.5 * half, d));
        beside =
            std::max(beside, (1 - smooth_step(half, 7 * half, d)) * std::min(1.0, v.half / (0.0045 * leaf.narrow)));
    }
    if (lower) color = (0.62 * color + 0.30 * Vec3::Constant(color.mean()) + Vec3(0.10, 0.11, 0.07)).eval();
    color *= 1 - (lower ? -0.10 : 0.10) * beside;
    const Vec3 bright = lower ? Vec3(1.25 * color) : Vec3(color + Vec3(0.16, 0.17, 0.08));
    color += 0.75 * vein * (bright - color);
    if (p.y() < leaf.petiole) color = (0.45 * color + 0.55 * Vec3(0.75 * paint.leaf + 0.12 * paint.bark)).eval();
    return color;
}

// Colours and coverage of one square, from 0 to `side` pixels, which is `wide` across and 1 along.
class Square {
public:
    explicit Square(int side)
        : side_(side), color_(std::size_t(side * side), Vec3::Zero()), cover_(std::size_t(side * side), 0) {}
    void fill(const Vec3& color) { std::fill(color_.begin(), color_.end(), color); }
    const Vec3& color(int x, int y) const { return color_[index(x, y)]; }
    double cover(int x, int y) const { return cover_[index(x, y)]; }

    // What lies within the polygon (in pixels), as paint(x, y) has it, over what is there.
    template <class F> void add(const std::vector<Vec2>& polygon, F&& paint) {
        double low = side_, high = 0;
        for (const Vec2& p : polygon) low = std::min(low, p.y()), high = std::max(high, p.y());
        std::vector<double> line(std::size_t(side_), 0);
        std::vector<std::pair<double, int>> crossings;
        for (int y = std::max(0, int(low)); y < std::min(side_, int(high) + 1); ++y) {
            std::fill(line.begin(), line.end(), 0);
            for (int sub = 0; sub < lines_; ++sub) {
                cross(polygon, y + (sub + 0.5) / lines_, crossings);
                int turns = 0;
                for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
                    turns += crossings[k].second;
                    if (turns != 0) stretch(line, crossings[k].first, crossings[k + 1].first);
                }
            }
            for (int x = 0; x < side_; ++x) {
                const double part = std::min(1.0, line[std::size_t(x)] / lines_);
                if (part < 1e-3) continue;
                Vec3& color = color_[index(x, y)];
                color += part * (paint(x + 0.5, y + 0.5) - color);
                double& cover = cover_[index(x, y)];
                cover += part * (1 - cover);
            }
        }
    }

private:
    static constexpr int lines_ = 4; // that a pixel is cut into
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(side_) + std::size_t(x); }
    static void cross(const std::vector<Vec2>& polygon, double y, std::vector<std::pair<double, int>>& crossings) {
        crossings.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            if ((a.y() <= y) == (b.y() <= y)) continue;
            crossings.emplace_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), a.y() < b.y() ? 1 : -1);
        }
        std::sort(crossings.begin(), crossings.end());
    }
    void stretch(std::vector<double>& line, double from, double to) const {
        from = std::max(from, 0.0), to = std::min(to, double(side_));
        for (int x = int(from); x < to; ++x) line[std::size_t(x)] += std::min(to, x + 1.0) - std::max(from, double(x));
    }

    int side_;
    std::vector<Vec3> color_;
    std::vector<double> cover_;
};

// From a leaf's own place to pixels of its square, and back.
struct Frame {
    Eigen::Affine2d to, back;
    explicit Frame(const Eigen::Affine2d& t) : to(t), back(t.inverse()) {}
};
Eigen::Affine2d square_frame(int side, double wide) {
    Eigen::Affine2d to = Eigen::Affine2d::Identity();
    to.translate(Vec2(side / 2.0, side * (1 + picture_share) / 2));
    to.scale(Vec2(side * picture_share / wide, -side * picture_share));
    return to;
}

void add_leaf(Square& square, const FlatLeaf& leaf, const Paint& paint, const Eigen::Affine2d& place, bool lower,
              double shade) {
    for (const double needle : leaf.needles) {
        const Frame frame(place * Eigen::Rotation2Dd(-needle));
        std::vector<Vec2> polygon;
        for (const Vec2& p : leaf.margin) polygon.push_back(frame.to * p);
        square.add(polygon,
                   [&](double x, double y) { return color_at(leaf, paint, frame.back * Vec2(x, y), lower, shade); });
    }
}

void add_spray(Square& square, const FlatLeaf& leaf, const Paint& paint, int side, bool mirrored) {
    Eigen::Affine2d place = square_frame(side, 1);
    if (mirrored) place.scale(Vec2(-1, 1));
    std::vector<Vec2> twig;
    for (const Vec2& p : {Vec2(0.008, 0), Vec2(0.003, spray_twig), Vec2(-0.003, spray_twig), Vec2(-0.008, 0)})
        twig.push_back(place * p);
    square.add(twig, [&](double, double) { return Vec3(0.8 * paint.bark); });
    double shade = 0.88;
    for (const SprayLeaf& at : spray_leaves()) {
        Eigen::Affine2d turned = place;
        turned.translate(at.foot).rotate(-at.angle).scale(at.length);
        add_leaf(square, leaf, paint, turned, false, shade);
        shade += 0.04; // those behind are in the shade of those before
    }
}

std::uint8_t level_of(double x) {
    return std::uint8_t(std::clamp(std::lround(x * 255 / 4) * 4, 0L, 255L));
}

} // namespace

Picture leaf_picture(const LeafForm& form, double width, const Vec3& leaf, const Vec3& bark, int size) {
    const int side = size / 2;
    const FlatLeaf flat = flat_leaf(form, width);
    const Paint paint{leaf, bark};
    Picture made{size, 4, std::vector<std::uint8_t>(4 * std::size_t(size) * std::size_t(size))};
    for (int tile = 0; tile < 4; ++tile) {
        const bool lower = tile % 2 == 1;
        Square square(side);
        square.fill(lower && tile < 2 ? Vec3(0.8 * leaf + Vec3::Constant(0.1)) : Vec3(0.9 * leaf));
        if (tile < 2)
            add_leaf(square, flat, paint, square_frame(side, picture_width(form, width)), lower, 1);
        else
            add_spray(square, flat, paint, side, lower);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                std::uint8_t* const to = &made.pixel[4 * (std::size_t(y + side * (tile / 2)) * std::size_t(size) +
                                                          std::size_t(x + side * (tile % 2)))];
                for (int c = 0; c < 3; ++c) to[c] = level_of(square.color(x, y)[c]);
                to[3] = std::uint8_t(std::lround(255 * std::min(1.0, square.cover(x, y))));
            }
    }
    return made;
}

double alpha_cutoff(const Picture& leaves) {
    constexpr int parts = 10;
    const int side = leaves.size / 2, block = side / parts;
    std::vector<double> mean;
    double covered = 0;
    for (int row = 0; row < parts; ++row)
        for (int column = 0; column < 2 * parts; ++column) { // of both sprays, which are the lower squares
            double sum = 0;
            for (int y = 0; y < block; ++y)
                for (int x = 0; x < block; ++x)
                    sum += leaves.pixel[4 * (std::size_t(side + row * block + y) * std::size_t(leaves.size) +
                                             std::size_t(column * block + x)) +
                                        3] /
                           255.0;
            mean.push_back(sum / (block * block));
            covered += mean.back();
        }
    std::sort(mean.begin(), mean.end(), std::greater<>());
    const auto shown = std::size_t(covered);
    return std::clamp(mean[std::min(shown, mean.size() - 1)], 0.03, 0.5);
}

} // namespace bough
