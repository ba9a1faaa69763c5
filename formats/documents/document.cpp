#include "document_parts.h"
#include <cstring>

namespace bough {
namespace {

// How one entry of a std::vector<T> lies in a flat array.
template <class T> struct Entry;

template <> struct Entry<double> {
    static constexpr Dtype dtype = Dtype::f64;
    static constexpr std::size_t components = 1;
    static void put(double value, double* to) { *to = value; }
    static double take(const double* from) { return *from; }
};

template <> struct Entry<std::int32_t> {
    static constexpr Dtype dtype = Dtype::i32;
    static constexpr std::size_t components = 1;
    static void put(std::int32_t value, std::int64_t* to) { *to = value; }
    static std::int32_t take(const std::int64_t* from) { return std::int32_t(*from); }
};

template <> struct Entry<Kind> {
    static constexpr Dtype dtype = Dtype::u8;
    static constexpr std::size_t components = 1;
    static void put(Kind value, std::int64_t* to) { *to = std::int64_t(value); }
    static Kind take(const std::int64_t* from) { return Kind(*from); }
};

template <> struct Entry<Vec3> {
    static constexpr Dtype dtype = Dtype::f64;
    static constexpr std::size_t components = 3;
    static void put(const Vec3& value, double* to) { to[0] = value.x(), to[1] = value.y(), to[2] = value.z(); }
    static Vec3 take(const double* from) { return {from[0], from[1], from[2]}; }
};

template <> struct Entry<Quat> {
    static constexpr Dtype dtype = Dtype::f64;
    static constexpr std::size_t components = 4;
    static void put(const Quat& value, double* to) {
        to[0] = value.x(), to[1] = value.y(), to[2] = value.z(), to[3] = value.w();
    }
    static Quat take(const double* from) { return {from[3], from[0], from[1], from[2]}; }
};

template <> struct Entry<Mat3> {
    static constexpr Dtype dtype = Dtype::f64;
    static constexpr std::size_t components = 6;
    static void put(const Mat3& m, double* to) {
        to[0] = m(0, 0), to[1] = m(1, 1), to[2] = m(2, 2), to[3] = m(0, 1), to[4] = m(0, 2), to[5] = m(1, 2);
    }
    static Mat3 take(const double* f) {
        Mat3 m;
        m << f[0], f[3], f[4], f[3], f[1], f[5], f[4], f[5], f[2];
        return m;
    }
};

template <class T, class N> auto& numbers_of(N& numbers) {
    if constexpr (Entry<T>::dtype == Dtype::f64)
        return numbers.reals;
    else
        return numbers.integers;
}

template <class T> Field make(const std::string& name, std::vector<T>& values, const Per& per) {
    constexpr std::size_t components = Entry<T>::components;
    Array array{Entry<T>::dtype, components, {}, {}, {}, {}, {}, per};
    array.entries = [&values] { return values.size(); };
    array.get = [&values](std::size_t first, std::size_t count, Numbers& numbers) {
        auto& to = numbers_of<T>(numbers);
        to.resize(count * components);
        for (std::size_t i = 0; i < count; ++i) Entry<T>::put(values[first + i], to.data() + components * i);
    };
    array.start = [&values](std::size_t count) {
        values.clear();
        values.reserve(count);
    };
    array.add = [&values](const Numbers& numbers) {
        const auto& from = numbers_of<T>(numbers);
        const std::size_t before = values.size(), count = from.size() / components;
        values.resize(before + count);
        for (std::size_t i = 0; i < count; ++i) values[before + i] = Entry<T>::take(from.data() + components * i);
    };
    return Field{name, std::move(array)};
}

template <class T> Field make(const std::string& name, std::vector<T>& values, const Per& per, T fallback) {
    Field field = make(name, values, per);
    std::get<Array>(field.value).fill = [&values, fallback](std::size_t count) { values.assign(count, fallback); };
    return optional(std::move(field));
}

} // namespace

Field array(const std::string& name, std::vector<double>& values, const Per& per) {
    return make(name, values, per);
}
Field array(const std::string& name, std::vector<double>& values, const Per& per, double fallback) {
    return make(name, values, per, fallback);
}
Field array(const std::string& name, std::vector<std::int32_t>& values, const Per& per) {
    return make(name, values, per);
}
Field array(const std::string& name, std::vector<Kind>& values, const Per& per, Kind fallback) {
    return make(name, values, per, fallback);
}
Field array(const std::string& name, std::vector<Vec3>& values, const Per& per) {
    return make(name, values, per);
}
Field array(const std::string& name, std::vector<Quat>& values, const Per& per) {
    return make(name, values, per);
}
Field array(const std::string& name, std::vector<Mat3>& values, const Per& per) {
    return make(name, values, per);
}

Field optional(Field field) {
    field.required = false;
    return field;
}

void read_document(std::string_view content, const std::string& name, const DocumentType& type,
                   std::vector<Field> fields) {
    if (is_binary(content, name, type)) {
        const auto copy = [&](std::uint64_t at, std::size_t count, char* to) {
            std::memcpy(to, content.data() + at, count);
        };
        read_safetensors(parse_safetensors(content, name), copy, name, type, fields);
    } else {
        read_json(content, name, &type, fields);
    }
    check_complete(fields, name, "");
}

void read_document(const Input& input, const DocumentType& type, std::vector<Field> fields) {
    if (input.size() == input.content().size()) return read_document(input.content(), input.name(), type, fields);
    is_binary(input.content(), input.name(), type); // which it is: refuses another document's
    const auto read = [&](std::uint64_t at, std::size_t count, char* to) { input.read(at, count, to); };
    read_safetensors(parse_safetensors_header(input.content(), input.size(), input.name()), read, input.name(), type,
                     fields);
    check_complete(fields, input.name(), "");
}

void write_document(Output& output, Form form, const DocumentType& type, const std::vector<Field>& fields) {
    if (form == Form::safetensors)
        write_safetensors(output, type, fields);
    else
        write_json(output, type, fields);
}

void refuse(const std::optional<Defect>& defect, const std::string& name, const std::vector<Field>& fields) {
    if (!defect) return;
    std::string place = name + ": /" + defect->field;
    if (defect->index < 0) throw InputError(place, defect->message);
    std::size_t components = 1;
    std::string entry;
    for (const Field& field : fields)
        if (const Array* array = std::get_if<Array>(&field.value); array && field.name == defect->field) {
            components = array->components;
            if (components > 1 && array->per.count) entry = array->per.what.substr(0, array->per.what.find(' '));
        }
    place.append("/").append(std::to_string(std::size_t(defect->index) * components));
    if (entry.empty()) throw InputError(place, defect->message);
    throw InputError(place, entry + " " + std::to_string(defect->index) + " " + defect->message);
}

} // namespace bough
