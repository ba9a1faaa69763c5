// dress.h, picture.h: what is drawn has the bodies' area and follows them; pictures hold the outlines and tile.
#include "formats/models/dress.h"
#include "formats/documents/species.h"
#include "formats/files.h"
#include "formats/models/picture.h"
#include "lib/growth/blade.h"
#include "lib/model/body_shape.h"
#include "tests/support/png_size.h"
#include "tests/support/sanitized.h"
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace bough;

namespace {

const std::initializer_list<const char*> all_species = {"apple", "birch", "cherry", "maple",
                                                        "oak",   "palm",  "pine",   "willow"};

double area_of(const OwnSurface& s, std::size_t t) {
    const auto& [a, b, c] = s.triangle[t];
    const auto at = [&](std::int32_t v) { return s.position[std::size_t(v)].cast<double>().eval(); };
    return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
}

const OwnPart& part_named(const OwnMesh& mesh, const char* name) {
    for (const OwnPart& part : mesh.part)
        if (part.name == name) return part;
    FAIL("no part " << name);
    return mesh.part.front();
}

} // namespace

TEST_CASE("every species that comes with bough has an outline and a bark") {
    for (const char* name : all_species) {
        const Species species = *find_species(name);
        INFO(name);
        CHECK(!species.leaf.none());
        const double area = leaf_area_of(leaf_half(species.leaf, species.growth.leaf_scale_x, 4));
        CHECK(area > 0);
        CHECK(area < species.growth.leaf_scale_x); // within its rectangle
    }
}

TEST_CASE("leaves as meshes have their bodies' area, at their bodies' places, moved by them alone") {
    for (const char* name : cases<const char*>(1, {"maple", "palm", "pine", "willow"})) {
        INFO(name);
        const Species species = *find_species(name);
        const Tree tree = convert(grow(name, {.bodies = 800, .seed = 4, .age = 10, .leaves = true}));
        const OwnMesh mesh = dress(tree, species, {.detail = LeafDetail::mesh, .textures = 0});
        const OwnPart& leaves = part_named(mesh, "leaf");
        std::vector<double> drawn(tree.size_bodies(), 0);
        for (const OwnPlace& place : leaves.placed) {
            const OwnSurface& shape = mesh.shape[std::size_t(place.shape)];
            double area = 0;
            for (std::size_t t = 0; t < shape.triangle.size(); ++t) area += area_of(shape, t) / 2; // of two faces
            const double scale = std::cbrt(double(place.turn.determinant()));
            drawn[std::size_t(place.body)] += scale * scale * area;
        }
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            if (tree.kind[i] != Kind::leaf) {
                CHECK(drawn[i] == 0);
                continue;
            }
            const bool clump = tree.leaf_count[i] > 1;
            const double one = clump ? leaf_area(tree.leaf_length[i], tree.leaf_width[i])
                                     : leaf_area(tree.size[i][0], tree.size[i][1]);
            CHECK(drawn[i] == Approx(tree.leaf_count[i] * one).epsilon(0.12)); // corners for a curve
        }
    }
}

TEST_CASE("a willow's sprays hang one below another, and none of them reaches below the tree's foot") {
    const auto strung =
        [](const char* name) { // the share of sprays that another goes on at its end; the mean way of all, downward
            const Tree tree = convert(grow(name, {.bodies = sanitized ? 300 : 600, .seed = 4, .leaves = true}));
            const OwnMesh mesh = dress(tree, *find_species(name), {.textures = 0});
            const OwnPart& leaves = part_named(mesh, "leaf");
            const double base = tree.joint_position[0].y();
            std::size_t all = 0, followed = 0;
            double down = 0;
            for (std::size_t k = 0; k < leaves.placed.size(); ++k) {
                const OwnPlace& place = leaves.placed[k];
                if (!is_clump(tree, std::size_t(place.body)) ||
                    tree.size[std::size_t(place.body)].x() > 3 * tree.size[std::size_t(place.body)].y())
                    continue;
                ++all;
                const Eigen::Vector3f way = place.turn.col(2), end = place.place + way;
                down -= double(way.normalized().y());
                if (k + 1 == leaves.placed.size() || (leaves.placed[k + 1].place - end).norm() > 1e-3f) continue;
                ++followed;
                CHECK(double(end.y() + way.y()) > base - 1e-3); // where the next one ends
            }
            REQUIRE(all > 100);
            return std::pair(double(followed) / double(all), down / double(all));
        };
    const auto [willow, willow_down] = strung("willow");
    CHECK(willow > 0.65); // three of four, where a clump has four
    CHECK(willow_down > 0.9);
    if (sanitized) return;
    const auto [oak, oak_down] = strung("oak");
    CHECK(oak == 0);
    CHECK(oak_down < 0.3);
}

TEST_CASE("a picture's leaf covers what its outline does, its colours go on beyond it") {
    for (const char* name : cases(2, all_species)) {
        const Species species = *find_species(name);
        const double width = species.growth.leaf_scale_x;
        const int size = 256, side = size / 2;
        const Picture picture = leaf_picture(species.leaf, width, Vec3(0.3, 0.5, 0.2), Vec3(0.4, 0.3, 0.2), size);
        REQUIRE(picture.pixel.size() == 4u * size * size);
        double covered[2] = {0, 0};
        int least = 255;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < size; ++x) {
                const std::uint8_t* const p = &picture.pixel[4 * std::size_t(y * size + x)];
                covered[x >= side] += p[3] / 255.0;
                least = std::min<int>(least, p[1]);
            }
        const double one = leaf_area_of(leaf_half(species.leaf, width, 7));
        const double expected = one * picture_share * picture_share / picture_width(species.leaf, width) * side * side;
        INFO(name);
        for (const double c : covered) {
            CHECK(c < 1.02 * expected * species.leaf.needles);
            CHECK(c > (species.leaf.needles > 1 ? 0.7 * species.leaf.needles : 0.98) *
                          expected); // needles overlap at their foot
        }
        CHECK(least > 30);
    }
}

TEST_CASE("from afar sprays cover what they cover from near") {
    for (const char* name : cases(1, all_species)) {
        if (std::string(name) == "palm") continue; // has leaflets, no clumps
        const Species species = *find_species(name);
        const int size = 512, side = size / 2;
        const Picture picture =
            leaf_picture(species.leaf, species.growth.leaf_scale_x, Vec3(0.3, 0.5, 0.2), Vec3(0.4, 0.3, 0.2), size);
        const double cutoff = alpha_cutoff(picture);
        for (const int block : {8, 16, 32}) { // mip levels 3 to 5
            double near = 0, far = 0;
            for (int y = side; y < size; y += block)
                for (int x = 0; x < size; x += block) {
                    double sum = 0;
                    for (int k = 0; k < block * block; ++k)
                        sum += picture.pixel[4 * std::size_t((y + k / block) * size + x + k % block) + 3] / 255.0;
                    near += sum, far += sum / (block * block) > cutoff ? block * block : 0;
                }
            INFO(name << ": cutoff " << cutoff << ", covers " << near / (2 * side * side) << ", by blocks of " << block
                      << " " << far / (2 * side * side));
            CHECK(far > 0.6 * near);
            CHECK(far < 2 * near);
        }
    }
}

TEST_CASE("bark tiles: across its edges it changes as it does within; normals are of unit length and look out") {
    for (const char* pattern : cases<const char*>(2, {"furrowed", "plated", "papery", "banded", "ringed"})) {
        BarkForm form;
        form.pattern = pattern;
        const int n = 256;
        const BarkPictures made = bark_pictures(form, Vec3(0.5, 0.4, 0.3), n);
        const auto pixel = [&](int x, int y) { return double(made.color.pixel[3 * std::size_t(y * n + x)]); };
        // What changes from each column, and each row, to the next; the last of them to the first.
        std::vector<double> column(n, 0), row(n, 0);
        double low = 255, high = 0;
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j) {
                column[std::size_t(j)] += std::abs(pixel(j, k) - pixel((j + 1) % n, k));
                row[std::size_t(j)] += std::abs(pixel(k, j) - pixel(k, (j + 1) % n));
                low = std::min(low, pixel(j, k)), high = std::max(high, pixel(j, k));
            }
        INFO(pattern);
        for (const std::vector<double>& changes : {column, row})
            CHECK(changes.back() < 1.5 * *std::max_element(changes.begin(), changes.end() - 1));
        CHECK(high - low > 20);
        for (std::size_t k = 0; k + 2 < made.normal.pixel.size(); k += 3) {
            const auto part = [&](std::size_t c) { return made.normal.pixel[k + c] / 127.5 - 1; };
            REQUIRE(std::abs(Vec3(part(0), part(1), part(2)).norm() - 1) < 0.04); // steps of 1/64
            REQUIRE(part(2) > 0);
        }
    }
}

TEST_CASE("materials name pictures that are there, of the size that was asked for") {
    const Species species = *find_species("birch");
    const Tree tree = convert(grow("birch", {.bodies = 300, .seed = 4, .age = 10, .leaves = true}));
    const OwnMesh mesh = dress(tree, species, {.textures = 256});
    REQUIRE(mesh.material.size() == mesh.part.size());
    std::size_t used = 0;
    for (std::size_t k = 0; k < mesh.part.size(); ++k) {
        const nlohmann::json material = nlohmann::json::parse(mesh.material[k]);
        CHECK(material["name"] == mesh.part[k].name);
        CHECK(mesh.part[k].material == std::int32_t(k));
        if (const auto& pbr = material["pbrMetallicRoughness"]; pbr.contains("baseColorTexture")) {
            const auto& image = mesh.image.at(pbr["baseColorTexture"]["index"].get<std::size_t>());
            CHECK(png_size(image.bytes) == std::pair(256, 256));
            ++used;
        }
        CHECK((mesh.part[k].name != "leaf" || material["alphaMode"] == "MASK"));
    }
    CHECK(used == 2);
    CHECK(dress(tree, species, {.detail = LeafDetail::mesh, .textures = 0}).image.empty());
    // A clump is few sprays: far fewer corners than its leaves as kites have.
    std::int64_t leaves = 0;
    for (const std::int32_t n : tree.leaf_count) leaves += n > 1 ? n : 0;
    if (leaves > 0) CHECK(std::int64_t(vertices_of(mesh, part_named(mesh, "leaf"))) < 8 * leaves / 4);
}
