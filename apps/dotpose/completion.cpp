#include "completion.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace dotpose::cli {
namespace {

/// Prints a completion if `name` begins with the text typed so far.
void offer(const std::string& typed, const std::string& name, const std::string& what) {
    if (name.starts_with(typed)) fmt::print("{}\t{}\n", name, what);
}

void offer_options(const std::string& typed, const Command& command) {
    for (const Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            offer(typed, "--" + name, option->get_description());
        for (const std::string& name : option->get_snames())
            offer(typed, "-" + name, option->get_description());
    }
}

void offer_choices(const std::string& typed, const Option& option) {
    for (const std::string& name : option.choices())
        offer(typed, name, "");
}

/// Returns the subcommand of `parent` with the given name, or null if there is none.
Command* command_named(const std::string& name, const Command& parent) {
    const std::vector<Command*> commands = parent.get_all_subcommands();
    const auto found = std::ranges::find(commands, name, &Command::get_name);
    return found == commands.end() ? nullptr : *found;
}

}  // namespace

void print_completions(Command& app, std::vector<std::string> words) {
    // bash splits --option=value into the three words "--option", "=" and "value", so the words "="
    // are removed.
    if (words.empty() || words.back() == "=") words.emplace_back();
    std::erase(words, "=");
    const std::string typed = words.back();
    words.pop_back();

    Command* command = &app;
    auto word = words.begin();
    for (; word != words.end(); ++word) {
        Command* own = command_named(*word, *command);
        if (own == nullptr) break;
        command = own;
    }
    const bool is_after_command = word == words.end();
    const std::vector<Option*> options = command->get_options();
    if (options.empty()) app.parse({command->get_name()});

    const Option* before = words.empty() ? nullptr : command->get_option_no_throw(words.back());
    if (before != nullptr && before->get_items_expected_max() > 0)
        return offer_choices(typed, *before);
    if (typed.starts_with('-')) return offer_options(typed, *command);
    for (const Command* own : command->get_all_subcommands()) {
        if (is_after_command) offer(typed, own->get_name(), own->get_description());
    }
    for (const Option* option : options) {
        if (option->get_positional()) offer_choices(typed, *option);
    }
}

}  // namespace dotpose::cli
