#include "declarations.hpp"

#include <set>

#include "../dotpose-live/commands.hpp"
#include "../dotpose/commands.hpp"
#include "command_line.hpp"
#include "tool_main.hpp"

namespace dotpose::manuals {
namespace {

ValueKind kind_of(const std::string& type) {
    const std::set<std::string> files = {"FILE",  "FILE|-", "FILE|-|DIR", "FILE|DIR",
                                         "IMAGE", "SCAN",   "SOURCE"};
    if (type.empty()) return ValueKind::none;
    if (files.contains(type)) return ValueKind::file;
    return type == "DIR" ? ValueKind::folder : ValueKind::text;
}

OptionText text_of(const cli::Option& option) {
    OptionText text;
    if (!option.get_snames().empty()) text.short_name = "-" + option.get_snames().front();
    if (!option.get_lnames().empty()) text.long_name = "--" + option.get_lnames().front();
    if (option.get_positional()) text.argument = option.get_name();
    text.help = option.get_description();
    text.needs = option.get_needs();
    text.excludes = option.get_excludes();
    text.is_required = option.get_required();
    if (option.get_items_expected_max() == 0) return text;  // a flag
    // CLI11 adds the ranges that a validator describes after a colon.
    const std::string type = option.get_type_name();
    text.type = type.substr(0, type.find(':'));
    text.default_text = option.get_default_str();
    text.choices = option.choices();
    text.kind = kind_of(text.type);
    text.is_repeated = option.takes_any_number();
    text.values = option.get_items_expected_max();
    return text;
}

CommandText text_of(const cli::Command& command) {
    CommandText text;
    text.name = command.get_name();
    text.what = command.get_description();
    text.notes = command.get_footer();
    for (const cli::Option* option : command.get_options()) {
        // Earlier spellings have no group, and no help shows them.
        if (!option->get_group().empty()) text.options.push_back(text_of(*option));
    }
    for (const cli::Command* own : command.get_all_subcommands()) {
        text.commands.push_back(text_of(*own));
        // CLI11 hands the notes of a command down to commands that have none.
        if (text.commands.back().notes == text.notes) text.commands.back().notes.clear();
    }
    return text;
}

}  // namespace

ToolText declarations() {
    cli::CommandLine line([](cli::Command& app, int& exit_code) {
        cli::add_commands(app, exit_code);
        cli::add_live_commands(app, exit_code);
    });
    ToolText text;
    text.version = cli::kVersion;
    text.first_day = cli::kFirstDay;
    text.top = text_of(line.app);
    return text;
}

}  // namespace dotpose::manuals
