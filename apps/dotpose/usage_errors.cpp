#include "usage_errors.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "nearest_name.hpp"

namespace dotpose::cli {
namespace {

bool is_option(std::string_view word) {
    return word.size() > 1 && word[0] == '-';
}

/// Returns an option without its value, such as "--format" for "--format=csv".
std::string without_value(const std::string& word) {
    return word.substr(0, word.find('='));
}

std::vector<std::string> command_names(const Command& app) {
    std::vector<std::string> names;
    for (const Command* command : app.get_all_subcommands())
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> long_options(const Command& command) {
    std::vector<std::string> names;
    for (const Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    }
    return names;
}

/// Returns the unknown words on a command line, starting with those that look like options.
std::vector<std::string> unknown_words(const Command& command) {
    std::vector<std::string> words = command.remaining();
    std::erase(words, "--");
    std::stable_partition(words.begin(), words.end(), is_option);
    return words;
}

std::string unknown_to(const Command& command, const std::string& word) {
    if (!is_option(word)) {
        const Option* out = command.get_option_no_throw("--out");
        const bool lacks_output = out != nullptr && out->count() == 0;
        return fmt::format("unexpected argument '{}'{}", word,
                           lacks_output ? "; the file to write is named with -o" : "");
    }
    const std::string option = without_value(word);
    return fmt::format("unknown option '{}'{}", option,
                       did_you_mean(option, long_options(command)));
}

/// Returns the name of the program and of the parsed commands, such as "dotpose sheets list".
std::string parsed_commands(const Command& app) {
    std::string words = "dotpose";
    for (const Command* command = &app; !command->get_parsed_subcommands().empty();) {
        command = command->get_parsed_subcommands().front();
        words += " " + command->get_name();
    }
    return words;
}

/// Returns the message for an unknown word where a command is expected. `parent` is the program, or
/// a command with subcommands.
std::string unknown_before_command(const Command& app, const Command& parent,
                                   const std::string& word) {
    if (!is_option(word)) {
        return fmt::format("unknown command '{}'{}", word,
                           did_you_mean(word, command_names(parent)));
    }
    if (parent.get_parsed_subcommands().empty()) return unknown_to(parent, word);
    return fmt::format("unknown option '{}'; options of a command follow it: {} {}",
                       without_value(word), parsed_commands(app), without_value(word));
}

}  // namespace

std::string usage_error(const Command& app, const UsageError& error) {
    for (const Command* command = &app; command != nullptr;) {
        const std::vector<std::string> words = unknown_words(*command);
        const bool has_commands = !command->get_all_subcommands().empty();
        if (!words.empty() && has_commands)
            return unknown_before_command(app, *command, words.front());
        if (!words.empty()) return unknown_to(*command, words.front());
        const std::vector<Command*> parsed = command->get_parsed_subcommands();
        command = parsed.empty() ? nullptr : parsed.front();
    }
    return error.what();
}

void require_two_hyphens(const Command& command, int argc, const char* const* argv) {
    std::vector<std::string> mistakes;
    for (const Option* option : command.get_options()) {
        if (option->get_snames().empty() || option->get_items_expected_max() == 0) continue;
        for (const std::string& name : option->get_lnames())
            mistakes.push_back("-" + name);
    }
    for (int i = 2; i < argc && std::string_view(argv[i]) != "--"; ++i) {
        const std::string option = without_value(argv[i]);
        if (std::find(mistakes.begin(), mistakes.end(), option) == mistakes.end()) continue;
        throw UsageError(fmt::format("unknown option '{}'; did you mean '-{}'?", option, option));
    }
}

std::string help_command(const Command& app) {
    const std::vector<Command*> commands = app.get_parsed_subcommands();
    if (commands.empty() || commands.front()->get_name() == kHelpCommand) return "dotpose --help";
    return parsed_commands(app) + " --help";
}

}  // namespace dotpose::cli
