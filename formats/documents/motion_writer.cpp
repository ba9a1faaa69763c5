#include "motion_fields.h"
#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <unistd.h>

namespace bough {
namespace {

// Bytes that must wait: an unnamed file in TMPDIR, or /tmp.
class Spool {
public:
    explicit Spool(std::string output) : output_(std::move(output)) {
        const char* directory = std::getenv("TMPDIR");
        place_ = directory && *directory ? directory : "/tmp";
        std::string path = place_ + "/bough-XXXXXX";
        file_ = ::mkstemp(path.data());
        if (file_ < 0) fail();
        ::unlink(path.c_str());
    }
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;
    ~Spool() {
        if (file_ >= 0) ::close(file_);
    }

    void write(const void* bytes, std::size_t size) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t n = ::write(file_, static_cast<const char*>(bytes) + done, size - done);
            if (n < 0 && errno != EINTR) fail();
            if (n > 0) done += std::size_t(n);
        }
    }

    void read(std::uint64_t offset, std::string& bytes) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t n = ::pread(file_, bytes.data() + done, bytes.size() - done, off_t(offset + done));
            if (n < 0 && errno != EINTR) fail();
            if (n == 0) throw OutputError(output_, "cannot be written: its temporary file in " + place_ + " was cut");
            if (n > 0) done += std::size_t(n);
        }
    }

private:
    [[noreturn]] void fail() {
        const int error = errno;
        if (file_ >= 0) ::close(file_);
        file_ = -1;
        throw OutputError(output_, "cannot be written: temporary file in " + place_ + ": " +
                                       std::generic_category().message(error));
    }

    std::string output_, place_;
    int file_ = -1;
};

// Vectors and quaternions (Eigen keeps x y z w) lie in memory as they do in the file.
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quat) == 4 * sizeof(double));

void spool_frame(Spool& spool, const FrameArray& array, const MotionFrame& frame, const std::string& output) {
    const std::size_t count = array.size(frame) * array.components();
    if (count == 0) return;
    const double* values = array.vectors     ? (frame.*array.vectors).front().data()
                           : array.rotations ? (frame.*array.rotations).front().coeffs().data()
                                             : (frame.*array.numbers).data();
    if (!all_finite(values, count))
        throw OutputError(output, "/" + std::string(array.name) + " of frame " + std::to_string(frame.frame) +
                                      " is not finite, and documents hold finite numbers only");
    spool.write(values, count * sizeof(double));
}

[[maybe_unused]] bool holds_just(const MotionFrame& frame, const MotionHeader& header) {
    for (const FrameArray& array : frame_arrays)
        if (array.size(frame) != (header.fields.*array.wanted ? std::size_t(header.bodies) : 0)) return false;
    return true;
}

} // namespace

struct MotionWriter::Implementation {
    Output& output;
    MotionHeader header;
    MotionForm form;
    Digits digits;
    std::vector<const FrameArray*> arrays;
    std::size_t frames = 0;
    bool finished = false;
    // safetensors: the arrays' frames, one after the other, and the small arrays.
    std::unique_ptr<Spool> spool;
    std::vector<std::int64_t> frame;
    std::vector<double> time;
    std::vector<std::int64_t> event_frame, event, event_body, event_on;
    std::vector<double> event_value;

    // Of a scene without balls, and of a whole one, as it was before there were any and parts.
    std::vector<Field> written_header(std::vector<std::string>& words) {
        std::vector<Field> fields = header_fields(header, words);
        std::erase_if(fields, [&](const Field& field) { return field.name == "balls" && header.balls == 0; });
        const std::array<std::string, 4> of_part{"part", "parts", "first_body", "whole"};
        if (header.parts == 1)
            std::erase_if(fields, [&](const Field& field) {
                return std::find(of_part.begin(), of_part.end(), field.name) != of_part.end();
            });
        return fields;
    }

    std::string header_text(const char* separator) {
        std::vector<std::string> words = words_of(header.fields);
        std::string text = "{\"format\": \"" + std::string(motion_type.format) + "\"" + separator +
                           "\"version\": " + std::to_string(motion_type.version);
        for (const Field& field : written_header(words))
            if (!is_left_out(field)) text += separator + ("\"" + field.name + "\": ") + value_text(field);
        return text;
    }

    void write_text(const MotionFrame& f) {
        MotionFrame& looked_at = const_cast<MotionFrame&>(f);
        if (form == MotionForm::json) output.write(frames == 0 ? "\n" : ",\n");
        write_json_line(output, nullptr, frame_fields(looked_at), digits);
        if (form == MotionForm::json) return;
        output.write("\n");
        output.flush();
    }

    void write_binary(const MotionFrame& f) {
        if (!std::isfinite(f.time)) throw OutputError(output.name(), "/time is not finite");
        for (const FrameArray* array : arrays) spool_frame(*spool, *array, f, output.name());
        frame.push_back(f.frame);
        time.push_back(f.time);
        for (std::size_t k = 0; k < f.events.what.size(); ++k) {
            event_frame.push_back(f.frame);
            event.push_back(std::find(event_words.begin(), event_words.end(), f.events.what[k]) - event_words.begin());
            event_body.push_back(f.events.body[k]);
            event_on.push_back(f.events.on[k]);
            event_value.push_back(f.events.value[k]);
        }
    }

    std::uint64_t bytes_a_frame(const FrameArray& array) const {
        return std::uint64_t(header.bodies) * array.components() * sizeof(double);
    }

    std::uint64_t waiting() const {
        if (form != MotionForm::safetensors || finished) return 0;
        std::uint64_t each = sizeof(std::int64_t) + sizeof(double);
        for (const FrameArray* array : arrays) each += bytes_a_frame(*array);
        return frames * each + event.size() * (4 * sizeof(std::int64_t) + sizeof(double));
    }

    void finish_binary() {
        std::vector<std::pair<std::string, Tensor>> tensors{{"frame", {"I64", {frames}, 8 * frames, {}}},
                                                            {"time", {"F64", {frames}, 8 * frames, {}}}};
        std::uint64_t stride = 0;
        for (const FrameArray* a : arrays) {
            const std::uint64_t bytes = bytes_a_frame(*a);
            std::vector<std::uint64_t> shape;
            for (const std::int64_t size : a->shape(std::int64_t(frames), header.bodies))
                shape.push_back(std::uint64_t(size));
            tensors.push_back({a->name, {"F64", shape, frames * bytes, {}}});
            stride += bytes;
        }
        const std::uint64_t events = event.size();
        if (header.events) {
            for (const char* name : event_integers) tensors.push_back({name, {"I64", {events}, 8 * events, {}}});
            tensors.push_back({"event_value", {"F64", {events}, 8 * events, {}}});
        }
        std::vector<std::string> words = words_of(header.fields);
        output.write(safetensors_header(metadata_of(motion_type, written_header(words)), tensors));
        output.write({reinterpret_cast<const char*>(frame.data()), 8 * frames});
        output.write({reinterpret_cast<const char*>(time.data()), 8 * frames});
        std::uint64_t offset = 0;
        for (const FrameArray* a : arrays) {
            std::string bytes(std::size_t(bytes_a_frame(*a)), '\0');
            for (std::size_t i = 0; i < frames; ++i) {
                spool->read(i * stride + offset, bytes);
                output.write(bytes);
            }
            offset += bytes.size();
        }
        if (!header.events) return;
        for (const auto* array : {&event_frame, &event, &event_body, &event_on})
            output.write({reinterpret_cast<const char*>(array->data()), 8 * event.size()});
        output.write({reinterpret_cast<const char*>(event_value.data()), 8 * event_value.size()});
    }
};

MotionWriter::MotionWriter(Output& output, const MotionHeader& header, MotionForm form, const Digits& digits)
    : implementation_(
          new Implementation{output, header, form, digits, {}, 0, false, nullptr, {}, {}, {}, {}, {}, {}, {}}) {
    for (const FrameArray& array : frame_arrays)
        if (header.fields.*array.wanted) implementation_->arrays.push_back(&array);
    if (form == MotionForm::safetensors) {
        implementation_->spool = std::make_unique<Spool>(output.name());
    } else if (form == MotionForm::json) {
        output.write(implementation_->header_text(",\n") + ",\n\"frames\": [");
    } else {
        output.write(implementation_->header_text(", ") + "}\n");
        output.flush();
    }
}

MotionWriter::~MotionWriter() = default;

void MotionWriter::write(const MotionFrame& frame) {
    Implementation& to = *implementation_;
    assert(holds_just(frame, to.header));
    if (to.form == MotionForm::safetensors)
        to.write_binary(frame);
    else
        to.write_text(frame);
    ++to.frames;
}

void MotionWriter::finish() {
    Implementation& to = *implementation_;
    if (to.form == MotionForm::json) to.output.write(to.frames == 0 ? "]}\n" : "\n]}\n");
    if (to.form == MotionForm::safetensors) to.finish_binary();
    to.output.flush();
    to.finished = true;
}

std::uint64_t MotionWriter::waiting() const {
    return implementation_->waiting();
}

} // namespace bough
