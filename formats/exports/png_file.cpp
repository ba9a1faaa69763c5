#include "png_file.h"
#include <csetjmp>
#include <png.h>

namespace bough {

struct PngFile::Writer {
    std::string& text;
    PngForm form;
    std::vector<png_color> color;
    std::vector<png_byte> alpha;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

namespace {

void to_text(png_structp png, png_bytep bytes, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

} // namespace

PngFile::PngFile(std::string& text, const PngForm& form) : writer_(new Writer{text, form, {}, {}}) {
    const std::vector<std::uint8_t> colors = std::move(writer_->form.colors); // as libpng has them, below
    for (std::size_t at = 0; at < colors.size(); at += std::size_t(form.channels)) {
        writer_->color.push_back({colors[at], colors[at + 1], colors[at + 2]});
        if (form.channels == 4) writer_->alpha.push_back(colors[at + 3]);
    }
}

PngFile::~PngFile() = default;

// Between setjmp and the jump of an error nothing has a destructor.
bool PngFile::begin() {
    Writer& w = *writer_;
    if (!w.info || setjmp(png_jmpbuf(w.png))) return false;
    const bool few = !w.color.empty();
    png_set_write_fn(w.png, &w.text, to_text, nullptr);
    png_set_user_limits(w.png, w.form.width, w.form.height);
    png_set_IHDR(w.png, w.info, w.form.width, w.form.height, w.form.depth,
                 few                    ? PNG_COLOR_TYPE_PALETTE
                 : w.form.channels == 4 ? PNG_COLOR_TYPE_RGBA
                                        : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (few) png_set_PLTE(w.png, w.info, w.color.data(), int(w.color.size()));
    if (!w.alpha.empty()) png_set_tRNS(w.png, w.info, w.alpha.data(), int(w.alpha.size()), nullptr);
    if (w.form.unfiltered) {
        png_set_filter(w.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
        png_set_compression_level(w.png, 9);
    }
    png_write_info(w.png, w.info);
    return true;
}

bool PngFile::add_row(const std::uint8_t* row) {
    if (setjmp(png_jmpbuf(writer_->png))) return false;
    png_write_row(writer_->png, row);
    return true;
}

bool PngFile::end() {
    if (setjmp(png_jmpbuf(writer_->png))) return false;
    png_write_end(writer_->png, writer_->info);
    return true;
}

} // namespace bough
