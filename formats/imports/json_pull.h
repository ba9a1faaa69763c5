// json_pull.h: JSON read value by value by someone who knows what comes, without a tree of values in memory and without
// recursion: for the foreign JSON formats, whose files may be large.
#pragma once
#include <string>
#include <string_view>

namespace bough {

// Throws InputError FILE:LINE for text that is no JSON, or holds another kind of value than the one asked for.
class JsonPull {
public:
    JsonPull(std::string_view text, const std::string& name);

    char peek();                          // first character of the next value: { [ " t f n or of a number
    bool next_key(std::string_view& key); // within an object: its next key, false at its end
    bool next_item();                     // within an array: whether another item comes, false at its end
    void begin_object() { begin('{'); }
    void begin_array() { begin('['); }
    double number();
    bool boolean();
    std::string_view string();                 // as written: escapes are left as they are
    void skip();                               // any value
    std::size_t offset() const { return at_; } // behind what was read last
    void end();                                // nothing but blanks may come
    [[noreturn]] void refuse(const std::string& message) const;

private:
    void begin(char bracket);
    bool next(char close);
    void blanks();
    std::string_view word();

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    bool first_ = false; // a bracket has just been opened
};

} // namespace bough
