#include "data_image.h"
#include "png_file.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

namespace bough {
namespace {

// An Output as OpenEXR wants to write it: its table of offsets is filled in at the end, by a destructor that tells of no error.
class ToOutput : public Imf::OStream {
public:
    explicit ToOutput(Output& output) : Imf::OStream(output.name().c_str()), output_(output) {}
    void write(const char bytes[], int count) override {
        try {
            const std::string_view text(bytes, std::size_t(count));
            const std::size_t again = std::min<std::uint64_t>(end_ - at_, text.size());
            if (again > 0) output_.replace(at_, text.substr(0, again));
            output_.write(text.substr(again));
            at_ += text.size();
            end_ = std::max(end_, at_);
        } catch (...) {
            failed_ = std::current_exception();
            throw;
        }
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }
    void check() const {
        if (failed_) std::rethrow_exception(failed_);
    }

private:
    Output& output_;
    std::uint64_t at_ = 0, end_ = 0;
    std::exception_ptr failed_;
};

} // namespace

void write_exr(Output& output, std::size_t width, std::size_t height, const PixelRow& row) {
    std::vector<float> pixel(3 * width);
    std::vector<Imath::half> half(3 * width);
    ToOutput to(output);
    {
        Imf::Header header{int(width), int(height)};
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::FrameBuffer frame;
        for (std::size_t k = 0; k < 3; ++k) {
            const char* const name = k == 0 ? "R" : k == 1 ? "G" : "B";
            header.channels().insert(name, Imf::Channel(Imf::HALF));
            // One row, for each of the image's.
            frame.insert(name,
                         Imf::Slice(Imf::HALF, reinterpret_cast<char*>(half.data() + k), 3 * sizeof(Imath::half), 0));
        }
        Imf::OutputFile file(to, header, 0);
        file.setFrameBuffer(frame);
        for (std::size_t y = 0; y < height; ++y) {
            row(y, pixel.data());
            std::transform(pixel.begin(), pixel.end(), half.begin(), [](float x) { return Imath::half(x); });
            file.writePixels(1);
        }
    }
    to.check();
}

void write_png16(Output& output, std::size_t width, std::size_t height, const PixelRow& row) {
    std::vector<float> pixel(3 * width);
    std::vector<std::uint8_t> bytes(6 * width);
    std::string text;
    PngFile png(text, {.width = std::uint32_t(width), .height = std::uint32_t(height), .depth = 16});
    const auto require = [&output](bool done) {
        if (!done) throw OutputError(output.name(), "libpng cannot write it");
    };
    require(png.begin());
    for (std::size_t y = 0; y < height; ++y) {
        row(y, pixel.data());
        for (std::size_t k = 0; k < pixel.size(); ++k) {
            const long value = std::lround(65535 * std::clamp(double(pixel[k]), 0.0, 1.0));
            bytes[2 * k] = std::uint8_t(value >> 8);
            bytes[2 * k + 1] = std::uint8_t(value & 255);
        }
        require(png.add_row(bytes.data()));
        output.write(text);
        text.clear();
    }
    require(png.end());
    output.write(text);
}

} // namespace bough
