#include "vat.h"
#include "data_image.h"
#include "formats/documents/document_parts.h"
#include "vat_parts.h"
#include <cmath>
#include <stdexcept>

namespace bough {
namespace {

Vec3 blender(const Vec3& p) {
    return {p.x(), -p.z(), p.y()};
}

std::string list_of(const Eigen::Array3d& numbers) {
    std::string text = "[";
    for (int k = 0; k < 3; ++k) {
        if (k > 0) text += ", ";
        append_number(text, numbers[k]);
    }
    return text + "]";
}

// A tenth's number divided by ten is the decimal that is meant.
Eigen::Array3d tenths(const Eigen::Array3d& number) {
    return number / 10;
}

} // namespace

std::vector<std::string> vat_files(const std::string& name, bool png) {
    std::vector<std::string> files{name + ".glb", name + (png ? "_vat.png" : "_vat.exr")};
    if (png) files.push_back(name + "_vnrm.png");
    files.push_back(name + "-remap_info.json");
    return files;
}

VatWriter::VatWriter(OutputFolder& folder, const std::string& name, const ReducedSkin& mesh, const VatLook& look,
                     const VatOptions& options)
    : name_(name), mesh_(mesh), look_(look), options_(options) {
    if (mesh_.vertex.size() > vat_side)
        throw std::length_error(std::to_string(mesh_.vertex.size()) + " vertices, but a texture holds " +
                                std::to_string(vat_side) + " columns");
    for (const std::string& file : vat_files(name, options_.png)) file_.push_back(&folder.add(file));
}

void VatWriter::write(const std::vector<Vec3>& position, const std::vector<Vec3>& normal) {
    if (frames_ == options_.most_frames())
        throw std::length_error("more than " + std::to_string(options_.most_frames()) +
                                " frames, which is what a texture holds");
    ++frames_;
    for (std::size_t v = 0; v < position.size(); ++v) {
        offset_.push_back(blender(position[v] - mesh_.skin.position[v]).cast<float>());
        const Vec3 n = blender(normal[v]);
        std::array<std::uint16_t, 3>& to = normal_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            to[k] = std::uint16_t(std::lround(65535 * std::clamp(0.5 * n[int(k)] + 0.5, 0.0, 1.0)));
    }
}

void VatWriter::write_images(const Eigen::Array3d& low, const Eigen::Array3d& high) {
    const std::size_t width = mesh_.vertex.size(), frames = frames_;
    const Eigen::Array3d scale = 1 / (high - low);
    const auto offsets = [&](std::size_t row, float* rgb) {
        for (std::size_t c = 0; c < width; ++c) {
            const Eigen::Array3d share = (offset_[row * width + c].cast<double>().array() - low) * scale;
            for (int k = 0; k < 3; ++k) *rgb++ = float(share[k]);
        }
    };
    const auto normals = [&](std::size_t row, float* rgb) {
        for (std::size_t c = 0; c < width; ++c)
            for (const std::uint16_t n : normal_[row * width + c]) *rgb++ = float(n) / 65535;
    };
    if (options_.png) {
        write_png16(*file_[1], width, frames, offsets);
        write_png16(*file_[2], width, frames, normals);
    } else {
        write_exr(*file_[1], width, 2 * frames,
                  [&](std::size_t row, float* rgb) { row < frames ? offsets(row, rgb) : normals(row - frames, rgb); });
    }
}

void VatWriter::finish() {
    if (frames_ == 0) throw std::length_error("no frame");
    Eigen::Array3d least = Eigen::Array3d::Constant(INFINITY), most = -least;
    for (const Eigen::Vector3f& p : offset_) {
        least = least.min(p.cast<double>().array());
        most = most.max(p.cast<double>().array());
    }
    const Eigen::Array3d low = (10 * least).floor(), high = (10 * most).ceil().max(low + 1);
    write_vat_mesh(*file_[0], name_, mesh_, look_, options_.png ? frames_ : 2 * frames_, options_);
    write_images(tenths(low), tenths(high));
    const std::string frames = std::to_string(frames_);
    std::string text = "{\n  \"os-remap\": {\n    \"Min\": " + list_of(tenths(low)) +
                       ",\n    \"Max\": " + list_of(tenths(high)) + ",\n    \"Frames\": " + frames +
                       "\n  },\n  \"animations\": {\n    \"Sway\": {\"startFrame\": 1, "
                       "\"endFrame\": " +
                       frames + ", \"framerate\": ";
    append_number(text, options_.fps);
    text += std::string(", \"looping\": ") + (options_.looping ? "true" : "false") + "}\n  }\n}\n";
    file_.back()->write(text);
}

} // namespace bough
