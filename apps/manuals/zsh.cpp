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

std::string specification(const OptionText& option) {
    if (!option.argument.empty())
        return fmt::format("'{}{}'", option.is_repeated ? "*" : "1", values(option));
    const std::string rest = fmt::format("'[{}]{}'", escaped(option.help), values(option));
    const char* equals = option.type.empty() ? "" : "=";
    if (option.short_name.empty()) return option.long_name + equals + rest;
    return fmt::format("'({0} {1})'{{{0},{1}{2}}}{3}", option.short_name, option.long_name, equals,
                       rest);
}

std::string specifications(const CommandText& command, const char* indent) {
    std::string text = "_arguments -S";
    for (const OptionText& option : command.options)
        text += fmt::format(" \\\n{}{}", indent, specification(option));
    return text;
}

}  // namespace

std::string zsh_completions(const ToolText& tool) {
    std::string text =
        "#compdef dotpose\n"
        "# Completions of dotpose for zsh. Written by dotpose_manuals from the options of the "
        "tool.\n\n"
        "_dotpose() {\n"
        "    local curcontext=$curcontext state line\n"
        "    typeset -A opt_args\n    ";
    text += specifications(tool.top, "        ") +
            " \\\n        '1:command:->command' '*::argument:->argument' && return\n"
            "    case $state in\n    command)\n        local -a commands=(\n";
    for (const CommandText& command : tool.commands)
        text += fmt::format("            '{}:{}'\n", command.name, escaped(command.what));
    text +=
        "        )\n        _describe command commands ;;\n"
        "    argument)\n        case $words[1] in\n";
    for (const CommandText& command : tool.commands) {
        text += fmt::format("        {})\n            {} ;;\n", command.name,
                            specifications(command, "                "));
    }
    return text + "        esac ;;\n    esac\n}\n\n_dotpose \"$@\"\n";
}

}  // namespace dotpose::manuals
