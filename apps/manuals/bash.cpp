// Completions for bash. They need no package beside bash itself.
#include <map>

#include <fmt/core.h>

#include "writers.hpp"

namespace dotpose::manuals {
namespace {

std::string joined(const std::vector<std::string>& words, const char* separator) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : separator) + word;
    return text;
}

std::vector<std::string> names_of(const OptionText& option) {
    std::vector<std::string> names;
    for (const std::string& name : {option.short_name, option.long_name}) {
        if (!name.empty()) names.push_back(name);
    }
    return names;
}

/// Returns the call that offers the values of an option; files are what bash offers by itself.
std::string offer(const OptionText& option) {
    if (!option.choices.empty())
        return fmt::format("_dotpose_words '{}'", joined(option.choices, " "));
    switch (option.kind) {
        case ValueKind::file:
            return "_dotpose_files";
        case ValueKind::folder:
            return "_dotpose_folders";
        default:
            return "_dotpose_nothing";
    }
}

/// Returns what is offered to a command after its name: values after an option that takes some,
/// options after a hyphen, else arguments.
std::string branch(const CommandText& command, const std::string& indent) {
    std::vector<std::string> options;
    std::map<std::string, std::vector<std::string>> options_of_offer;
    std::string arguments = "_dotpose_nothing";
    for (const OptionText& option : command.options) {
        if (!option.argument.empty()) arguments = offer(option);
        for (const std::string& name : names_of(option)) {
            options.push_back(name);
            if (!option.type.empty()) options_of_offer[offer(option)].push_back(name);
        }
    }
    std::string text =
        fmt::format("{0}options='{1}'\n{0}case $option in\n", indent, joined(options, " "));
    for (const auto& [call, names] : options_of_offer)
        text += fmt::format("{}{}) {} ;;\n", indent, joined(names, " | "), call);
    return text + fmt::format("{0}*) _dotpose_options \"$options\" || {1} ;;\n{0}esac\n", indent,
                              arguments);
}

/// Returns what is offered to a command that has commands, whose name is the word `level`.
std::string cases(const CommandText& command, int level, const std::string& indent) {
    std::vector<std::string> first;
    for (const CommandText& own : command.commands)
        first.push_back(own.name);
    for (const OptionText& option : command.options) {
        for (const std::string& name : names_of(option))
            first.push_back(name);
    }
    std::string text = fmt::format(
        "{0}if ((COMP_CWORD == {1})); then\n{0}    _dotpose_words '{2}'\n{0}    return\n{0}fi\n"
        "{0}case ${{COMP_WORDS[{1}]}} in\n",
        indent, level, joined(first, " "));
    const std::string inner = indent + "    ";
    for (const CommandText& own : command.commands) {
        text += fmt::format("{}{})\n", indent, own.name);
        text += own.commands.empty() ? branch(own, inner) : cases(own, level + 1, inner);
        text += inner + ";;\n";
    }
    return text + indent + "esac\n";
}

// The words that follow `compgen -W` are names of the tool, which hold no character that a shell
// would expand.
constexpr const char* kHead =
    R"(# Completions of dotpose for bash. Written by dotpose_manuals from the options of the tool.

_dotpose_words() {
    compopt +o default
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}

_dotpose_options() {
    [[ $current == -* ]] && _dotpose_words "$1"
}

_dotpose_files() {
    :  # bash offers files where this offers nothing
}

_dotpose_folders() {
    compopt +o default -o dirnames
}

_dotpose_nothing() {
    compopt +o default
}

_dotpose() {
    local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} options
    COMPREPLY=()
    # bash takes the = of --option=value for a word.
    if [[ $current == = ]]; then
        current=
    elif [[ $option == = ]]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    fi
)";

}  // namespace

std::string bash_completions(const ToolText& tool) {
    return kHead + cases(tool.top, 1, "    ") + "}\n\ncomplete -o default -F _dotpose dotpose\n";
}

}  // namespace dotpose::manuals
