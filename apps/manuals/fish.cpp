// Completions for fish.
#include <fmt/core.h>

#include "writers.hpp"

namespace dotpose::manuals {
namespace {

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') result += '\\';
        result += c;
    }
    return result + "'";
}

std::string offer(const OptionText& option) {
    if (!option.choices.empty()) {
        std::string words;
        for (const std::string& choice : option.choices)
            words += (words.empty() ? "" : " ") + choice;
        return " -x -a " + quoted(words);
    }
    switch (option.kind) {
        case ValueKind::none:
            return {};
        case ValueKind::file:
            return " -r -F";
        case ValueKind::folder:
            return " -x -a '(__fish_complete_directories)'";
        case ValueKind::text:
            return " -x";
    }
    return {};
}

std::string line(const std::string& condition, const OptionText& option) {
    std::string text = "complete -c dotpose -n " + quoted(condition);
    if (!option.argument.empty()) return text + offer(option) + "\n";
    if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
    return text + " -l " + option.long_name.substr(2) + offer(option) + " -d " +
           quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completions(const ToolText& tool) {
    std::string text =
        "# Completions of dotpose for fish. Written by dotpose_manuals from the options of the "
        "tool.\n\n"
        "# Whether the command is the one that is named, or none yet without a name.\n"
        "function __dotpose_command\n"
        "    set -l words (commandline -opc)\n"
        "    test \"$words[2]\" = \"$argv[1]\"\n"
        "end\n\n"
        "complete -c dotpose -f\n";
    for (const OptionText& option : tool.top.options)
        text += line("__dotpose_command", option);
    for (const CommandText& command : tool.commands) {
        text += fmt::format("complete -c dotpose -n __dotpose_command -a {} -d {}\n", command.name,
                            quoted(command.what));
    }
    for (const CommandText& command : tool.commands) {
        text += "\n";
        for (const OptionText& option : command.options)
            text += line("__dotpose_command " + command.name, option);
    }
    return text;
}

}  // namespace dotpose::manuals
