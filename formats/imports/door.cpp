// door.cpp: bough_imports.h over the readers of this folder and of formats/models.
#include "any_tree.h"
#include "formats/c/bough_imports.h"
#include "formats/c/handle.h"
#include "formats/documents/tree.h"
#include "formats/plain_text.h"
#include "import.h"

namespace bough {

Splines import_splines(std::string_view bytes, const std::string& name, const std::string& folder,
                       std::vector<std::string>* notes) {
    ImportOptions options;
    options.name = name;
    options.folder = folder;
    ImportNotes found;
    Splines splines = import_splines(bytes, options, found);
    if (notes) {
        notes->push_back(found.format);
        notes->insert(notes->end(), found.lines.begin(), found.lines.end());
    }
    return splines;
}

Tree import_tree(std::string_view bytes, const std::string& name, const std::string& folder,
                 std::vector<std::string>* notes) {
    if (!must_be_converted(bytes, name)) return read_tree(bytes, name);
    std::vector<std::string> unread;
    std::vector<std::string>& own = notes ? *notes : unread;
    return tree_of_splines(import_splines(bytes, name, folder, &own), name, own);
}

namespace {

thread_local std::string last_notes;

// What Import, a function of above, gives of the bytes, as a handle.
template <class Handle, class Import>
bough_result imported(Import import, const void* bytes, std::size_t size, const char* name, const char* folder,
                      Handle** given, const char* argument) {
    return c::call([&] {
        c::required(given, argument);
        std::vector<std::string> notes;
        auto object =
            c::object_of(import(c::content(bytes, size), c::name_or_memory(name), folder ? folder : "", &notes));
        std::string text;
        for (const std::string& line : notes) text += (text.empty() ? "" : "\n") + valid_utf8(line);
        *given = static_cast<Handle*>(c::give(std::move(object)));
        last_notes = std::move(text);
    });
}

} // namespace
} // namespace bough

bough_result bough_import_splines(const void* bytes, size_t size, const char* name, const char* folder,
                                  bough_splines** splines) {
    return bough::imported([](auto&&... given) { return bough::import_splines(given...); }, bytes, size, name, folder,
                           splines, "splines");
}

bough_result bough_import_tree(const void* bytes, size_t size, const char* name, const char* folder,
                               bough_tree** tree) {
    return bough::imported(bough::import_tree, bytes, size, name, folder, tree, "tree");
}

const char* bough_import_notes(void) {
    return bough::last_notes.c_str();
}
