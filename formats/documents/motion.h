// motion.h: the motion document, "bough-motion" (formats/documents/README.md), as JSON lines, JSON or safetensors.
#pragma once
#include "formats/open.h"
#include "formats/text.h"
#include "lib/model/motion.h"
#include <array>
#include <memory>

namespace bough {

// The words of /fields, and what each asks for.
struct FieldWord {
    const char* word;
    bool MotionFields::*field;
};
constexpr std::array<FieldWord, 5> field_words{{{"pose", &MotionFields::pose},
                                                {"velocity", &MotionFields::velocity},
                                                {"torque", &MotionFields::torque},
                                                {"angles", &MotionFields::angles},
                                                {"stress", &MotionFields::stress}}};
constexpr MotionFields no_fields{false, false, false, false, false};
// Null where it is none of them; and all of them, as a message names them.
bool MotionFields::*field_of(const std::string& word);
extern const char* const field_words_text;

// Names the first number of a frame that no float can say, "frame 3: the position of body 7 comes to ..."; "" where there is none. Most outputs hold
// floats, and what reads a motion may: there it would be infinite. O(bodies).
std::string beyond_floats(const MotionFrame&);

enum class MotionForm { jsonl, json, safetensors };

// Writes a motion frame by frame. JSON and JSON lines stream; safetensors keeps its arrays in temporary files until
// finish(), because its header holds the number of frames. After finish() the output holds every frame written.
class MotionWriter {
public:
    // digits: of the numbers in JSON's frames; safetensors has them all.
    MotionWriter(Output&, const MotionHeader&, MotionForm, const Digits& = {});
    ~MotionWriter();
    void write(const MotionFrame&);
    void finish();
    std::uint64_t waiting() const; // [bytes] of frames that finish() writes, beside a header of some hundred

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// Reads a motion frame by frame: of JSON lines and safetensors one frame is held at a time, of JSON all of them.
class MotionFrames {
public:
    // The content must stay. Throws InputError, as next() does.
    MotionFrames(std::string_view content, const std::string& name);
    ~MotionFrames();
    MotionFrames(MotionFrames&&) noexcept;
    const MotionHeader& header() const; // `events` once one has come
    bool next(MotionFrame&);            // false: there is none left

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

Motion read_motion(std::string_view content, const std::string& name);

bool is_state(std::string_view content);
SavedState read_state(std::string_view content, const std::string& name);
void write_state(Output&, const SavedState&, Form);

} // namespace bough
