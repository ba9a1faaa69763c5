// packed.h: arrays of plain values as bytes and back, for what a child process hands to its parent (forked.h). No
// format: both ends are one program.
#pragma once
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace bough {

template <class T> void pack(std::string& bytes, const T* data, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

template <class T> void unpack(const std::string& bytes, std::size_t& from, T* data, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if ((bytes.size() - from) / sizeof(T) < count) throw std::runtime_error("a child process sent too little");
    if (count > 0) std::memcpy(static_cast<void*>(data), bytes.data() + from, count * sizeof(T));
    from += count * sizeof(T);
}

// Length first; Number is what an element of Eigen's fixed types is made of, `width` of them an element.
template <class Number, std::size_t width, class T> void pack_all(std::string& bytes, const std::vector<T>& all) {
    static_assert(sizeof(T) == width * sizeof(Number));
    const std::uint64_t count = all.size();
    pack(bytes, &count, 1);
    pack(bytes, reinterpret_cast<const Number*>(all.data()), width * all.size());
}

template <class Number, std::size_t width, class T>
void unpack_all(const std::string& bytes, std::size_t& from, std::vector<T>& all) {
    static_assert(sizeof(T) == width * sizeof(Number));
    std::uint64_t count = 0;
    unpack(bytes, from, &count, 1);
    if ((bytes.size() - from) / sizeof(T) < count) throw std::runtime_error("a child process sent too little");
    all.resize(count);
    unpack(bytes, from, reinterpret_cast<Number*>(all.data()), width * count);
}

} // namespace bough
