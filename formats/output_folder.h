// output_folder.h: some files that belong together, in a folder of their own.
#pragma once
#include "open.h"
#include <vector>

namespace bough {

class TemporaryFolder;

// A folder that is not there yet appears whole, under its name, or not at all (temporary.h). In one that is there each file appears whole, once all
// are written, in the order in which they were added; what else is in it stays. All but the destructor throw OutputError.
class OutputFolder {
public:
    explicit OutputFolder(const std::string& path); // with or without a slash behind
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();
    Output& add(const std::string& name); // a file in it
    void finish();

private:
    [[noreturn]] void fail(const std::string& what, int error) const;

    std::string path_;
    std::unique_ptr<TemporaryFolder> fresh_; // none: the folder is there
    std::vector<std::unique_ptr<Output>> file_;
};

// "oak_vat" of "oak_vat/".
std::string without_slash(std::string path);

// Throws as an OutputFolder of that name would, and leaves nothing.
void require_output_folder(const std::string& path);

} // namespace bough
