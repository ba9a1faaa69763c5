#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include <cassert>
#include <limits>

namespace bough {

void GltfBytes::hand_on() {
    output_.write(block_);
    written_ += block_.size();
    block_.clear();
}

int GltfFile::add_view(std::uint64_t bytes, GltfTarget target, int stride, Write write) {
    view_text_ += (views_.empty() ? "{\"buffer\":0,\"byteOffset\":" : ",\n{\"buffer\":0,\"byteOffset\":") +
                  std::to_string(bytes_) + ",\"byteLength\":" + std::to_string(bytes);
    if (stride > 0) view_text_ += ",\"byteStride\":" + std::to_string(stride);
    if (target != GltfTarget::none) view_text_ += ",\"target\":" + std::to_string(int(target));
    view_text_ += '}';
    views_.push_back({bytes, std::move(write)});
    bytes_ += (bytes + 3) / 4 * 4;
    return int(views_.size()) - 1;
}

int GltfFile::add_accessor(int view, std::uint64_t offset, GltfType component, std::uint64_t count, const char* type,
                           const std::string& bounds) {
    std::string& text = accessor_text_;
    text += accessor_count_ == 0 ? "{\"bufferView\":" : ",\n{\"bufferView\":";
    text += std::to_string(view);
    if (offset > 0) text += ",\"byteOffset\":" + std::to_string(offset);
    text += ",\"componentType\":" + std::to_string(int(component)) + ",\"count\":" + std::to_string(count) +
            ",\"type\":\"" + type + '"' + bounds + '}';
    return accessor_count_++;
}

std::uint64_t GltfFile::bytes(const std::string& rest) const {
    return 12 + 8 + json(rest).size() + 8 + bytes_;
}

std::string GltfFile::json(const std::string& rest) const {
    std::string json = "{" + rest + ",\n\"accessors\":[\n" + accessor_text_ + "],\n\"bufferViews\":[\n" + view_text_ +
                       "],\n\"buffers\":[{\"byteLength\":" + std::to_string(bytes_) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return json;
}

void GltfFile::write(Output& output, const std::string& rest) {
    const std::string json = this->json(rest);
    const std::uint64_t whole = 12 + 8 + json.size() + 8 + bytes_;
    if (whole > std::numeric_limits<std::uint32_t>::max())
        throw OutputError(output.name(), "would have " + std::to_string(whole) +
                                             " bytes, more than the 4 GiB that a .glb can hold; take fewer frames or "
                                             "joints, or a larger key tolerance");
    GltfBytes to(output);
    const auto word = [&](std::uint64_t value) { to.add(std::uint32_t(value)); };
    word(0x46546C67); // "glTF"
    word(2);
    word(whole);
    word(json.size());
    word(0x4E4F534A); // "JSON"
    to.hand_on();
    output.write(json);
    word(bytes_);
    word(0x004E4942); // "BIN"
    for (const View& view : views_) {
        [[maybe_unused]] const std::uint64_t before = to.written();
        view.write(to);
        assert(to.written() - before == view.bytes);
        for (std::uint64_t pad = view.bytes; pad % 4 != 0; ++pad) to.add(std::uint8_t(0));
    }
    to.hand_on();
}

std::string gltf_asset(const std::string& generator, const std::string& source) {
    std::string text = "\"asset\":{\"version\":\"2.0\",\"generator\":";
    append_string(text, generator);
    if (!source.empty()) {
        text += ",\"extras\":{\"source\":";
        append_string(text, source);
        text += '}';
    }
    return text + "}";
}

template <class Numbers> std::string gltf_list(const Numbers& numbers) {
    std::string text = "[";
    for (const auto number : numbers) {
        if (text.size() > 1) text += ',';
        append_number(text, number);
    }
    return text + "]";
}
template std::string gltf_list(const Eigen::Vector3f&);
template std::string gltf_list(const Vec3&);
template std::string gltf_list(const Eigen::Vector4f&);
template std::string gltf_list(const Eigen::Vector4d&);

std::string gltf_bounds(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    return ",\"min\":" + gltf_list(low) + ",\"max\":" + gltf_list(high);
}

} // namespace bough
