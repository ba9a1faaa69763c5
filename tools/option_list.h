// option_list.h: what the command line of a tool takes, declared option by option. CLI11 reads it (option_list.cpp), and nothing else includes
// CLI11: a source that does takes six seconds longer to compile. What is declared is also what --help, manuals and completions say (option_help.h).
#pragma once
#include "option_help.h"
#include "option_values.h"
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace bough {

// One option, as it was declared; what is said of it is said in a row: add("--fps", o.fps, "Frames a second (30)").takes("F").check(...)
class OptionEntry {
public:
    OptionEntry(CLI::Option& option, OptionHelp& help) : option_(option), help_(help) {}
    OptionEntry& takes(const std::string& what); // in --help: "N", "FILE", "NAME|FILE"
    OptionEntry& check(const ValueCheck&);
    OptionEntry& one_of(const std::vector<std::string>& names);
    OptionEntry& one_of_any_case(const std::vector<std::string>& names); // and then is as it stands in `names`
    OptionEntry& suggests(const std::vector<std::string>& names);        // to shells; others are taken too
    OptionEntry& excludes(const OptionEntry& other);
    OptionEntry& any_number_of_times(); // with one value each time: of a list
    OptionEntry& in_a_row();            // with one value or more, one time: of a list

private:
    friend class OptionList;
    void refuse_empty(); // first of all checks
    CLI::Option& option_;
    OptionHelp& help_;
};

// How the arguments of a program were read.
struct OptionsRead {
    enum class End { work, help, help_as, version, wrong } end;
    std::string text; // the help; the form that --help-as asks for; or what is wrong
};

class OptionList {
public:
    explicit OptionList(HelpPage head); // without options
    ~OptionList();

    // Value: std::string, double, int, std::int64_t, std::uint64_t, std::optional of these numbers, or a list of strings; it stays as it is where the
    // option is not given. A text that is empty, as a shell's variable is that was never set, is refused. A name without a dash is that of the next
    // argument which is no option.
    template <class Value> OptionEntry add(const std::string& name, Value& value, const std::string& help);
    OptionEntry add_flag(const std::string& name, bool& value, const std::string& help);
    OptionEntry add_flag(const std::string& name, std::function<void()> when_given, const std::string& help);
    void add_help(const std::string& version_help); // --help, --help-all and --version
    // Of what is added from here on; pages show them in the order of Input ... General
    void group(const std::string& name);
    void first(const std::vector<std::string>& names);            // --help shows no others; all unless called
    void renamed(const std::string& old, const std::string& now); // the old name is refused, with what it is called now
    void elsewhere(const std::string& name,
                   const std::string& where); // likewise what this tool has not, with where it is

    HelpPage page() const;
    // Once, after all are declared. Throws what when_given does.
    OptionsRead read(int argc, char** argv);
    bool given(const std::string& name) const;

private:
    OptionEntry entry(CLI::Option&, const std::string& name, const std::string& help);
    std::string wrong_name(const std::string& given) const;
    std::string taken() const; // what it takes, in a word or two

    std::unique_ptr<CLI::App> app_;
    HelpPage head_;
    std::string group_ = "General";
    std::deque<OptionHelp> help_;                              // entries point to them
    std::vector<std::pair<std::string, std::string>> refused_; // a name, and what is said of it
};

} // namespace bough
