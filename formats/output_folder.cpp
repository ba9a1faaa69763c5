#include "output_folder.h"
#include "temporary.h"
#include <cerrno>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace bough {

std::string without_slash(std::string path) {
    while (path.size() > 1 && path.back() == '/') path.pop_back();
    return path;
}

OutputFolder::OutputFolder(const std::string& path) : path_(without_slash(path)) {
    struct stat status {};
    if (::stat(path_.c_str(), &status) == 0) {
        if (!S_ISDIR(status.st_mode)) fail("is there and is no folder", ENOTDIR);
        if (::access(path_.c_str(), W_OK | X_OK) != 0) fail("cannot be written to", errno);
        return;
    }
    if (errno != ENOENT) fail("cannot be written to", errno);
    if (::lstat(path_.c_str(), &status) == 0)
        fail("is a link that leads nowhere", ENOENT); // which no folder can replace
    try {
        fresh_ = std::make_unique<TemporaryFolder>(path_);
    } catch (const std::system_error& error) {
        fail("cannot be made", error.code().value());
    }
}

OutputFolder::~OutputFolder() {
    file_.clear(); // before the folder that they are in
}

Output& OutputFolder::add(const std::string& name) {
    file_.push_back(std::make_unique<Output>((fresh_ ? fresh_->name() : path_) + "/" + name, path_ + "/" + name));
    return *file_.back();
}

void OutputFolder::finish() {
    for (const auto& file : file_) file->finish();
    if (!fresh_) return;
    try {
        fresh_->finish();
    } catch (const std::system_error& error) {
        fail("cannot be made", error.code().value());
    }
}

void OutputFolder::fail(const std::string& what, int error) const {
    throw OutputError(path_ + "/", what + ": " + std::generic_category().message(error));
}

void require_output_folder(const std::string& path) {
    const OutputFolder tried(path);
}

} // namespace bough
