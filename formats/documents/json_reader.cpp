#include "document_parts.h"
#include "json_numbers.h"
#include <limits>

namespace bough {
namespace {

using nlohmann::json;

std::string expected(const Field& field) {
    struct {
        std::string operator()(const Array& a) const {
            return a.dtype == Dtype::f64 ? "a flat array of numbers" : "a flat array of integers";
        }
        std::string operator()(const Objects&) const { return "an array of objects"; }
        std::string operator()(const double*) const { return "a number"; }
        std::string operator()(const std::int32_t*) const { return "an integer"; }
        std::string operator()(const std::int64_t*) const { return "an integer"; }
        std::string operator()(const std::string*) const { return "text"; }
        std::string operator()(const std::vector<std::string>*) const { return "an array of text"; }
    } const describe;
    return std::visit(describe, field.value);
}

// How a value of the wrong type is called: itself where it is short, else its kind.
std::string described(const json& value) {
    if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array";
    return value.dump();
}

// One table being filled; the document's, and on it that of the object of a list that is being read.
struct Level {
    std::vector<Field>* fields;
    std::string at;         // JSON pointer of the object
    Field* field = nullptr; // whose value comes next or is being read
    bool list = false;      // inside the field's array
    std::size_t objects = 0;
};

class Reader : public nlohmann::json_sax<json> {
public:
    Reader(std::string_view text, std::string name, const DocumentType* type, std::vector<Field>& fields,
           std::size_t line)
        : text_(text), file_(std::move(name)), line_(line), type_(type), fields_(fields) {
        name_ = line_ == 0 ? file_ : file_ + ":" + std::to_string(line_);
    }

    bool null() override { return other(json(nullptr)); }
    bool boolean(bool value) override { return other(json(value)); }
    bool string(std::string& value) override { return other(json(std::move(value))); }
    bool binary(json::binary_t&) override { return false; }

    bool number_integer(std::int64_t value) override {
        if (integers_) return push(value);
        if (reals_) return push(double(value));
        return other(json(value));
    }

    bool number_unsigned(std::uint64_t value) override {
        if (integers_ && value <= std::uint64_t(std::numeric_limits<std::int64_t>::max()))
            return push(std::int64_t(value));
        if (reals_) return push(double(value));
        return other(json(value));
    }

    bool number_float(double value, const std::string&) override {
        if (reals_) return push(value);
        return other(json(value));
    }

    bool start_object(std::size_t) override {
        if (levels_.empty()) {
            levels_.push_back({&fields_, "", nullptr, false, 0});
            return true;
        }
        Level& level = levels_.back();
        Objects* objects = level.list ? std::get_if<Objects>(&level.field->value) : nullptr;
        if (!objects) wrong_type("an object");
        const std::string at = pointer(level.at, level.field->name) + "/" + std::to_string(level.objects++);
        part_ = objects->begin();
        levels_.push_back({&part_, at, nullptr, false, 0});
        return true;
    }

    bool key(std::string& key) override {
        Level& level = levels_.back();
        level.field = nullptr;
        for (Field& field : *level.fields)
            if (field.name == key) level.field = &field;
        if (!level.field) unknown(key);
        if (level.field->seen) throw InputError(place(), "appears twice");
        level.field->seen = true;
        return true;
    }

    bool end_object() override {
        if (levels_.size() > 1) check_complete(*levels_.back().fields, name_, levels_.back().at);
        levels_.pop_back();
        return true;
    }

    bool start_array(std::size_t) override {
        if (levels_.empty()) throw InputError(name_, "is a JSON array, expected an object");
        Level& level = levels_.back();
        if (level.list || !is_list(*level.field)) wrong_type("an array");
        level.list = true;
        if ((array_ = std::get_if<Array>(&level.field->value))) {
            reals_ = array_->dtype == Dtype::f64;
            integers_ = !reals_;
            block_ = block_entries * array_->components;
            set_range(array_->dtype);
            array_->start(array_->per.count ? array_->per.count() : 0);
            read_numbers();
        }
        return true;
    }

    bool end_array() override {
        Level& level = levels_.back();
        level.list = false;
        if (array_) {
            hand_on();
            array_ = nullptr;
            reals_ = integers_ = false;
        }
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e) override {
        syntax_error(text_, file_, line_, position + skipped_, e.what(), levels_.empty() ? "" : here());
    }

    // nlohmann reads the text through these, so that read_numbers can go on in it.
    TextCursor begin() { return {&next_}; }
    TextCursor end() { return {&end_}; }

private:
    static bool is_list(const Field& field) {
        return std::holds_alternative<Array>(field.value) || std::holds_alternative<Objects>(field.value) ||
               std::holds_alternative<std::vector<std::string>*>(field.value);
    }

    // JSON pointer of the value that is being read.
    std::string here() const {
        const Level& level = levels_.back();
        if (!level.field) return level.at;
        const std::string at = pointer(level.at, level.field->name);
        if (!level.list) return at;
        if (array_)
            return at + "/" + std::to_string(level.field->numbers + numbers_.reals.size() + numbers_.integers.size());
        if (auto* texts = std::get_if<std::vector<std::string>*>(&level.field->value))
            return at + "/" + std::to_string((*texts)->size());
        return at + "/" + std::to_string(level.objects);
    }
    std::string place() const { return name_ + ": " + here(); }

    [[noreturn]] void unknown(const std::string& key) {
        const Level& level = levels_.back();
        // Without its "format" it is not a document with an unknown field but something else altogether.
        if (type_ && levels_.size() == 1 && document_format(text_).empty()) missing_field(name_, "", "format");
        unknown_field(name_, level.at, key, names(*level.fields));
    }

    [[noreturn]] void wrong_type(const std::string& found) {
        if (levels_.back().list && std::holds_alternative<Array>(levels_.back().field->value))
            throw InputError(place(), "is " + found + ", expected " + (reals_ ? "a number" : "an integer"));
        throw InputError(place(), "is " + found + ", expected " + expected(*levels_.back().field));
    }

    bool push(double value) {
        numbers_.reals.push_back(value);
        if (numbers_.reals.size() == block_) hand_on();
        return true;
    }

    bool push(std::int64_t value) {
        if (value < low_ || value > high_)
            throw InputError(place(), "is " + std::to_string(value) + ", expected an integer from " +
                                          std::to_string(low_) + " to " + std::to_string(high_));
        numbers_.integers.push_back(value);
        if (numbers_.integers.size() == block_) hand_on();
        return true;
    }

    void set_range(Dtype dtype) {
        low_ = dtype == Dtype::i64   ? std::numeric_limits<std::int64_t>::min()
               : dtype == Dtype::i32 ? std::numeric_limits<std::int32_t>::min()
                                     : 0;
        high_ = dtype == Dtype::i64   ? std::numeric_limits<std::int64_t>::max()
                : dtype == Dtype::i32 ? std::numeric_limits<std::int32_t>::max()
                                      : 255;
    }

    // All of an array but its last number, which nlohmann reads, and with it whatever is wrong.
    void read_numbers() {
        const char* const from = next_;
        if (reals_)
            next_ = each_number<double>(next_, end_, [&](double value) { push(value); });
        else
            next_ = each_number<std::int64_t>(next_, end_, [&](std::int64_t value) { push(value); });
        skipped_ += std::size_t(next_ - from);
    }

    // Numbers read so far go to where they belong.
    void hand_on() {
        levels_.back().field->numbers += numbers_.reals.size() + numbers_.integers.size();
        array_->add(numbers_);
        numbers_.reals.clear();
        numbers_.integers.clear();
    }

    // A value that is no number of an array: a field's own, or one that does not belong where it stands.
    bool other(const json& value) {
        if (levels_.empty()) throw InputError(name_, "is " + described(value) + ", expected an object");
        Level& level = levels_.back();
        if (level.list) {
            auto* texts = std::get_if<std::vector<std::string>*>(&level.field->value);
            if (!texts || !value.is_string()) wrong_type(described(value));
            (*texts)->push_back(value.get<std::string>());
            return true;
        }
        assign(*level.field, value, name_, level.at);
        if (type_ && levels_.size() == 1 && level.field->name == "version")
            check_version(name_, *std::get<std::int64_t*>(level.field->value), *type_);
        return true;
    }

    std::string_view text_;
    const char *next_ = text_.data(), *end_ = text_.data() + text_.size();
    std::size_t skipped_ = 0; // bytes that nlohmann has not seen
    std::string file_, name_;
    std::size_t line_;
    const DocumentType* type_;
    std::vector<Field>& fields_;
    std::vector<Field> part_;
    std::vector<Level> levels_;
    const Array* array_ = nullptr;          // of numbers, inside which we are
    bool reals_ = false, integers_ = false; // what they are
    Numbers numbers_;                       // a block of it
    std::size_t block_ = 0;                 // numbers of a whole block
    std::int64_t low_ = 0, high_ = 0;       // of its integers
};

bool put_integer(const json& value, std::int64_t low, std::int64_t high, std::int64_t& to) {
    if (!value.is_number_integer()) return false;
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(high)) return false;
    to = value.get<std::int64_t>();
    return to >= low && to <= high;
}

} // namespace

void assign(Field& field, const json& value, const std::string& name, const std::string& at) {
    bool good = false;
    std::int64_t integer = 0;
    if (auto* text = std::get_if<std::string*>(&field.value); text && value.is_string()) {
        **text = value.get<std::string>();
        good = true;
    } else if (auto* number = std::get_if<double*>(&field.value); number && value.is_number()) {
        **number = value.get<double>();
        good = true;
    } else if (auto* narrow = std::get_if<std::int32_t*>(&field.value)) {
        using Limits = std::numeric_limits<std::int32_t>;
        good = put_integer(value, Limits::min(), Limits::max(), integer);
        if (good) **narrow = std::int32_t(integer);
    } else if (auto* wide = std::get_if<std::int64_t*>(&field.value)) {
        using Limits = std::numeric_limits<std::int64_t>;
        good = put_integer(value, Limits::min(), Limits::max(), integer);
        if (good) **wide = integer;
    } else if (auto* texts = std::get_if<std::vector<std::string>*>(&field.value); texts && value.is_array()) {
        good = true;
        for (const json& entry : value) good = good && entry.is_string();
        if (good) **texts = value.get<std::vector<std::string>>();
    }
    if (!good)
        throw InputError(name + ": " + pointer(at, field.name),
                         "is " + described(value) + ", expected " + expected(field));
}

void read_json(std::string_view text, const std::string& name, const DocumentType* type, std::vector<Field>& fields,
               std::size_t line) {
    std::string format;
    std::int64_t version = 0;
    if (type) fields.insert(fields.begin(), {Field{"format", &format}, Field{"version", &version}});
    Reader reader(text, name, type, fields, line);
    json::sax_parse(reader.begin(), reader.end(), &reader);
    const std::string place = line == 0 ? name : name + ":" + std::to_string(line);
    for (const Field& field : fields)
        if (field.required && !field.seen) missing_field(place, "", field.name);
    if (type) check_format(name, format, *type);
    if (type) fields.erase(fields.begin(), fields.begin() + 2);
}

} // namespace bough
