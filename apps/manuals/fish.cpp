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

std::string completion_of(const OptionText& option) {
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
    if (!option.argument.empty()) return text + completion_of(option) + "\n";
    if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
    return text + " -l " + option.long_name.substr(2) + completion_of(option) + " -d " +
           quoted(option.help) + "\n";
}

/// Returns what is offered to a command, and to the commands that it has; `words` are the words
/// that precede it and its name.
std::string lines(const CommandText& command, const std::string& words) {
    std::string text;
    const bool is_parent = !command.commands.empty();
    const std::string condition = words + (is_parent ? " ''" : "");
    for (const OptionText& option : command.options)
        text += line(condition, option);
    for (const CommandText& own : command.commands) {
        text += fmt::format("complete -c dotpose -n {} -a {} -d {}\n", quoted(condition), own.name,
                            quoted(own.what));
    }
    for (const CommandText& own : command.commands)
        text += "\n" + lines(own, words + " " + own.name);
    return text;
}

}  // namespace

std::string fish_completions(const ToolText& tool) {
    return "# Completions of dotpose for fish. Written by dotpose_manuals from the options of the "
           "tool.\n\n"
           "# Whether the words before the one that is typed begin with these; an empty one stands "
           "for none.\n"
           "function __dotpose_command\n"
           "    set -l words (commandline -opc)\n"
           "    for i in (seq (count $argv))\n"
           "        set -l next (math $i + 1)\n"
           "        test \"$words[$next]\" = \"$argv[$i]\"; or return 1\n"
           "    end\n"
           "end\n\n"
           "complete -c dotpose -f\n" +
           lines(tool.top, "__dotpose_command");
}

}  // namespace dotpose::manuals
