#include "collada_check.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace bough {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

// take(word) for each word of an element's text, around comments.
template <class Take> void each_word_of(const char* text, Take&& take) {
    while (true) {
        while (is_blank(*text)) ++text;
        if (*text == '\0') return;
        const char* const first = text;
        while (*text != '\0' && !is_blank(*text)) ++text;
        take(std::string_view(first, std::size_t(text - first)));
    }
}

template <class Take> void each_word(const pugi::xml_node& element, Take&& take) {
    for (const pugi::xml_node& part : element.children())
        if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) each_word_of(part.value(), take);
}

// The integers of <p>, <v> or <vcount>.
template <class Take> void each_index(const pugi::xml_node& list, const std::string& place, Take&& take) {
    each_word(list, [&](std::string_view word) {
        const std::optional<std::int64_t> number = parse_integer(word);
        if (!number)
            throw std::runtime_error(place + "<" + list.name() + "> holds " + in_ascii_quotes(std::string(word)) +
                                     ", expected a whole number");
        take(*number);
    });
}

std::string without_hash(const char* reference) {
    return *reference == '#' ? reference + 1 : "";
}

// What an <input> of indices points into.
struct SharedInput {
    std::string semantic;
    std::int64_t offset = 0, count = 0;
    bool any_count = false; // the source is elsewhere, or of a kind that is not counted here
};

class Library { // of one <geometry> or <controller>
public:
    Library(const pugi::xml_node& node, const pugi::xml_node& body)
        : place_(std::string(node.name()) + " " + in_ascii_quotes(node.attribute("id").value()) + ": "), body_(body) {
        for (const pugi::xml_node& source : body.children("source")) add(source);
        for (const pugi::xml_node& vertices : body.children("vertices"))
            for (const pugi::xml_node& input : vertices.children("input"))
                if (input.attribute("semantic").value() == std::string_view("POSITION"))
                    if (const auto of = count_.find(without_hash(input.attribute("source").value()));
                        of != count_.end())
                        count_[vertices.attribute("id").value()] = of->second;
    }

    void check_mesh() const {
        for (const char* const kind :
             {"triangles", "polylist", "polygons", "lines", "linestrips", "tristrips", "trifans"})
            for (const pugi::xml_node& primitive : body_.children(kind)) {
                const std::vector<SharedInput> inputs = inputs_of(primitive);
                for (const SharedInput& input : inputs)
                    if (input.semantic == "VERTEX" && !input.any_count && input.count == 0 && primitive.child("p"))
                        throw std::runtime_error(place_ + "has no vertices, but <" + kind + "> of them");
                for (const pugi::xml_node& p : primitive.children("p")) check_indices(p, kind, inputs, 0);
                for (const pugi::xml_node& ph : primitive.children("ph"))
                    for (const pugi::xml_node& p : ph.children("p")) check_indices(p, kind, inputs, 0);
            }
    }

    void check_skin() const {
        for (const pugi::xml_node& weights : body_.children("vertex_weights")) {
            const std::vector<SharedInput> inputs = inputs_of(weights);
            const std::size_t numbers = check_indices(weights.child("v"), "vertex_weights", inputs, -1);
            std::uint64_t taken = 0;
            each_index(weights.child("vcount"), place_, [&](std::int64_t n) {
                if (n < 0 || n > std::numeric_limits<std::int32_t>::max())
                    throw std::runtime_error(place_ + "<vcount> holds " + std::to_string(n) + ", expected 0 or more");
                taken += std::uint64_t(n);
            });
            if (const auto stride = std::uint64_t(stride_of(inputs)); taken * stride != numbers)
                throw std::runtime_error(place_ + "<vcount> takes " + std::to_string(taken * stride) +
                                         " numbers of <v>, which has " + std::to_string(numbers));
        }
    }

private:
    void add(const pugi::xml_node& source) {
        const std::string id = source.attribute("id").value();
        const pugi::xml_node accessor = source.child("technique_common").child("accessor");
        const std::int64_t count = accessor.attribute("count").as_llong(-1);
        for (const pugi::xml_node& array : source.children("float_array")) check_floats(array, accessor);
        if (accessor && count >= 0) count_[id] = count;
    }

    void check_floats(const pugi::xml_node& array, const pugi::xml_node& accessor) const {
        const std::string at = place_ + "float_array " + in_ascii_quotes(array.attribute("id").value()) + " ";
        std::int64_t numbers = 0;
        each_word(array, [&](std::string_view word) {
            const std::optional<double> number = parse_number(word);
            if (!number || !std::isfinite(*number))
                throw std::runtime_error(at + "holds " + in_ascii_quotes(std::string(word)) + " as number " +
                                         std::to_string(numbers) + ", expected a finite number");
            ++numbers;
        });
        constexpr long long most = 1LL << 31; // of each: their product is a number still
        const std::int64_t said = array.attribute("count").as_llong(numbers),
                           read = std::clamp(accessor.attribute("count").as_llong(0), 0LL, most) *
                                  std::clamp(accessor.attribute("stride").as_llong(1), 0LL, most);
        if (said != numbers || read > numbers)
            throw std::runtime_error(at + "has " + std::to_string(numbers) + " numbers, expected the " +
                                     std::to_string(std::max(said, read)) + " that its count says");
    }

    std::vector<SharedInput> inputs_of(const pugi::xml_node& node) const {
        std::vector<SharedInput> inputs;
        for (const pugi::xml_node& from : node.children("input")) {
            SharedInput input;
            input.semantic = from.attribute("semantic").value();
            input.offset = from.attribute("offset").as_llong(0);
            if (input.offset < 0 || input.offset > 64)
                throw std::runtime_error(place_ + "an <input> has the offset " + std::to_string(input.offset) +
                                         ", expected 0 to 64");
            const auto source = count_.find(without_hash(from.attribute("source").value()));
            input.any_count = source == count_.end();
            if (!input.any_count) input.count = source->second;
            inputs.push_back(std::move(input));
        }
        return inputs;
    }

    static std::int64_t stride_of(const std::vector<SharedInput>& inputs) {
        std::int64_t stride = 1;
        for (const SharedInput& input : inputs) stride = std::max(stride, input.offset + 1);
        return stride;
    }

    // least: of a joint. Returns how many numbers there are.
    std::size_t check_indices(const pugi::xml_node& list, const char* of, const std::vector<SharedInput>& inputs,
                              std::int64_t least) const {
        const auto stride = std::size_t(stride_of(inputs));
        std::vector<std::vector<const SharedInput*>> at(stride);
        for (const SharedInput& input : inputs)
            if (!input.any_count) at[std::size_t(input.offset)].push_back(&input);
        std::size_t k = 0;
        each_index(list, place_, [&](std::int64_t index) {
            for (const SharedInput* input : at[k % stride])
                if (index < (input->semantic == "JOINT" ? least : 0) || index >= input->count)
                    throw std::runtime_error(place_ + "<" + of + "> names " + input->semantic + " " +
                                             std::to_string(index) + ", expected 0 to less than " +
                                             std::to_string(input->count));
            ++k;
        });
        return k;
    }

    const std::string place_;
    const pugi::xml_node body_;
    std::unordered_map<std::string, std::int64_t> count_; // of each source, by its id
};

// Which nodes hold which, as children and by <instance_node>, which names one that stands elsewhere.
class Nodes {
public:
    explicit Nodes(const pugi::xml_node& root) { // by a walk that does not call itself, however deep nodes lie
        for (pugi::xml_node at = root; at;) {
            if (std::string_view(at.name()) == "node") add(at);
            pugi::xml_node next = at.first_child();
            while (!next && at != root) {
                next = at.next_sibling();
                if (!next) at = at.parent();
            }
            at = next;
        }
        // By its id or else, as assimp looks, by its name; what names another file holds nothing here.
        for (const auto& [index, id] : named_)
            if (const auto target = index_.find(id); target != index_.end())
                hold(index, target->second);
            else if (const auto other = called_.find(id); other != called_.end())
                hold(index, other->second);
    }

    // What holds nothing is counted first, and then what holds only what is counted.
    void check() const {
        std::vector<std::size_t> left(held_), done;
        std::vector<double> count(left.size(), 1);
        for (std::size_t k = 0; k < left.size(); ++k)
            if (left[k] == 0) done.push_back(k);
        for (std::size_t next = 0; next < done.size(); ++next) {
            const std::size_t k = done[next];
            if (count[k] > most_nodes)
                throw std::runtime_error(place(k) + "has more than " + std::to_string(most_nodes) +
                                         " nodes in it, as <instance_node> names them again and again");
            for (const std::size_t holder : holder_[k]) {
                count[holder] += count[k];
                if (--left[holder] == 0) done.push_back(holder);
            }
        }
        if (done.size() < left.size()) refuse_circle(left);
    }

private:
    static constexpr std::int64_t most_nodes = 1'000'000;

    // left: of each node, how many it holds that were not counted. Each of these leads on to another, and at last round.
    [[noreturn]] void refuse_circle(const std::vector<std::size_t>& left) const {
        std::vector<std::size_t> next(left.size());
        std::size_t at = 0;
        for (std::size_t k = 0; k < left.size(); ++k)
            if (left[k] > 0)
                for (const std::size_t holder : holder_[k]) next[holder] = at = k;
        for (std::size_t k = 0; k < left.size(); ++k) at = next[at];
        for (std::size_t k = 0; k < left.size() && id_[at].empty(); ++k) at = next[at];
        throw std::runtime_error(place(at) + "holds itself, by <instance_node>");
    }

    void add(const pugi::xml_node& node) {
        const std::size_t index = id_.size();
        id_.emplace_back(node.attribute("id").value());
        if (!id_.back().empty()) index_.emplace(id_.back(), index);
        if (const std::string name = node.attribute("name").value(); !name.empty()) called_.emplace(name, index);
        of_.emplace(node.hash_value(), index);
        held_.push_back(0);
        holder_.emplace_back();
        if (const auto parent = of_.find(node.parent().hash_value()); parent != of_.end()) hold(parent->second, index);
        for (const pugi::xml_node& instance : node.children("instance_node"))
            if (std::string id = without_hash(instance.attribute("url").value()); !id.empty())
                named_.emplace_back(index, std::move(id));
    }
    void hold(std::size_t holder, std::size_t held) {
        ++held_[holder];
        holder_[held].push_back(holder);
    }
    std::string place(std::size_t k) const { return "node " + in_ascii_quotes(id_[k]) + " "; }

    std::vector<std::string> id_;
    std::vector<std::size_t> held_; // by each, how many
    std::vector<std::vector<std::size_t>> holder_;
    std::vector<std::pair<std::size_t, std::string>> named_;
    std::unordered_map<std::string, std::size_t> index_, called_; // by id, by name: the first of each
    std::unordered_map<std::size_t, std::size_t> of_;             // by the element
};

} // namespace

void check_collada(std::string_view content) {
    pugi::xml_document document;
    if (!document.load_buffer(content.data(), content.size())) return;
    const pugi::xml_node root = document.child("COLLADA");
    for (const pugi::xml_node& library : root.children("library_geometries"))
        for (const pugi::xml_node& geometry : library.children("geometry"))
            for (const pugi::xml_node& mesh : geometry.children("mesh")) Library(geometry, mesh).check_mesh();
    for (const pugi::xml_node& library : root.children("library_controllers"))
        for (const pugi::xml_node& controller : library.children("controller"))
            for (const pugi::xml_node& skin : controller.children("skin")) Library(controller, skin).check_skin();
    Nodes(root).check();
}

} // namespace bough
