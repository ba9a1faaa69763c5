#include "tga_check.h"
#include <cstdint>

namespace bough {
namespace {

constexpr std::size_t head = 18; // bytes
enum Type : std::size_t { mapped = 1, gray = 3, run_lengths = 8 };

class Tga {
public:
    explicit Tga(std::string_view file)
        : file_(file), type_(byte(2) & ~std::size_t(run_lengths)), runs_(byte(2) & run_lengths), colors_(word(5)),
          first_color_(word(3)), wide_((byte(16) + 7) / 8), pixels_(word(12) * word(14)) {}

    // It has no mark of its own: its second byte is 0 or 1, which no other kind's is.
    bool is_one() const {
        return file_.size() >= head && byte(1) <= 1 && type_ >= mapped && type_ <= gray && wide_ > 0;
    }

    std::string defect() {
        at_ = head + byte(0) + (byte(1) ? colors_ * ((byte(7) + 7) / 8) : 0);
        for (std::size_t done = 0; done < pixels_;) {
            std::size_t count = pixels_, held = pixels_; // pixels of this stretch, and how many of them are written
            if (runs_) {
                if (at_ >= file_.size()) return cut_off(done);
                count = byte(at_) % 128 + 1;
                held = byte(at_++) >= 128 ? 1 : count;
            }
            if (at_ > file_.size() || held > (file_.size() - at_) / wide_) return cut_off(done);
            for (std::size_t k = 0; type_ == mapped && k < held; ++k)
                if (const std::size_t color = wide_ == 2 ? word(at_ + 2 * k) : byte(at_ + k);
                    color >= first_color_ + colors_)
                    return "a pixel names colour " + std::to_string(color) + " of a palette of " +
                           std::to_string(colors_);
            at_ += held * wide_;
            done += count;
        }
        return "";
    }

private:
    std::size_t byte(std::size_t at) const {
        return at < file_.size() ? static_cast<unsigned char>(file_[at]) : std::size_t(0);
    }
    std::size_t word(std::size_t at) const { return byte(at) + 256 * byte(at + 1); }
    std::string cut_off(std::size_t done) const {
        return "it ends early: of " + std::to_string(pixels_) + " pixels " +
               (runs_ ? "only " + std::to_string(done) : std::string("not all")) + " are there";
    }

    std::string_view file_;
    std::size_t type_, runs_, colors_, first_color_, wide_, pixels_, at_ = 0;
};

} // namespace

std::string tga_defect(std::string_view file) {
    Tga tga(file);
    return tga.is_one() ? tga.defect() : "";
}

} // namespace bough
