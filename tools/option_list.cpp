#include "option_list.h"
#include <CLI/CLI.hpp>

namespace bough {

OptionEntry& OptionEntry::takes(const std::string& what) {
    option_.option_text(what);
    return *this;
}

OptionEntry& OptionEntry::check(const ValueCheck& wrong) {
    option_.check(CLI::Validator([wrong](const std::string& text) { return wrong(text); }, "", ""));
    return *this;
}

OptionEntry& OptionEntry::one_of(const std::vector<std::string>& names) {
    option_.check(CLI::IsMember(names));
    return *this;
}

OptionEntry& OptionEntry::one_of_any_case(const std::vector<std::string>& names) {
    option_.transform(CLI::IsMember(names, CLI::ignore_case));
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

OptionList::OptionList(const std::string& name, const std::string& about, const std::string& epilog)
    : app_(std::make_unique<CLI::App>(about, name)) {
    app_->option_defaults()->always_capture_default(false);
    app_->get_formatter()->column_width(30);
    app_->footer(epilog);
}

OptionList::~OptionList() = default;

template <class Value> OptionEntry OptionList::add(const std::string& name, Value& value, const std::string& help) {
    return OptionEntry(*app_->add_option(name, value, help));
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

void OptionList::add_flag(const std::string& name, bool& value, const std::string& help) {
    app_->add_flag(name, value, help);
}

void OptionList::add_flag(const std::string& name, std::function<void()> when_given, const std::string& help) {
    app_->add_flag_callback(name, std::move(when_given), help);
}

void OptionList::add_help(const std::string& version_help) {
    app_->set_help_flag("-h,--help", "Print this help and exit");
    app_->add_flag_callback(
        "--version", [] { throw CLI::CallForVersion("", 0); }, version_help);
}

bool OptionList::given(const std::string& name) const {
    return app_->get_option(name)->count() > 0;
}

std::string OptionList::given_beside(const std::vector<std::string>& names) const {
    for (const CLI::Option* option : static_cast<const CLI::App&>(*app_).get_options())
        if (option->count() > 0 &&
            std::none_of(names.begin(), names.end(), [&](const std::string& name) { return option->check_name(name); }))
            return option->get_name();
    return {};
}

OptionsRead OptionList::read(int argc, char** argv) {
    try {
        app_->parse(argc, argv);
        return {OptionsRead::End::work, {}};
    } catch (const CLI::CallForHelp&) {
        return {OptionsRead::End::help, app_->help()};
    } catch (const CLI::CallForVersion&) {
        return {OptionsRead::End::version, {}};
    } catch (const CLI::ExtrasError& error) { // in our words, as users meet these daily
        const std::vector<std::string> extras = app_->remaining(true);
        for (const std::string& extra : extras)
            if (extra.size() > 1 && extra[0] == '-') return {OptionsRead::End::wrong, extra + ": unknown option"};
        if (extras.empty()) return {OptionsRead::End::wrong, error.what()};
        return {OptionsRead::End::wrong, "'" + extras.front() + "': one argument too many"};
    } catch (const CLI::ParseError& error) {
        return {OptionsRead::End::wrong, error.what()};
    }
}

} // namespace bough
