// sequence.h: names of numbered files, a frame or a trunk each.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bough {

// frames/oak_%04d.obj -> frames/oak_0007.obj. The pattern must hold one %d or %0Nd (N 1 to 18) and a prefix before it in
// the file name; valid_sequence says what is wrong with it, or returns an empty string. The others need a valid pattern.
std::string valid_sequence(const std::string& pattern);
std::string sequence_name(const std::string& pattern, std::int64_t frame);
// The number of a file of the pattern's, by its name without the folder; nothing where it is none.
std::optional<std::int64_t> sequence_frame(const std::string& pattern, const std::string& file);
// frames/oak_%04d.obj -> frames/oak.mtl
std::string sequence_mtl(const std::string& pattern);

// The pattern's files that are there, by their numbers. O(files in the folder).
struct SequenceFile {
    std::int64_t frame;
    std::string name;
};
std::vector<SequenceFile> sequence_files(const std::string& pattern);

// Which of them an earlier run left with numbers above `last`: "t_%d.json: 2 trees of an earlier run stay behind the last one: t_3.json to t_4.json";
// empty: none. `one` and `several` name what a file holds. O(files in the folder).
std::string left_behind(const std::string& pattern, std::int64_t last, const char* one, const char* several);

} // namespace bough
