#include "data_image.h"
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <exception>
#include <png.h>
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

namespace {

void to_text(png_structp png, png_bytep bytes, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

// What libpng is asked for between setjmp and the jump of an error: nothing here has a destructor.
bool begin_png(png_structp png, png_infop info, std::string* text, png_uint_32 width, png_uint_32 height) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, text, to_text, nullptr);
    png_set_user_limits(png, width, height);
    png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    return true;
}
bool add_row(png_structp png, png_const_bytep row) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_write_row(png, row);
    return true;
}
bool end_png(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_write_end(png, info);
    return true;
}

struct PngWriter {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    PngWriter() = default;
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

} // namespace

void write_png16(Output& output, std::size_t width, std::size_t height, const PixelRow& row) {
    std::vector<float> pixel(3 * width);
    std::vector<png_byte> bytes(6 * width);
    std::string text;
    PngWriter writer;
    const auto require = [&output](bool done) {
        if (!done) throw OutputError(output.name(), "libpng cannot write it");
    };
    require(writer.info && begin_png(writer.png, writer.info, &text, png_uint_32(width), png_uint_32(height)));
    for (std::size_t y = 0; y < height; ++y) {
        row(y, pixel.data());
        for (std::size_t k = 0; k < pixel.size(); ++k) {
            const long value = std::lround(65535 * std::clamp(double(pixel[k]), 0.0, 1.0));
            bytes[2 * k] = png_byte(value >> 8);
            bytes[2 * k + 1] = png_byte(value & 255);
        }
        require(add_row(writer.png, bytes.data()));
        output.write(text);
        text.clear();
    }
    require(end_png(writer.png, writer.info));
    output.write(text);
}

} // namespace bough
