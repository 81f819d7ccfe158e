// Completions for zsh, in the terms of its function _arguments.
#include <fmt/core.h>

#include "writers.hpp"

namespace dotpose::manuals {
namespace {

/// Returns the text as it stands between single quotes, in a place where _arguments and _describe
/// take some characters for their own.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\'') {
            result += "'\\''";
        } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
            result += std::string("\\") + c;
        } else {
            result += c;
        }
    }
    return result;
}

/// Returns ":TYPE:action" for each value of an option.
std::string values(const OptionText& option) {
    if (option.type.empty()) return {};
    std::string action = " ";  // no offer
    if (option.kind == ValueKind::file) action = "_files";
    if (option.kind == ValueKind::folder) action = "_files -/";
    if (!option.choices.empty()) {
        action = "(";
        for (const std::string& choice : option.choices)
            action += (action == "(" ? "" : " ") + choice;
        action += ")";
    }
    const std::string value = ":" + escaped(option.type) + ":" + action;
    if (option.is_repeated) return option.argument.empty() ? ":*" + value : value;
    std::string text = value;
    for (int i = 1; i < option.values; ++i)
        text += value;
    return text;
}

/// `place` counts the arguments without an option from 1.
std::string specification(const OptionText& option, int place) {
    if (!option.argument.empty()) {
        const std::string which = option.is_repeated ? "*" : std::to_string(place);
        return fmt::format("'{}{}'", which, values(option));
    }
    const std::string rest = fmt::format("'[{}]{}'", escaped(option.help), values(option));
    const char* equals = option.type.empty() ? "" : "=";
    if (option.short_name.empty()) return option.long_name + equals + rest;
    return fmt::format("'({0} {1})'{{{0},{1}{2}}}{3}", option.short_name, option.long_name, equals,
                       rest);
}

/// Returns what is offered to a command, and to the commands that it has.
std::string body(const CommandText& command, const std::string& indent) {
    const std::string inner = indent + "    ";
    std::string text = indent + "_arguments -S";
    int place = 1;
    for (const OptionText& option : command.options) {
        text += fmt::format(" \\\n{}{}", inner, specification(option, place));
        if (!option.argument.empty()) ++place;
    }
    if (command.commands.empty()) return text + "\n";
    text += fmt::format(
        " \\\n{0}    '1:command:->command' '*::argument:->argument' && return\n"
        "{0}case $state in\n{0}command)\n{0}    local -a commands=(\n",
        indent);
    for (const CommandText& own : command.commands)
        text += fmt::format("{}    '{}:{}'\n", inner, own.name, escaped(own.what));
    text += fmt::format(
        "{0}    )\n{0}    _describe command commands ;;\n{0}argument)\n{0}    case $words[1] in\n",
        indent);
    for (const CommandText& own : command.commands) {
        text += fmt::format("{0}{1})\n{2}{0}    ;;\n", inner, own.name, body(own, inner + "    "));
    }
    return text + fmt::format("{0}    esac ;;\n{0}esac\n", indent);
}

}  // namespace

std::string zsh_completions(const ToolText& tool) {
    return "#compdef dotpose\n"
           "# Completions of dotpose for zsh. Written by dotpose_manuals from the options of the "
           "tool.\n\n"
           "_dotpose() {\n"
           "    local curcontext=$curcontext state line\n"
           "    typeset -A opt_args\n" +
           body(tool.top, "    ") + "}\n\n_dotpose \"$@\"\n";
}

}  // namespace dotpose::manuals
