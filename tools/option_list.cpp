#include "option_list.h"
#include "formats/nearest_name.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <sstream>
#include <type_traits>

namespace bough {
namespace {

constexpr std::array groups{"Input",  "Growth", "Volume",   "Wood",      "Wind",        "Length",
                            "Output", "Mesh",   "Numerics", "Measuring", "Distributed", "General"};

std::size_t rank(const std::string& group) {
    return std::size_t(std::find(groups.begin(), groups.end(), group) - groups.begin());
}

struct HelpAs {
    std::string form;
};

} // namespace

OptionEntry& OptionEntry::takes(const std::string& what) {
    help_.takes = what;
    return *this;
}

OptionEntry& OptionEntry::check(const ValueCheck& wrong) {
    option_.check(CLI::Validator([wrong](const std::string& text) { return wrong(text); }, "", ""));
    return *this;
}

OptionEntry& OptionEntry::one_of(const std::vector<std::string>& names) {
    option_.check(CLI::IsMember(names));
    return suggests(names);
}

OptionEntry& OptionEntry::one_of_any_case(const std::vector<std::string>& names) {
    option_.transform(CLI::IsMember(names, CLI::ignore_case));
    refuse_empty(); // before that
    return suggests(names);
}

void OptionEntry::refuse_empty() {
    option_.transform(CLI::Validator(
        [&help = help_](const std::string& text) {
            if (!text.empty()) return std::string();
            return "is empty, expected " + (help.names.front()[0] == '-' ? help.takes : "a file name");
        },
        "", ""));
}

OptionEntry& OptionEntry::suggests(const std::vector<std::string>& names) {
    help_.values = names;
    return *this;
}

OptionEntry& OptionEntry::excludes(const OptionEntry& other) {
    option_.excludes(&other.option_);
    return *this;
}

OptionEntry& OptionEntry::any_number_of_times() {
    option_.expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return *this;
}

OptionEntry& OptionEntry::in_a_row() {
    option_.expected(1, 1000000);
    return *this;
}

OptionList::OptionList(HelpPage head)
    : app_(std::make_unique<CLI::App>(head.about, head.command)), head_(std::move(head)) {
    app_->option_defaults()->always_capture_default(false);
    app_->set_help_flag();
}

OptionList::~OptionList() = default;

OptionEntry OptionList::entry(CLI::Option& option, const std::string& name, const std::string& help) {
    OptionHelp entry{group_, {}, "", help, {}, true};
    std::istringstream names(name);
    for (std::string one; std::getline(names, one, ',');) entry.names.push_back(one);
    help_.push_back(std::move(entry));
    return OptionEntry(option, help_.back());
}

template <class Value> OptionEntry OptionList::add(const std::string& name, Value& value, const std::string& help) {
    OptionEntry added = entry(*app_->add_option(name, value), name, help);
    if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<std::string>>)
        added.refuse_empty();
    return added;
}

template OptionEntry OptionList::add(const std::string&, std::string&, const std::string&);
template OptionEntry OptionList::add(const std::string&, double&, const std::string&);
template OptionEntry OptionList::add(const std::string&, int&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::int64_t&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::uint64_t&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::optional<double>&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::optional<int>&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::optional<std::int64_t>&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template OptionEntry OptionList::add(const std::string&, std::vector<std::string>&, const std::string&);

OptionEntry OptionList::add_flag(const std::string& name, bool& value, const std::string& help) {
    return entry(*app_->add_flag(name, value), name, help);
}

OptionEntry OptionList::add_flag(const std::string& name, std::function<void()> when_given, const std::string& help) {
    return entry(*app_->add_flag_callback(name, std::move(when_given)), name, help);
}

void OptionList::add_help(const std::string& version_help) {
    entry(*app_->set_help_flag("-h,--help"), "-h,--help", "Print this help and exit");
    entry(*app_->set_help_all_flag("--help-all"), "--help-all", "Print all options and exit");
    add_flag(
        "--version", [] { throw CLI::CallForVersion("", 0); }, version_help);
    // For the build, which makes manuals and completions of it: in no help.
    app_->add_option_function<std::string>("--help-as", [](const std::string& form) { throw HelpAs{form}; })
        ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
}

void OptionList::group(const std::string& name) {
    group_ = name;
}

void OptionList::first(const std::vector<std::string>& names) {
    for (OptionHelp& option : help_)
        option.first = std::any_of(option.names.begin(), option.names.end(), [&](const std::string& name) {
            return std::find(names.begin(), names.end(), name) != names.end();
        });
}

void OptionList::renamed(const std::string& old, const std::string& now) {
    refused_.emplace_back(old, "is now " + now);
}

void OptionList::elsewhere(const std::string& name, const std::string& where) {
    for (const OptionHelp& option : help_)
        if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return;
    refused_.emplace_back(name, where);
}

HelpPage OptionList::page() const {
    HelpPage page = head_;
    page.options.assign(help_.begin(), help_.end());
    std::stable_sort(page.options.begin(), page.options.end(),
                     [](const OptionHelp& a, const OptionHelp& b) { return rank(a.group) < rank(b.group); });
    return page;
}

bool OptionList::given(const std::string& name) const {
    return app_->get_option(name)->count() > 0;
}

std::string OptionList::wrong_name(const std::string& given) const {
    std::vector<std::string> names;
    for (const OptionHelp& option : help_) names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string name = nearest_name(given.substr(0, given.find('=')), names, 2);
    return given + ": unknown option" + (name.empty() ? "" : ", did you mean " + name + "?");
}

std::string OptionList::taken() const {
    std::string all;
    for (const OptionHelp& option : help_)
        for (const std::string& name : option.names)
            if (name[0] != '-') all += (all.empty() ? "" : " ") + name;
    return all.empty() ? "options alone" : all + " and options";
}

OptionsRead OptionList::read(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k], given = word.substr(0, word.find('='));
        for (const auto& [name, why] : refused_)
            if (given == name) return {OptionsRead::End::wrong, name + ": " + why};
        if (word == "--") break;
        if (given.size() + 1 != word.size()) continue;
        for (const OptionHelp& option : help_) // CLI11 would take the next argument for the value
            if (!option.takes.empty() &&
                std::find(option.names.begin(), option.names.end(), given) != option.names.end())
                return {OptionsRead::End::wrong, given + ": is empty after its '=', expected " + option.takes};
    }
    try {
        app_->parse(argc, argv);
        return {OptionsRead::End::work, {}};
    } catch (const CLI::CallForHelp&) {
        return {OptionsRead::End::help, help_text(page(), false)};
    } catch (const CLI::CallForAllHelp&) {
        return {OptionsRead::End::help, help_text(page(), true)};
    } catch (const HelpAs& as) {
        return {OptionsRead::End::help_as, as.form};
    } catch (const CLI::CallForVersion&) {
        return {OptionsRead::End::version, {}};
    } catch (const CLI::ExtrasError& error) { // in our words, as users meet these daily
        const std::vector<std::string> extras = app_->remaining(true);
        for (const std::string& extra : extras)
            if (extra.size() > 1 && extra[0] == '-') return {OptionsRead::End::wrong, wrong_name(extra)};
        if (extras.empty()) return {OptionsRead::End::wrong, error.what()};
        return {OptionsRead::End::wrong, "'" + extras.front() + "': one argument too many, expected " + taken()};
    } catch (const CLI::ParseError& error) {
        return {OptionsRead::End::wrong, error.what()};
    }
}

} // namespace bough
