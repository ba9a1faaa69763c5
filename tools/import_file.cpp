#include "import_file.h"
#include "exits.h"
#include "formats/documents/splines.h"
#include "formats/imports/scan_radii.h"
#include "formats/mapped.h"
#include "formats/open.h"
#include "formats/plain_text.h"
#include "formatted.h"
#include "lib/base/counted.h"
#include "lib/growth/carry.h"
#include "reader_options.h"

namespace bough {

void add_import_options(OptionList& list, ImportChoice& choice) {
    list.add("--units", choice.units, "Unit of the imported file: m, cm, mm, ft, in or its length in metres")
        .takes("UNIT")
        .check([](const std::string& text) {
            return unit_in_metres(text) ? std::string()
                                        : "is '" + text + "', expected m, cm, mm, ft, in or a number above 0";
        });
    list.add("--up", choice.up, "Up axis of the imported file: y or z").takes("AXIS").one_of_any_case({"y", "z"});
    list.add("--trunk-diameter", choice.trunk_diameter,
             "Thickness of the imported tree's trunk at its base [m]; all radii, the file's or guessed, are multiplied "
             "alike")
        .takes("M")
        .check(positive_number());
    list.add_flag("--scan-radii", choice.scan_radii,
                  "Of a laser scan: bound by the pipe rule what is thinner than 5 cm across, which a scanner takes for "
                  "thicker than it is");
    list.add_flag(
        "--keep-place", choice.keep_place,
        "Leave the imported tree where its file has it; without, its foot is set on the ground at the origin");
    add_reader_options(list);
}

std::optional<double> unit_in_metres(const std::string& units) {
    if (units == "m") return 1.0;
    if (units == "cm") return 0.01;
    if (units == "mm") return 0.001;
    if (units == "ft") return 0.3048;
    if (units == "in") return 0.0254;
    const std::optional<double> value = parse_number(units);
    return value && *value > 0 ? value : std::nullopt;
}

Splines read_import(const std::string& name, const ImportChoice& choice, ImportNotes& notes,
                    const std::function<void(bool own)>& before) {
    const MappedInput file(name);
    const std::string_view content = file.content();
    const bool own = is_splines(content);
    ImportOptions options;
    options.name = input_name(name);
    options.folder = folder_of(name);
    options.taken_in = [&file] { file.give_back(); };
    options.unit = unit_in_metres(choice.units);
    if (!choice.up.empty()) options.up = lower_case(choice.up[0]);
    options.trunk_diameter = choice.trunk_diameter;
    options.keep_place = choice.keep_place;
    if (own && (options.unit || options.up))
        throw UsageError(std::string(choice.units.empty() ? "--up" : "--units") + ": " + options.name +
                         " is a bough document, which is in metres and Y up");
    if (own && options.keep_place)
        throw UsageError("--keep-place: " + options.name + " is a bough document, which stays where it is");
    if (own && choice.scan_radii)
        throw UsageError("--scan-radii: " + options.name + " is a bough document, whose radii are its own");
    if (own && options.trunk_diameter)
        throw UsageError("--trunk-diameter: " + options.name + " is a bough document, whose radii are its own");
    if (before) before(own);
    try {
        Splines splines = import_splines(content, options, notes);
        file.check();
        if (choice.scan_radii) bound_scan_radii(splines, notes);
        return splines;
    } catch (const InputError&) {
        file.check(); // half a file is no fault of its format
        throw;
    } catch (const std::bad_alloc&) {
        throw InputError(options.name, "out of memory while its " + bytes_text(double(content.size())) +
                                           " were read as branches, which takes 4 to 21 times as much");
    }
}

Splines read_import(std::string_view content, const std::string& file, ImportNotes& notes) {
    ImportOptions options;
    options.name = input_name(file);
    options.folder = folder_of(file);
    return import_splines(content, options, notes);
}

void make_carry(Splines& splines, const Material& material, std::vector<std::string>& notes) {
    if (const std::size_t thicker = thicken_to_carry(splines, material, foreign_sag))
        notes.push_back("--radii carry: " + std::to_string(thicker) + " of " +
                        counted(splines.branches(), "branch", "branches") +
                        " made thicker, to sag little and stand four times over in " + material.name +
                        " (also where they would stand)");
}

bool is_speedtree_file(const std::string& path) {
    return path != "-" && !path.empty() &&
           MappedInput(path).content().substr(0, 65536).find("<SpeedTreeRaw") != std::string_view::npos;
}

} // namespace bough
