#include "option_help.h"
#include <algorithm>
#include <sstream>

namespace bough {
namespace {

constexpr std::size_t width = 80, text_column = 26;

// Words set in lines of `width`, the first of which has `used` columns already; each later one begins at `indent`.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t used) {
    std::string out;
    std::istringstream words(text);
    bool begins = true;
    for (std::string word; words >> word; begins = false) {
        if (!begins && used + 1 + word.size() > width) {
            out += "\n" + std::string(indent, ' ');
            used = indent;
        } else if (!begins) {
            out += ' ';
            ++used;
        }
        out += word;
        used += word.size();
    }
    return out;
}

std::string joined(const std::vector<std::string>& names, const std::string& between) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> groups_of(const HelpPage& page, bool all) {
    std::vector<std::string> groups;
    for (const OptionHelp& option : page.options)
        if ((all || option.first) && std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    return groups;
}

std::string option_line(const OptionHelp& option) {
    std::string line = "  " + joined(option.names, ", ") + (option.takes.empty() ? "" : " " + option.takes);
    if (line.size() + 2 > text_column)
        line += "\n" + std::string(text_column, ' ');
    else
        line.append(text_column - line.size(), ' ');
    return line + wrapped(option.text, text_column, text_column) + "\n";
}

constexpr const char* exits = "0 done; 1 wrong use; 2 an input is missing, broken or refused; 3 the motion became "
                              "non-finite, or a promise is broken; 4 an output could not be written; 130 interrupted.";

std::string manual_name(std::string command) {
    std::replace(command.begin(), command.end(), ' ', '-');
    return command;
}

// As roff takes it for text: no line begins with a control character, and hyphens are those that are typed.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out.insert(0, "\\&");
    return out;
}

std::string quoted_for_shell(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::vector<std::string> typed_names(const HelpPage& page) {
    std::vector<std::string> names;
    for (const OptionHelp& option : page.options)
        for (const std::string& name : option.names)
            if (name[0] == '-') names.push_back(name);
    return names;
}

// The first sentence, for a list that a shell shows.
std::string in_short(const std::string& text) {
    const std::string sentence = text.substr(0, text.find_first_of(";:"));
    return sentence.size() <= 60 ? sentence : sentence.substr(0, sentence.rfind(' ', 60)) + " ...";
}

std::string function_name(const HelpPage& page) {
    std::string name = "_" + manual_name(page.command);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::string bash(const std::vector<HelpPage>& pages) {
    std::string out;
    for (const HelpPage& page : pages) {
        out += function_name(page) + "_options() {\n    case $3 in\n";
        for (const OptionHelp& option : page.options)
            if (!option.values.empty() && option.names[0][0] == '-')
                out += "        " + joined(option.names, " | ") + ") COMPREPLY=($(compgen -W \"" +
                       joined(option.values, " ") + "\" -- \"$2\")) && return ;;\n";
        out += "    esac\n    [[ $2 != -* ]] || COMPREPLY=($(compgen -W \"" + joined(typed_names(page), " ") +
               "\" -- \"$2\"))\n}\n";
    }
    const HelpPage& tool = pages.front();
    out += function_name(tool) + "() {\n";
    if (!tool.commands.empty())
        out += "    if [[ $COMP_CWORD -eq 1 && $2 != -* ]]; then\n        COMPREPLY=($(compgen -W \"" +
               joined(tool.commands, " ") + "\" -- \"$2\"))\n        return\n    fi\n";
    out += "    case ${COMP_WORDS[1]-} in\n";
    for (std::size_t k = 1; k < pages.size(); ++k)
        out += "        " + pages[k].command.substr(tool.command.size() + 1) + ") " + function_name(pages[k]) +
               "_options \"$@\" ;;\n";
    out += "        *) " + function_name(tool) + "_options \"$@\" ;;\n    esac\n}\n";
    return out + "complete -o default -F " + function_name(tool) + " " + tool.command + "\n";
}

// One option of _arguments: '(-o --output)'{-o,--output}'[text]:FILE:_files'.
std::string zsh_option(const OptionHelp& option) {
    std::string text = in_short(option.text);
    for (const char c : std::string("[]:"))
        for (std::size_t at = text.find(c); at != std::string::npos; at = text.find(c, at + 2)) text.insert(at, "\\");
    std::string what = "[" + text + "]";
    if (!option.takes.empty()) {
        std::string takes = option.takes;
        std::replace(takes.begin(), takes.end(), ':', ' ');
        what += ":" + takes + ":" + (option.values.empty() ? "_files" : "(" + joined(option.values, " ") + ")");
    }
    std::string out;
    for (const std::string& name : option.names) out += " " + quoted_for_shell(name + what);
    return out;
}

std::string zsh(const std::vector<HelpPage>& pages) {
    const HelpPage& tool = pages.front();
    std::string out = "#compdef " + tool.command + "\ncase ${words[2]-} in\n";
    for (std::size_t k = pages.size(); k-- > 0;) {
        out +=
            k == 0 ? "    *) _arguments" : "    " + pages[k].command.substr(tool.command.size() + 1) + ") _arguments";
        for (const OptionHelp& option : pages[k].options)
            if (option.names[0][0] == '-') out += zsh_option(option);
        if (k == 0 && !tool.commands.empty())
            out += " " + quoted_for_shell("1: :{ compadd " + joined(tool.commands, " ") + "; _files }");
        out += " '*:file:_files' ;;\n";
    }
    return out + "esac\n";
}

std::string fish(const std::vector<HelpPage>& pages) {
    const HelpPage& tool = pages.front();
    std::string out;
    if (!tool.commands.empty())
        out += "complete -c " + tool.command + " -n '__fish_is_first_token' -a " +
               quoted_for_shell(joined(tool.commands, " ")) + "\n";
    std::string others; // than the first, whose options are the tool's own
    for (std::size_t k = 1; k < pages.size(); ++k) others += " " + pages[k].command.substr(tool.command.size() + 1);
    for (std::size_t k = 0; k < pages.size(); ++k) {
        const std::string seen = "__fish_seen_subcommand_from";
        const std::string when = k > 0            ? seen + pages[k].command.substr(tool.command.size())
                                 : others.empty() ? ""
                                                  : "not " + seen + others;
        for (const OptionHelp& option : pages[k].options) {
            if (option.names[0][0] != '-') continue;
            out += "complete -c " + tool.command + (when.empty() ? "" : " -n '" + when + "'");
            for (const std::string& name : option.names)
                out += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.values.empty()) out += " -a " + quoted_for_shell(joined(option.values, " "));
            out += std::string(option.takes.empty() ? "" : " -r") + " -d " + quoted_for_shell(in_short(option.text)) +
                   "\n";
        }
    }
    return out;
}

} // namespace

std::string help_text(const HelpPage& page, bool all) {
    std::string out = wrapped(page.about, 0, 0) + "\n\n";
    for (const std::string& line : lines_of(page.usage))
        out += (out.ends_with("\n\n") ? "Usage: " : "       ") + line + "\n";
    bool more = false;
    for (const std::string& group : groups_of(page, all)) {
        out += "\n" + group + ":\n";
        for (const OptionHelp& option : page.options)
            if (option.group == group && (all || option.first)) out += option_line(option);
    }
    for (const OptionHelp& option : page.options) more = more || !option.first;
    if (more && !all)
        out += "\nMore options: " + page.command + " --help-all. The manual: man " + manual_name(page.command) + ".\n";
    for (const std::string& line : lines_of(page.details)) out += "\n" + wrapped(line, 0, 0) + "\n";
    if (!page.examples.empty()) out += "\nExamples:\n";
    for (const std::string& line : lines_of(page.examples)) out += "  " + line + "\n";
    return out + "\nExit: " + wrapped(exits, 0, 6) + "\n";
}

std::string manual_page(const HelpPage& page, const std::string& version) {
    std::string capitals = manual_name(page.command);
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
    std::string about = page.about;
    while (about.ends_with('.')) about.pop_back();
    std::string out = ".TH " + capitals + " 1 \"\" \"bough " + version + "\"\n.SH NAME\n" +
                      roff(manual_name(page.command)) + " \\- " + roff(about) + "\n.SH SYNOPSIS\n.nf\n";
    for (const std::string& line : lines_of(page.usage)) out += roff(line) + "\n";
    out += ".fi\n";
    if (!page.details.empty()) out += ".SH DESCRIPTION\n";
    for (const std::string& line : lines_of(page.details)) out += ".PP\n" + roff(line) + "\n";
    out += ".SH OPTIONS\n";
    for (const std::string& group : groups_of(page, true)) {
        out += ".SS " + roff(group) + "\n";
        for (const OptionHelp& option : page.options) {
            if (option.group != group) continue;
            out += ".TP\n\\fB" + roff(joined(option.names, ", ")) + "\\fR";
            if (!option.takes.empty()) out += " \\fI" + roff(option.takes) + "\\fR";
            out += "\n" + roff(option.text) + "\n";
        }
    }
    if (!page.examples.empty()) out += ".SH EXAMPLES\n.nf\n";
    for (const std::string& line : lines_of(page.examples)) out += roff(line) + "\n";
    if (!page.examples.empty()) out += ".fi\n";
    out += ".SH EXIT STATUS\n" + roff(exits) + "\n.SH SEE ALSO\n";
    std::vector<std::string> others;
    const std::string tool = page.command.substr(0, page.command.find(' '));
    for (const char* name : {"treegen", "treeconvert", "treesim", "treeprofile"})
        if (page.command != name) others.push_back("\\fB" + std::string(name) + "\\fR(1)");
    for (const std::string& command : page.commands) others.push_back("\\fB" + roff(tool + "-" + command) + "\\fR(1)");
    return out + joined(others, ", ") + "\n";
}

std::string completion(const std::vector<HelpPage>& pages, const std::string& shell) {
    return shell == "bash" ? bash(pages) : shell == "zsh" ? zsh(pages) : fish(pages);
}

} // namespace bough
