// import_file.h: a tree's file of any kind that is known, as --import and INPUT name it.
#pragma once
#include "formats/imports/import.h"
#include "lib/model/wood.h"
#include "option_list.h"
#include <functional>
#include <optional>
#include <string>

namespace bough {

// --units, --up, --trunk-diameter, --scan-radii and --keep-place of tools that import. The unit in metres: "m", "cm", "mm", "ft", "in" or a number.
struct ImportChoice {
    std::string units, up;
    std::optional<double> trunk_diameter; // [m]
    bool scan_radii = false, keep_place = false;
};
void add_import_options(OptionList&, ImportChoice&);
std::optional<double> unit_in_metres(const std::string& units);

// The splines of a file ("-": of stdin). `before` is called when it is known whether the file is bough's own splines, before it is read
// any further. Throws UsageError where ImportChoice says what such a document says itself, InputError as import_splines, and where the
// file was written to while it was read.
Splines read_import(const std::string& file, const ImportChoice&, ImportNotes&,
                    const std::function<void(bool own)>& before = {});
// The same of content that has been read already; `file`: where it came from.
Splines read_import(std::string_view content, const std::string& file, ImportNotes&);

// Whether a file is SpeedTree XML, by its head; false for stdin.
bool is_speedtree_file(const std::string& path);

// --radii carry: branches thick enough to sag little and stand four times over in this wood (growth/carry.h), with a note of how many were not.
void make_carry(Splines&, const Material&, std::vector<std::string>& notes);

} // namespace bough
