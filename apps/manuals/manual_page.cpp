// Manual pages in the macros of man(7).
#include <sstream>
#include <string_view>

#include <fmt/core.h>

#include "exit_codes.hpp"
#include "writers.hpp"

namespace dotpose::manuals {
namespace {

/// Returns the text as troff prints it. A hyphen becomes the character that can be copied into a
/// command line.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
                result += "\\&";
            result += c;
        }
    }
    return result;
}

std::string bold(std::string_view text) {
    return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(std::string_view text) {
    return "\\fI" + escaped(text) + "\\fR";
}

std::string section(std::string_view title) {
    return fmt::format(".SH {}\n", title);
}

std::string header(const ToolText& tool, const std::string& name, const std::string& what) {
    std::string title = name;
    const std::string words = what.ends_with('.') ? what.substr(0, what.size() - 1) : what;
    for (char& c : title)
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    // Without a date: equal sources give equal pages.
    return fmt::format(
        ".\\\" Written by dotpose_manuals from the options of the tool.\n"
        ".TH \"{}\" 1 \"\" \"{}\" \"User Commands\"\n{}{} \\- {}\n",
        escaped(title), escaped(tool.version), section("NAME"), escaped(name), escaped(words));
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + bold(name);
    return text;
}

std::string values_of(const OptionText& option) {
    if (option.type.empty()) return {};
    if (option.is_repeated) return italic(option.type) + "...";
    std::string text = italic(option.type);
    for (int i = 1; i < option.values; ++i)
        text += " " + italic(option.type);
    return text;
}

std::string name_list(const OptionText& option) {
    if (option.long_name.empty()) return italic(option.argument);
    std::string text;
    if (!option.short_name.empty()) text = bold(option.short_name) + ", ";
    text += bold(option.long_name);
    return option.type.empty() ? text : text + " " + values_of(option);
}

std::string entry(const OptionText& option) {
    std::string text = ".TP\n" + name_list(option) + "\n" + escaped(option.help) + ".";
    if (option.is_required) text += " Required.";
    if (!option.default_text.empty()) text += " Default: " + escaped(option.default_text) + ".";
    if (!option.needs.empty()) text += " Only with " + joined(option.needs) + ".";
    if (!option.excludes.empty()) text += " Not with " + joined(option.excludes) + ".";
    return text + "\n";
}

/// Returns how a command is written; `words` are those that precede its options.
std::string synopsis(const std::string& words, const CommandText& command) {
    std::string text = bold(words);
    if (!command.commands.empty()) text += " " + italic("COMMAND");
    for (const OptionText& option : command.options) {
        if (option.is_required && !option.long_name.empty())
            text += " " + bold(option.long_name) + " " + values_of(option);
    }
    text += " [" + italic("OPTION") + "]...";
    for (const OptionText& option : command.options) {
        if (option.argument.empty()) continue;
        const std::string name = italic(option.argument) + (option.is_repeated ? "..." : "");
        text += option.is_required ? " " + name : " [" + name + "]";
    }
    return text + "\n";
}

/// Returns lines as they stand, in the type of a terminal.
std::string verbatim(const std::string& lines) {
    return ".PP\n.RS 2\n.nf\n" + escaped(lines) + ".fi\n.RE\n";
}

/// Returns examples and paragraphs, told apart by the two spaces at the start of examples.
std::string notes(const std::string& footer) {
    std::string text, examples;
    std::istringstream lines(footer);
    const auto flush = [&text, &examples] {
        if (!examples.empty()) text += verbatim(examples);
        examples.clear();
    };
    bool starts_paragraph = true;
    for (std::string line; std::getline(lines, line);) {
        if (line == "Examples:") {
            flush();
            text += section("EXAMPLES");
            starts_paragraph = true;
        } else if (line.starts_with("  ")) {
            examples += line.substr(2) + "\n";
        } else if (line.empty()) {
            flush();
            starts_paragraph = true;
        } else {
            flush();
            if (starts_paragraph) text += ".PP\n";
            text += escaped(line) + "\n";
            starts_paragraph = false;
        }
    }
    flush();
    return text;
}

}  // namespace

std::string tool_page(const ToolText& tool) {
    std::string text = header(tool, "dotpose", tool.top.what);
    text += section("SYNOPSIS") + bold("dotpose") + " " + italic("COMMAND") + " [" +
            italic("OPTION") + "]...\n.br\n" + bold("dotpose help") + " [" + italic("COMMAND") +
            "]\n";
    text += section("COMMANDS");
    for (const CommandText& command : tool.top.commands) {
        text += ".TP\n" + bold("dotpose-" + command.name) + "(1)\n" + escaped(command.what) + ".\n";
    }
    text += section("OPTIONS");
    for (const OptionText& option : tool.top.options)
        text += entry(option);
    text += section("EXAMPLES") + "A first day:\n" + verbatim(tool.first_day);
    text += section("EXIT STATUS");
    const auto status = [&text](int code, const char* meaning) {
        text += fmt::format(".TP\n{}\n{}\n", code, escaped(meaning));
    };
    status(0, "The command did what it was asked for.");
    status(cli::kExitFailed, "It failed; standard error says why.");
    status(cli::kExitUsage, "The command line was wrong.");
    status(cli::kExitFaults, "A check found faults.");
    text += section("FILES") + italic("share/doc/dotpose") +
            "\n.RS\nDocuments and examples in C++, under the prefix of the installation;\n" +
            "README.md is the first to read. " + bold("dotpose help") +
            " shows the whole path.\n.RE\n";
    return text;
}

std::string command_page(const ToolText& tool, const CommandText& command) {
    const std::string words = "dotpose " + command.name;
    std::string text = header(tool, "dotpose-" + command.name, command.what);
    text += section("SYNOPSIS") + synopsis(words, command) + section("OPTIONS");
    for (const OptionText& option : command.options)
        text += entry(option);
    if (!command.commands.empty()) text += section("COMMANDS");
    for (const CommandText& own : command.commands) {
        text += ".SS " + escaped(own.name) + "\n" + synopsis(words + " " + own.name, own) +
                ".PP\n" + escaped(own.what) + ".\n";
        for (const OptionText& option : own.options)
            text += entry(option);
        text += notes(own.notes);
    }
    text += notes(command.notes);
    return text + section("SEE ALSO") + bold("dotpose") + "(1)\n";
}

}  // namespace dotpose::manuals
