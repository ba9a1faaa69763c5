// OpenVAT: textures read back by OpenEXR and libpng, the mesh by the specification of glTF.
#include "formats/exports/vat.h"
#include "tests/support/gltf_reader.h"
#include "tests/support/random_documents.h"
#include "tests/support/skin_checks.h"
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <png.h>

using namespace bough;
using namespace bough::test;
using namespace skin_checks;
using gltf_reader::Json;

namespace {

struct Image {
    std::size_t width = 0, height = 0;
    std::vector<Vec3> pixel; // from the top down
};

Image exr(const std::string& file) {
    Imf::RgbaInputFile from(file.c_str());
    REQUIRE(from.channels() == Imf::WRITE_RGB);
    const Imath::Box2i box = from.dataWindow();
    Image image{std::size_t(box.max.x - box.min.x + 1), std::size_t(box.max.y - box.min.y + 1), {}};
    std::vector<Imf::Rgba> pixel(image.width * image.height);
    from.setFrameBuffer(pixel.data(), 1, image.width);
    from.readPixels(box.min.y, box.max.y);
    for (const Imf::Rgba& p : pixel) image.pixel.emplace_back(float(p.r), float(p.g), float(p.b));
    return image;
}

Image png(const std::string& file) {
    std::FILE* const from = std::fopen(file.c_str(), "rb");
    REQUIRE(from);
    png_structp read = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(read);
    png_init_io(read, from);
    png_read_png(read, info, PNG_TRANSFORM_IDENTITY, nullptr);
    Image image{png_get_image_width(read, info), png_get_image_height(read, info), {}};
    REQUIRE(png_get_bit_depth(read, info) == 16);
    REQUIRE(png_get_color_type(read, info) == PNG_COLOR_TYPE_RGB);
    double gamma = 0;
    CHECK(png_get_gAMA(read, info, &gamma) == 0);
    for (std::size_t y = 0; y < image.height; ++y)
        for (std::size_t x = 0; x < image.width; ++x) {
            Vec3& p = image.pixel.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const png_bytep at = png_get_rows(read, info)[y] + 6 * x + 2 * k;
                p[int(k)] = (256 * at[0] + at[1]) / 65535.0;
            }
        }
    png_destroy_read_struct(&read, &info, nullptr);
    std::fclose(from);
    return image;
}

Vec3 from_blender(const Vec3& p) {
    return {p.x(), p.z(), -p.y()};
}

struct Played {
    Json info;
    gltf_reader::Glb glb;
    Image places, normals;
    std::size_t below = 0; // rows before those of the normals
    Vec3 of(const Image& image, std::size_t row, std::size_t column) const {
        return image.pixel[row * image.width + column];
    }
    Vec3 offset(std::size_t frame, std::size_t column) const {
        Vec3 p = of(places, frame, column);
        for (std::size_t k = 0; k < 3; ++k) {
            const double low = info["os-remap"]["Min"][k], high = info["os-remap"]["Max"][k];
            p[int(k)] = low + p[int(k)] * (high - low);
        }
        return from_blender(p);
    }
    Vec3 normal(std::size_t frame, std::size_t column) const {
        return from_blender(2 * of(normals, below + frame, column) - Vec3::Ones());
    }
};

struct Frames {
    std::vector<std::vector<Vec3>> position, normal;
};

Frames swung(const Skin& skin, const Tree& tree, std::size_t count) {
    Frames frames;
    const SkinDeformer deformer(skin, tree);
    for (std::size_t f = 0; f < count; ++f) {
        const skin_checks::SkinPose pose = bent(tree, 0.05 * double(f), unsigned(f));
        deformer.deform(pose.R_wb, pose.x_w, frames.position.emplace_back(), frames.normal.emplace_back());
    }
    return frames;
}

Played played(const ReducedSkin& mesh, const Skin& skin, const Frames& frames, bool as_png, bool looping = false) {
    const Folder folder;
    VatOptions options;
    options.png = as_png;
    options.looping = looping;
    options.fps = 25;
    OutputFolder output(folder / "oak_vat");
    VatWriter writer(output, "oak", mesh, {&skin, nullptr}, options);
    for (std::size_t f = 0; f < frames.position.size(); ++f) writer.write(frames.position[f], frames.normal[f]);
    writer.finish();
    output.finish();
    Played result;
    const std::string stem = folder / "oak_vat/oak";
    result.info = Json::parse(read_input(stem + "-remap_info.json"));
    result.glb = gltf_reader::parse(read_input(stem + ".glb"));
    result.places = as_png ? png(stem + "_vat.png") : exr(stem + "_vat.exr");
    result.normals = as_png ? png(stem + "_vnrm.png") : result.places;
    result.below = as_png ? 0 : frames.position.size();
    CHECK(std::size_t(std::distance(std::filesystem::directory_iterator(folder / "oak_vat"),
                                    std::filesystem::directory_iterator())) == vat_files("oak", as_png).size());
    return result;
}

} // namespace

TEST_CASE("each vertex's column gives its way from rest, and its normal, in each frame") {
    const Tree tree = make_tree::random_tree(60, 3);
    const Skin skin = build_skin(tree, {});
    const ReducedSkin mesh = reduced_skin(skin, tree, vat_side);
    const Frames frames = swung(mesh.skin, tree, 7);
    for (const bool as_png : {false, true}) {
        CAPTURE(as_png);
        const Played found = played(mesh, skin, frames, as_png, as_png);
        const Json& remap = found.info["os-remap"];
        CHECK(remap["Frames"] == 7);
        const Json& sway = found.info["animations"]["Sway"];
        CHECK(sway == Json({{"startFrame", 1}, {"endFrame", 7}, {"framerate", 25}, {"looping", as_png}}));
        REQUIRE(found.places.width == skin.position.size());
        REQUIRE(found.places.height == (as_png ? 7u : 14u));
        double largest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double low = remap["Min"][k], high = remap["Max"][k];
            CHECK(std::abs(10 * low - std::round(10 * low)) < 1e-9);
            CHECK(std::abs(10 * high - std::round(10 * high)) < 1e-9);
            CHECK(high > low);
            largest = std::max(largest, high - low);
        }
        // Half floats have 11 bits; those of PNG are 16. Normals are a 65535th in both, before they become half floats.
        const double place = largest * (as_png ? 1.0 / 65535 : 1.0 / 2048), normal = as_png ? 4.0 / 65535 : 4.0 / 2048;
        double off = 0, tilt = 0;
        for (std::size_t f = 0; f < 7; ++f)
            for (std::size_t v = 0; v < skin.position.size(); ++v) {
                off = std::max(off,
                               (found.offset(f, v) - (frames.position[f][v] - skin.position[v])).cwiseAbs().maxCoeff());
                tilt = std::max(tilt, (found.normal(f, v) - frames.normal[f][v]).cwiseAbs().maxCoeff());
            }
        CHECK(off < place);
        CHECK(tilt < normal);
        CHECK(off > 0);
    }
}

TEST_CASE("the mesh at rest is the skin, and each vertex names the middle of its pixel of frame 0") {
    const Tree tree = make_tree::branched();
    const Skin skin = build_skin(tree, {});
    const ReducedSkin mesh = reduced_skin(skin, tree, vat_side);
    const Played found = played(mesh, skin, swung(mesh.skin, tree, 3), false);
    std::size_t column = 0, triangles = 0;
    const Json& primitives = found.glb.json["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == skin.part.size());
    CHECK(found.glb.json["nodes"].size() == 1);
    for (std::size_t m = 0; m < primitives.size(); ++m) {
        const Json& of = primitives[m]["attributes"];
        const std::vector<double> position = gltf_reader::numbers(found.glb, of["POSITION"]),
                                  uv = gltf_reader::numbers(found.glb, of["TEXCOORD_0"]),
                                  pixel = gltf_reader::numbers(found.glb, of["TEXCOORD_1"]),
                                  index = gltf_reader::numbers(found.glb, primitives[m]["indices"]);
        const std::size_t first = column;
        for (std::size_t i = 0; i < position.size() / 3; ++i, ++column) {
            CHECK((Vec3(position[3 * i], position[3 * i + 1], position[3 * i + 2]) - skin.position[column]).norm() <
                  1e-6);
            CHECK(uv[2 * i] == Approx(double(skin.texture[column][0])));
            CHECK(1 - uv[2 * i + 1] == Approx(double(skin.texture[column][1])).margin(1e-6));
            CHECK(pixel[2 * i] * double(found.places.width) == Approx(double(column) + 0.5).epsilon(1e-5));
            CHECK(pixel[2 * i + 1] * double(found.places.height) == Approx(0.5));
        }
        for (std::size_t t = 0; t < index.size() / 3; ++t, ++triangles)
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(std::size_t(index[3 * t + k]) + first == std::size_t(skin.triangle[triangles][k]));
    }
    CHECK(column == skin.position.size());
    CHECK(triangles == skin.triangle.size());
}

TEST_CASE("a still mesh, and more vertices or frames than a texture holds") {
    const Tree tree = make_tree::branched();
    const Skin skin = build_skin(tree, {});
    const ReducedSkin mesh = reduced_skin(skin, tree, vat_side);
    Frames still{{skin.position}, {skin.normal}};
    const Played found = played(mesh, skin, still, true);
    for (std::size_t v = 0; v < skin.position.size(); ++v) CHECK(found.offset(0, v).norm() < 1e-6);
    const Folder folder;
    OutputFolder output(folder / "x_vat");
    VatWriter writer(output, "x", mesh, {&skin, nullptr}, {});
    CHECK_THROWS_AS(writer.finish(), std::length_error);
    for (std::size_t f = 0; f < vat_side / 2; ++f) writer.write(skin.position, skin.normal);
    CHECK_THROWS_AS(writer.write(skin.position, skin.normal), std::length_error);
    const Tree large = make_tree::random_tree(1000, 3);
    const Skin all = build_skin(large, {});
    const ReducedSkin whole = reduced_skin(all, large, all.position.size());
    REQUIRE(all.position.size() > vat_side);
    CHECK_THROWS_AS(VatWriter(output, "y", whole, {&all, nullptr}, {}), std::length_error);
}
