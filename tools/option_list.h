// option_list.h: what the command line of a tool takes, declared option by option. CLI11 reads it (option_list.cpp), and nothing else includes
// CLI11: a source that does takes six seconds longer to compile.
#pragma once
#include "option_values.h"
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace bough {

// One option, as it was declared; what is said of it is said in a row: add("--fps", o.fps, "Frames a second (30)").takes("F").check(...)
class OptionEntry {
public:
    explicit OptionEntry(CLI::Option& option) : option_(option) {}
    OptionEntry& takes(const std::string& what); // in --help: "N", "FILE", "NAME|FILE"
    OptionEntry& check(const ValueCheck&);
    OptionEntry& one_of(const std::vector<std::string>& names);
    OptionEntry& one_of_any_case(const std::vector<std::string>& names); // and then is as it stands in `names`
    OptionEntry& excludes(const OptionEntry& other);
    OptionEntry& any_number_of_times(); // with one value each time: of a list
    OptionEntry& in_a_row();            // with one value or more, one time: of a list

private:
    CLI::Option& option_;
};

// How the arguments of a program were read.
struct OptionsRead {
    enum class End { work, help, version, wrong } end;
    std::string text; // the help, or what is wrong
};

class OptionList {
public:
    OptionList(const std::string& name, const std::string& about, const std::string& epilog);
    ~OptionList();

    // Value: std::string, double, int, std::int64_t, std::uint64_t, std::optional of these numbers, or a list of strings; it stays as it is where the
    // option is not given. A name without a dash is that of the next argument which is no option.
    template <class Value> OptionEntry add(const std::string& name, Value& value, const std::string& help);
    void add_flag(const std::string& name, bool& value, const std::string& help);
    void add_flag(const std::string& name, std::function<void()> when_given, const std::string& help);
    void add_help(const std::string& version_help); // --help and --version

    // Once, after all are declared. Throws what when_given does.
    OptionsRead read(int argc, char** argv);
    bool given(const std::string& name) const;
    // The first that was given and is none of these; or "".
    std::string given_beside(const std::vector<std::string>& names) const;

private:
    std::unique_ptr<CLI::App> app_;
};

} // namespace bough
