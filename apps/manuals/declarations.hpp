/// The declarations that the commands make to CLI11, as text for manual pages and completions.
#pragma once

#include <string>
#include <vector>

namespace dotpose::manuals {

/// The kind of value of an option, by which a shell knows what to offer.
enum class ValueKind { none, file, folder, text };

struct OptionText {
    std::string short_name;  ///< such as "-o", or empty
    std::string long_name;   ///< such as "--out"; empty for an argument without an option
    std::string argument;    ///< name of an argument without an option, such as "images"
    std::string type;        ///< such as "FILE"; empty for a flag
    std::string default_text;
    std::string help;
    std::vector<std::string> needs, excludes;  ///< other options
    std::vector<std::string> choices;          ///< all possible values, none if there are others
    ValueKind kind = ValueKind::none;
    bool is_required = false;
    bool is_repeated = false;  ///< takes any number of values
    int values = 1;            ///< how many values follow the option, if not repeated
};

struct CommandText {
    std::string name;
    std::string what;                   ///< what it does, in one line
    std::string notes;                  ///< examples and more, below the options in its help
    std::vector<OptionText> options;    ///< arguments without an option among them
    std::vector<CommandText> commands;  ///< commands of its own, such as `list` of `sheets`
};

struct ToolText {
    std::string version;    ///< "dotpose 1.2.3"
    std::string first_day;  ///< examples for a new user
    CommandText top;        ///< the tool itself, with all commands
};

/// Returns the declarations of all commands, of `dotpose` and of `dotpose-live`.
ToolText declarations();

}  // namespace dotpose::manuals
