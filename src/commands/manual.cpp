#include "commands/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace wavepath {
namespace {

std::vector<std::string> split(const std::string& text, const char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* command) {
        return !command->get_group().empty() && !command->get_name().empty();
    });
}

// Also those in option groups, which CLI11 keeps as subcommands without a name.
std::vector<const CLI::Option*> visible_options(const CLI::App& app) {
    auto options =
        app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
    for (const CLI::App* group :
         app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); })) {
        auto inner = visible_options(*group);
        std::erase(inner, group->get_help_ptr());  // each group inherits one
        options.insert(options.end(), inner.begin(), inner.end());
    }
    return options;
}

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

bool is_positional_only(const CLI::Option& option) {
    return option.get_lnames().empty() && option.get_snames().empty();
}

// What stands for the value in the help: the option's own text, else its choices, else its type.
std::string value_hint(const CLI::Option& option) {
    if (!option.get_option_text().empty()) return option.get_option_text();
    const std::string type = option.get_type_name();  // NAME[:VALIDATOR...], a set as {a,b,c}
    const auto open = type.find('{'), close = type.find('}');
    if (open != std::string::npos && close != std::string::npos)
        return fmt::format(
            "{}", fmt::join(split(type.substr(open + 1, close - open - 1), ','), "|"));
    const auto colon = type.find(':');
    return type.starts_with("TEXT:") ? type.substr(colon + 1)
                                     : type.substr(0, colon);  // TEXT:FILE is FILE
}

// The alternatives of a hint such as "area|power" that can be typed as they stand.
std::vector<std::string> choices(const CLI::Option& option) {
    const std::string hint = value_hint(option);
    if (hint.find('|') == std::string::npos) return {};
    std::vector<std::string> words = split(hint, '|');
    std::erase_if(words, [](const std::string& word) {
        return word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos;
    });
    return words;
}

// A hint that names a file: FILE, or one with an extension such as OUT.exr.
bool takes_file(const CLI::Option& option) {
    const std::string hint = value_hint(option);
    return hint.find("FILE") != std::string::npos || hint.find('.') != std::string::npos;
}

std::vector<std::string> flags(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

// Text that roff prints as it stands [groff_man_style(7), "Portability"].
std::string roff(const std::string_view text) {
    static const std::map<char, std::string_view> escapes{
        {'\\', "\\(rs"}, {'-', "\\-"},   {'\'', "\\(aq"}, {'"', "\\(dq"},
        {'`', "\\(ga"},  {'^', "\\(ha"}, {'~', "\\(ti"},  {'\n', "\n.br\n"}};
    std::string escaped;
    bool line_start = true;
    for (const char c : text) {
        if (line_start && c == '.') escaped += "\\&";
        line_start = c == '\n';
        const auto escape = escapes.find(c);
        if (escape != escapes.end())
            escaped += escape->second;
        else
            escaped += c;
    }
    return escaped;
}

// The name of an argument that has no flag.
std::string positional_name(const CLI::Option& option) {
    const std::string& text = option.get_option_text();
    return text.empty() ? option.get_name(true) : text;
}

std::string man_options(const CLI::App& app) {
    std::string page;
    for (const CLI::Option* option : visible_options(app)) {
        if (app.get_parent() != nullptr && option == app.get_help_ptr())
            continue;  // said once, for all
        std::string tag;
        if (is_positional_only(*option)) {
            tag = "\\fI" + roff(positional_name(*option)) + "\\fR";
        } else {
            tag = "\\fB" + roff(fmt::format("{}", fmt::join(flags(*option), ", "))) + "\\fR";
            if (takes_value(*option)) tag += " \\fI" + roff(value_hint(*option)) + "\\fR";
        }
        std::string text = roff(option->get_description());
        if (takes_value(*option) && !option->get_default_str().empty())
            text += fmt::format(" [default: {}]", roff(option->get_default_str()));
        page += fmt::format(".TP\n{}\n{}\n", tag, text.empty() ? "\\&" : text);
    }
    return page;
}

// "render SCENE [options]"
std::string synopsis(const CLI::App& command) {
    std::string line = "\\fB" + roff(command.get_name()) + "\\fR";
    for (const CLI::Option* option : visible_options(command))
        if (is_positional_only(*option)) line += " \\fI" + roff(positional_name(*option)) + "\\fR";
    return line + " [\\fIoptions\\fR]";
}

// The branches of a shell case statement on "command previous-word".
std::string completion_values(const CLI::App& app) {
    std::string cases;
    for (const CLI::Option* option : visible_options(app)) {
        if (is_positional_only(*option) || !takes_value(*option)) continue;
        std::vector<std::string> patterns;
        const std::string command = app.get_parent() == nullptr ? "" : app.get_name();
        for (const std::string& flag : flags(*option))
            patterns.push_back(fmt::format("'{} {}'", command, flag));
        const auto words = choices(*option);
        const std::string action = !words.empty() ? fmt::format("words='{}'", fmt::join(words, " "))
                                   : takes_file(*option) ? "files=1"
                                                         : "return";
        cases += fmt::format("        {}) {} ;;\n", fmt::join(patterns, " | "), action);
    }
    return cases;
}

std::string completion_flags(const CLI::App& app) {
    std::vector<std::string> words;
    for (const CLI::Option* option : visible_options(app)) {
        const auto names = flags(*option);
        words.insert(words.end(), names.begin(), names.end());
    }
    return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

std::string man_page(const CLI::App& app) {
    const std::string& name = app.get_name();
    const std::string description = app.get_description();
    const std::string summary = description.substr(0, description.find('\n'));
    std::string upper = name;
    std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) {
        return static_cast<char>(std::toupper(c));
    });

    std::string page =
        fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", roff(upper), roff(app.version()));
    page += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", roff(name), roff(summary));
    for (const CLI::App* command : visible_commands(app))
        page += fmt::format("\\fB{}\\fR {}\n.br\n", roff(name), synopsis(*command));
    page += fmt::format(
        ".SH DESCRIPTION\n{}\n.SH OPTIONS\n{}.SH COMMANDS\n", roff(description), man_options(app));
    for (const CLI::App* command : visible_commands(app))
        page += fmt::format(
            ".SS \"{} {}\"\n{}\n{}", roff(name), synopsis(*command),
            roff(command->get_description()), man_options(*command));
    if (!app.get_footer().empty()) page += fmt::format(".SH NOTES\n{}\n", roff(app.get_footer()));
    return page;
}

std::string bash_completion(const CLI::App& app) {
    const std::string& name = app.get_name();
    std::vector<std::string> commands;
    std::string values = completion_values(app), command_flags;
    for (const CLI::App* command : visible_commands(app)) {
        commands.push_back(command->get_name());
        values += completion_values(*command);
        command_flags += fmt::format(
            "        {}) words='{}' ;;\n", command->get_name(), completion_flags(*command));
    }
    return fmt::format(
        R"(# bash completion for {name}, written by the program from its own options
_{name}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
    local word command= words= files=
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case $word in {commands_pattern}) command=$word; break ;; esac
    done
    COMPREPLY=()
    case "$command $previous" in
{values}        *) case $command in
        '') words='{commands} {flags}' ;;
{command_flags}        esac
        [[ -n $command && $current != -* ]] && files=1 ;;
    esac
    if [[ -n $files ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    fi
}}
complete -F _{name} {name}
)",
        fmt::arg("name", name), fmt::arg("commands_pattern", fmt::join(commands, " | ")),
        fmt::arg("commands", fmt::join(commands, " ")), fmt::arg("flags", completion_flags(app)),
        fmt::arg("values", values), fmt::arg("command_flags", command_flags));
}

}  // namespace wavepath
